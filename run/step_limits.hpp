// What set the steps of a run, and how often.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/state.hpp"

namespace undex::run {

class StepLimits {
 public:
  /// A step was taken; `words`: what set it (Step::words). Which particle it was does not count.
  void count(const std::string& words);
  /// Steps by what set them, "Courant (water)"; the most frequent first.
  std::vector<std::pair<std::string, std::int64_t>> counts() const;
  void visit_state(StateVisitor& state);

 private:
  std::vector<std::string> names_;
  std::vector<std::int64_t> counts_;
};

}  // namespace undex::run
