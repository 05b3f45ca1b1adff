// Profiles along the scene's lines: at their times what a fluid probe would read at each of their points.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/history.hpp"
#include "output/samples.hpp"
#include "run/simulation.hpp"
#include "scene/scene.hpp"

namespace undex::run {

class ProfileLines {
 public:
  /// Opens lines/<name>.csv under `folder`. Where the run goes on, visit_state opens them, which knows their rows.
  ProfileLines(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder, bool goes_on);
  void visit_state(StateVisitor& state);
  /// Writes the profiles whose time has come; of a state after a step, or the first.
  void look(const Simulation& simulation);
  void flush();
  /// What has been written, by the line's name.
  std::map<std::string, output::Samples> samples() const;

 private:
  struct Line {
    const scene::ProfileLine* given;
    std::filesystem::path path;
    output::Samples samples;
    std::optional<output::History> history;
    double next = 0;  ///< time of the next profile [s]
  };
  /// The first time after `time` [s] at which the line has a profile; infinity when there is none.
  static double next_after(const scene::ProfileLine& line, double time);
  void write(Line& line, const Simulation& simulation);

  int dimension_;
  std::vector<Line> lines_;
};

}  // namespace undex::run
