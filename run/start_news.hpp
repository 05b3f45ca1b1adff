// What is said of a start that takes long.
#pragma once

#include <cstdio>
#include <string>

#include "run/record.hpp"

namespace undex::run {

/// Says every few seconds how far a start has come.
class StartNews {
 public:
  explicit StartNews(bool quiet = true) : quiet_(quiet) {}
  /// `words` gives the line, and is asked only when one is due.
  template <class Words>
  void operator()(const Words& words) {
    if (quiet_ || since_.wall() < next_) return;
    next_ = since_.wall() + 2.0;
    std::printf("%s\n", std::string(words()).c_str());
    std::fflush(stdout);
  }
  bool quiet() const { return quiet_; }

 private:
  bool quiet_;
  Stopwatch since_;
  double next_ = 2.0;  // [s]
};

}  // namespace undex::run
