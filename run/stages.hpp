// What a run says of its set-up: a line a stage, with what came of it and how long it took.
#pragma once

#include <chrono>
#include <string>

#include "output/terminal.hpp"

namespace undex::run {

class Stages {
 public:
  explicit Stages(bool quiet = true) : quiet_(quiet) {}
  /// A stage begins: a word or two.
  void begin(const std::string& name);
  /// Says how far it has come: at once on a terminal, else every ten seconds. `words` gives the line, and is
  /// asked only when one is due.
  template <class Words>
  void news(const Words& words) {
    if (due()) say(words());
  }
  /// It is over; `result`: what came of it.
  void end(const std::string& result);
  bool quiet() const { return quiet_; }

 private:
  bool due() const;
  double elapsed() const;  ///< [s] since the stage began
  void say(const std::string& words);

  bool quiet_;
  std::string name_;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  double next_ = 0;  ///< [s] since the stage began
  output::LiveLine live_;
};

/// "0.4 s", "12 s", "3 min 05 s".
std::string short_time(double seconds);

}  // namespace undex::run
