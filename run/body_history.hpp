// bodies.csv: what becomes of each body of the fluid as a whole, and the bubbles among them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/history.hpp"
#include "output/run_record.hpp"
#include "output/samples.hpp"
#include "run/simulation.hpp"
#include "scene/scene.hpp"

namespace undex::run {

class BodyHistory {
 public:
  /// Opens `folder`/bodies.csv where the scene asks for it. Where the run goes on, visit_state opens it, which knows its rows.
  BodyHistory(const scene::Scene& scene, const std::filesystem::path& folder, bool goes_on);
  void visit_state(StateVisitor& state);
  /// A row: of a scene without history_interval of every tenth call alone, of the one-dimensional mesh of every fiftieth; and of
  /// the end.
  void sample(const Simulation& simulation);
  void flush();
  const output::Samples& samples() const { return samples_; }
  /// Of each body of gas round which there is a liquid.
  std::vector<output::BubbleRecord> bubbles() const;

 private:
  const scene::Scene& scene_;
  bool wanted_;
  long calls_ = 0;
  std::filesystem::path path_;
  output::Samples samples_;
  std::optional<output::History> history_;
};

/// A bubble's largest radius and first period from its radius over time, to the samples' own times. What the run has not come to
/// is NaN: the largest radius until the bubble has shrunk by a hundredth from it, the least until it has grown by as much again.
output::BubbleRecord bubble_of(const output::Series& radius);

}  // namespace undex::run
