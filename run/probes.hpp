// The histories of a run: one CSV file per probe, and the samples kept for the comparison at the end.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "run/simulation.hpp"
#include "output/history.hpp"
#include "output/series.hpp"
#include "scene/scene.hpp"

namespace undex::run {

class Probes {
 public:
  /// Finds the probes' places in the simulation, which must outlive them, and opens history/<name>.csv under `folder`.
  Probes(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder);

  /// Appends one row to every history.
  void sample(const Simulation& simulation);
  /// Appends a row for `time` [s] before the simulation's own, with its present values: where nothing has arrived yet
  /// (walls and structures before a spherical start's takeover) they are those of the start.
  void sample_before(double time);
  void flush();

  /// Samples of one column ("pressure", "displacement_x", ...) of a probe; empty where there is none.
  output::Series series(const std::string& probe, const std::string& column) const;

 private:
  struct Channel {
    scene::Probe probe;
    std::function<void(std::vector<double>& row)> read;  ///< appends the present values of its columns
    std::vector<output::Column> columns;                 ///< time first
    output::History history;
    std::vector<std::vector<double>> samples;  ///< one series per column
  };
  static void append(Channel& channel, const std::vector<double>& row);
  static std::vector<double> row_of(const Channel& channel, double time);

  std::vector<Channel> channels_;
};

}  // namespace undex::run
