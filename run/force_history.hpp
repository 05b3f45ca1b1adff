// forces.csv: what the water gives to structures, to each of their wet faces, and to slip faces of walls that stand still, of the
// computed part.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "output/history.hpp"
#include "output/samples.hpp"
#include "run/simulation.hpp"
#include "scene/scene.hpp"

namespace undex::run {

class ForceHistory {
 public:
  /// Opens `folder`/forces.csv where the scene asks for it and something receives forces. Where the run goes on, visit_state
  /// opens it, which knows its rows.
  ForceHistory(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder, bool goes_on);
  void visit_state(StateVisitor& state);
  void sample(const Simulation& simulation);
  void flush();
  const output::Samples& samples() const { return samples_; }

 private:
  /// Who receives: components of its impulse [N s], in the frame of the solvers, from `first` to below `end`.
  struct Receiver {
    std::function<Vec3(const Simulation&)> impulse;
    int first, end;
  };

  std::vector<Receiver> receivers_;
  std::vector<output::Column> columns_;
  std::filesystem::path path_;
  output::Samples samples_;
  std::optional<output::History> history_;
};

}  // namespace undex::run
