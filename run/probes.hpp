// The histories of a run: one CSV file per probe and per obstacle, and the samples as evidence for a verdict.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "run/simulation.hpp"
#include "output/history.hpp"
#include "output/samples.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// The fluid at a place in space [m], as a fluid probe reads it.
FluidPoint fluid_at(const Simulation& simulation, const Vec3& x);

class Probes {
 public:
  /// Finds the probes' places in the simulation, which must outlive them, and opens history/<name>.csv under `folder`.
  /// Where the run goes on, they are opened by visit_state, which knows their rows; those of new probes are begun.
  Probes(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder, bool goes_on);
  void visit_state(StateVisitor& state);

  /// Appends one row to every history.
  void sample(const Simulation& simulation);
  /// Appends a row for `time` [s] before the simulation's own, with its present values: where nothing has arrived yet
  /// (walls and structures before a spherical start's takeover) they are those of the start.
  void sample_before(double time);
  void flush();

  /// What has been sampled, by the name of the probe or obstacle.
  std::map<std::string, output::Samples> samples() const;

 private:
  struct Channel {
    std::string name;
    bool may_lie_in_wave = false;                        ///< of a spherical start
    std::function<void(std::vector<double>& row)> read;  ///< appends the present values of its columns
    std::filesystem::path path;
    output::Samples samples;
    std::optional<output::History> history;
  };
  static void append(Channel& channel, const std::vector<double>& row);
  static std::vector<double> row_of(const Channel& channel, double time);

  std::vector<Channel> channels_;
};

}  // namespace undex::run
