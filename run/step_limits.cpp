#include "run/step_limits.hpp"

#include <algorithm>
#include <sstream>

namespace undex::run {
namespace {

/// "Courant (water, particle 12)" and "Courant (water) x1, structure x2" are both "Courant (water)".
std::string without_place(const std::string& words) {
  const std::size_t open = words.find('('), close = words.find(')', open);
  if (open == std::string::npos || close == std::string::npos) return words;
  return words.substr(0, std::min(close, words.find(", particle", open))) + ")";
}

}  // namespace

void StepLimits::count(const std::string& words) {
  const std::string name = without_place(words);
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) {
    ++counts_[std::size_t(found - names_.begin())];
    return;
  }
  names_.push_back(name);
  counts_.push_back(1);
}

std::vector<std::pair<std::string, std::int64_t>> StepLimits::counts() const {
  std::vector<std::pair<std::string, std::int64_t>> all;
  for (std::size_t k = 0; k < names_.size(); ++k) all.emplace_back(names_[k], counts_[k]);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return all;
}

void StepLimits::visit_state(StateVisitor& state) {
  std::string lines;
  for (const std::string& name : names_) lines += name + "\n";
  state("names", lines);
  state("counts", counts_);
  if (!state.restores()) return;
  names_.clear();
  std::istringstream text(lines);
  for (std::string name; std::getline(text, name);) names_.push_back(name);
  counts_.resize(names_.size());
}

}  // namespace undex::run
