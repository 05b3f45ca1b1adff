#include "core/state.hpp"

#include <sstream>

namespace undex {

void StateVisitor::operator()(std::string_view name, PassTimers& timers) {
  if (!wants_cost()) return;
  std::string names;
  std::vector<double> seconds;
  for (const auto& [pass, time] : timers.seconds()) {
    names += pass + "\n";
    seconds.push_back(time);
  }
  part(name, [&] {
    (*this)("passes", names);
    (*this)("seconds", seconds);
  });
  if (!restores()) return;
  std::vector<std::pair<std::string, double>> passes;
  std::istringstream lines(names);
  for (std::string pass; std::getline(lines, pass);) passes.emplace_back(pass, seconds.at(passes.size()));
  timers.set(std::move(passes));
}

}  // namespace undex
