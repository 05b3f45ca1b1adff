// What a run says while it runs: a line now and then, and a bar where somebody is watching a terminal.
#pragma once

#include <chrono>
#include <string>

#include "run/simulation.hpp"

namespace undex::run {

class Progress {
 public:
  /// verbosity -1: nothing; 0: a line every few seconds; 1: every step.
  Progress(double start_time, double end_time, int verbosity);
  /// Called after every step.
  void report(const Simulation& simulation);
  /// The last line, whatever the interval; takes the bar away.
  void finish(const Simulation& simulation);

 private:
  using Clock = std::chrono::steady_clock;
  void line(const Simulation& simulation);
  void bar(double share, double seconds_left);
  void clear_bar();

  double start_time_, end_time_;
  int verbosity_;
  bool terminal_;
  bool bar_shown_ = false;
  bool header_shown_ = false;
  Clock::time_point start_, last_line_, last_bar_;
  long last_steps_ = 0;
};

}  // namespace undex::run
