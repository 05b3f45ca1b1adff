// The histories of a run: one CSV file per probe, and the samples as evidence for a verdict.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "run/simulation.hpp"
#include "output/history.hpp"
#include "output/samples.hpp"
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

  /// What has been sampled, by the probe's name.
  std::map<std::string, output::Samples> samples() const;

 private:
  struct Channel {
    scene::Probe probe;
    std::optional<coupling::WetWall::Foot> foot;    ///< of wall probes on a moving wall
    std::optional<fem::Structure::Probe> material;  ///< of structure probes on finite elements
    std::optional<sph::Solids::Point> solid;        ///< of structure probes on solids, and of wall probes at their surface
    output::History history;
    output::Samples samples;
  };
  std::vector<double> read(const Channel& channel, const Simulation& simulation) const;
  static void append(Channel& channel, const std::vector<double>& row);

  std::vector<Channel> channels_;
  int dimension_;
};

}  // namespace undex::run
