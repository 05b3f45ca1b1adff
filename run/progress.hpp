// What a run says while it runs: a line now and then, and one that replaces itself where somebody is watching a terminal.
#pragma once

#include <chrono>
#include <string>

#include "output/terminal.hpp"
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
  /// Bar, time, step and what set it, energy error, speed, time left.
  std::string bar(const Simulation& simulation);
  double share(const Simulation& simulation) const;
  /// "12 s"; "?" before the first step.
  std::string left(const Simulation& simulation) const;

  double start_time_, end_time_;
  int verbosity_;
  bool header_shown_ = false;
  Clock::time_point start_, last_line_, last_bar_;
  long first_steps_ = -1, last_steps_ = 0;
  output::LiveLine live_;
};

}  // namespace undex::run
