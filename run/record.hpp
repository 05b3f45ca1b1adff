// The record of a run: what it was, how well its ledgers close, what it cost.
#pragma once

#include <chrono>

#include "output/run_record.hpp"
#include "run/simulation.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// Wall and CPU time [s] since it was made: what loading the program costs is not the run's.
class Stopwatch {
 public:
  double wall() const { return before_[0] + std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(); }
  double cpu() const { return before_[1] + output::cpu_time() - cpu_; }
  /// What the run has cost before it was interrupted; asked for, it is the cost until now.
  void visit_state(StateVisitor& state);

 private:
  double before_[2] = {0, 0};  ///< wall, CPU
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = output::cpu_time();
};

/// The present state of a run, without status, message and metrics.
output::RunRecord record_of(const scene::Scene& scene, const Simulation& simulation, const Stopwatch& since);

}  // namespace undex::run
