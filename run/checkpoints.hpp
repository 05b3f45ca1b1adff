// The checkpoints of a run: what they hold, when they are due, and how a run goes on from one.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "output/checkpoint.hpp"
#include "run/observer.hpp"
#include "run/record.hpp"
#include "run/simulation.hpp"

namespace undex::run {

/// All of a run that outlasts a step. The members must outlive it.
struct RunState {
  Simulation& simulation;
  Observer& observer;
  Stopwatch& cost;
  bool& energy_off;  ///< was the balance off after the last step?

  void visit_state(StateVisitor& state);
};

class Checkpoints {
 public:
  /// Of a run at its start, into the folder, every `interval` [s] of wall time (0: none, ever). `scene` is as resolved.toml has
  /// it; `numerics` is what the digits depend on beside it.
  Checkpoints(RunState state, const std::filesystem::path& folder, double interval, std::string scene, std::string numerics);

  /// The run goes on from there. Throws RestartError where it would not start from the same state, to the last bit.
  void restore(const output::Checkpoint& checkpoint);

  /// After every step.
  void write_if_due();
  /// Of the present state; `whole_step` false: of a step that went wrong. A failure is a warning: the run goes on.
  void write(bool whole_step = true);
  /// Failures, one sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  const PassTimers& timers() const { return timers_; }

 private:
  using Clock = std::chrono::steady_clock;
  void visit_state(StateVisitor& state);

  RunState state_;
  std::filesystem::path folder_;
  double interval_;
  output::CheckpointTitle title_;
  Clock::time_point last_ = Clock::now();
  double last_time_;  ///< [s] of the last one; below the start: none
  std::vector<std::string> warnings_;
  PassTimers timers_;
};

}  // namespace undex::run
