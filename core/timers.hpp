// Wall-clock time per named pass.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace undex {

/// Accumulates seconds per pass, in the order in which the passes first ran.
class PassTimers {
 public:
  class Running {
   public:
    Running(PassTimers& timers, std::size_t pass) : timers_(timers), pass_(pass), start_(std::chrono::steady_clock::now()) {}
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running() {
      timers_.passes_[pass_].second += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

   private:
    PassTimers& timers_;
    std::size_t pass_;
    std::chrono::steady_clock::time_point start_;
  };

  /// Times the enclosing scope under `name`.
  [[nodiscard]] Running measure(const char* name) {
    for (std::size_t i = 0; i < passes_.size(); ++i)
      if (passes_[i].first == name) return Running(*this, i);
    passes_.emplace_back(name, 0.0);
    return Running(*this, passes_.size() - 1);
  }
  const std::vector<std::pair<std::string, double>>& seconds() const { return passes_; }
  /// Goes on from what a run has cost before.
  void set(std::vector<std::pair<std::string, double>> seconds) { passes_ = std::move(seconds); }

 private:
  std::vector<std::pair<std::string, double>> passes_;
};

}  // namespace undex
