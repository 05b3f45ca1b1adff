// What a run leaves in summary.json: what was computed, how well the ledgers close, what it cost, what came out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace undex::output {

/// Named numbers in the order in which they are shown. NaN means "did not happen" and becomes null in JSON.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// Why metrics have no value: a sentence a metric.
using Reasons = std::vector<std::pair<std::string, std::string>>;

/// The number of that name, or null.
const double* find_number(const NamedNumbers& numbers, const std::string& name);

/// What became of a rigid body in the water, whole, at the end. Vectors have as many components as the scene, turns those that
/// it has.
struct ObstacleRecord {
  std::string name, motion;
  std::optional<double> mass;                  ///< of a free one [kg]
  std::vector<double> displacement, rotation;  ///< of its middle of mass [m]; axis times angle [rad]
  std::vector<double> velocity, spin;          ///< [m/s], [rad/s]
  std::vector<double> impulse;                 ///< by the water since the start [N s]
};

/// What one of several structures has at the end: energies of the whole body [J].
struct StructureRecord {
  std::string name;
  std::int64_t cells = 0, steps = 0;
  double kinetic = 0, elastic = 0, plastic = 0, viscous = 0;
  double received = 0, external = 0;  ///< work of the water, of loads
  double energy_error = 0;            ///< relative
  std::vector<double> impulse;        ///< by the water since the start, of the computed part [N s]
};

/// The largest value of a quantity over a part of the scene and the whole run.
struct LargestRecord {
  std::string part;           ///< name of the body, solid or structure
  std::string quantity;       ///< of core/largest.hpp
  double value = 0;           ///< [SI]
  std::vector<double> place;  ///< as many components as the scene [m]
  double time_s = 0;
};

/// Of a body of gas in a liquid. NaN: the run has not come to it.
struct BubbleRecord {
  std::string body;
  double largest_radius_m = std::numeric_limits<double>::quiet_NaN();  ///< of the sphere (in two dimensions circle) of its volume
  double largest_radius_time_s = std::numeric_limits<double>::quiet_NaN();
  double least_radius_m = std::numeric_limits<double>::quiet_NaN();  ///< the first after that
  double period_s = std::numeric_limits<double>::quiet_NaN();        ///< its time
  std::string missing;                                               ///< why; left out when empty
};

/// Of a body of gas whose particles have split.
struct SplitRecord {
  std::string body;
  std::int64_t particles_at_start = 0, particles = 0;
};

/// How a run stands in one matter.
enum class Trust { good, notice, bad };
struct TrustRecord {
  std::string about;  ///< a word or two: "energy", "charge"
  Trust level = Trust::good;
  std::string text;  ///< a sentence
};

struct RunRecord {
  std::string scene;    ///< its name
  std::string status;   ///< "done", or why it ended: "stopped", "interrupted", ...
  std::string message;  ///< the reason, where status is not "done"; left out when empty
  double time_s = 0;    ///< simulated time reached
  std::int64_t steps = 0;
  std::int64_t fluid_substeps = 0;  ///< of bodies with steps of their own, beside `steps`
  double wall_time_s = 0, cpu_time_s = 0;
  int threads = 1;
  std::int64_t particles = 0;  ///< moving ones, of fluid and solids
  std::int64_t wall_particles = 0;
  std::int64_t cells = 0;                                       ///< of the structure's mesh, or of the one-dimensional one
  std::int64_t particle_updates = 0;                            ///< moving particles times steps of their solver
  std::int64_t neighbour_interactions = 0;                      ///< true neighbours, directed, over all steps
  std::int64_t peak_memory_bytes = 0;                           ///< of the process, program and libraries included
  std::int64_t solver_memory_bytes = 0;                         ///< what the solvers hold of it at the end
  double mass_error = 0, momentum_error = 0, energy_error = 0;  ///< relative
  std::optional<double> angular_momentum_error;                 ///< relative; closed scenes of solids in particles only
  std::optional<double> interface_energy_error;                 ///< coupled runs only
  std::optional<double> interface_impulse_error;                ///< the same
  std::vector<std::string> warnings;        ///< what of the scene computes badly, one sentence each; left out when empty
  std::string program;                      ///< version text; left out when empty
  std::vector<StructureRecord> structures;  ///< of several; left out when empty
  std::vector<ObstacleRecord> obstacles;    ///< left out when empty
  std::vector<LargestRecord> largest;       ///< likewise
  std::vector<BubbleRecord> bubbles;        ///< likewise
  std::vector<SplitRecord> splits;          ///< likewise
  std::vector<std::pair<std::string, std::int64_t>> clamps;       ///< how often each floor or bound acted
  std::vector<std::pair<std::string, std::int64_t>> step_limits;  ///< steps by what set them, the most frequent first
  std::vector<TrustRecord> trust;                                 ///< whether its numbers can be trusted; left out when empty
  NamedNumbers passes;                                            ///< seconds per named pass
  NamedNumbers metrics;                                           ///< results of the scene's comparison
  Reasons missing;                                                ///< why, of each of them that is NaN; left out when empty
};

/// The record as JSON text, keys in the order above.
std::string to_json(const RunRecord& record);

/// Writes to_json() atomically. Throws FileError.
void write_summary(const std::filesystem::path& path, const RunRecord& record);

/// Writes other metrics into a summary.json, atomically; nothing else in it changes. Throws FileError.
void replace_metrics(const std::filesystem::path& path, const NamedNumbers& metrics, const Reasons& missing = {});

/// Reads a summary.json back. Keys that it does not have keep their defaults (NaN for the errors), null becomes NaN, keys
/// of a newer program are passed over. Throws FileError when the file cannot be read or is no run's summary.
RunRecord read_summary(const std::filesystem::path& path);

/// Largest resident memory of this process so far [bytes]; 0 where the system does not tell.
std::int64_t peak_memory_bytes();

/// CPU time of all threads of this process so far [s].
double cpu_time();

}  // namespace undex::output
