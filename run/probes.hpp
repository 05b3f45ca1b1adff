// The histories of a run: one CSV file per probe, and the samples kept for the comparison at the end.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "run/simulation.hpp"
#include "output/history.hpp"
#include "output/series.hpp"
#include "scene/scene.hpp"

namespace undex::run {

class Probes {
 public:
  /// Finds the probes' places and opens history/<name>.csv under `folder`.
  Probes(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder);

  /// Appends one row to every history.
  void sample(const Simulation& simulation);
  /// Appends a row for `time` [s] before the simulation's own, with its present values: where nothing has arrived yet
  /// (walls and structures before a spherical start's takeover) they are those of the start.
  void sample_before(const Simulation& simulation, double time);
  void flush();

  /// Samples of one column ("pressure", "displacement_x", ...) of a probe; empty where there is none.
  output::Series series(const std::string& probe, const std::string& column) const;

 private:
  struct Channel {
    scene::Probe probe;
    std::optional<coupling::WetWall::Foot> foot;    ///< of wall probes on a moving wall
    std::optional<fem::Structure::Probe> material;  ///< of structure probes on finite elements
    std::optional<sph::Solids::Point> solid;        ///< of structure probes on solids, and of wall probes at their surface
    std::vector<output::Column> columns;
    output::History history;
    std::vector<std::vector<double>> samples;  ///< one series per column, time first
  };
  std::vector<double> read(const Channel& channel, const Simulation& simulation) const;
  static void append(Channel& channel, const std::vector<double>& row);

  std::vector<Channel> channels_;
  int dimension_;
};

}  // namespace undex::run
