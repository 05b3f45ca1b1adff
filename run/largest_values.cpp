#include "run/largest_values.hpp"

#include <algorithm>
#include <sstream>

namespace undex::run {

LargestValues::Entry& LargestValues::entry(const std::string& part, const std::string& quantity) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& each) { return each.part == part && each.quantity == quantity; });
  if (found != entries_.end()) return *found;
  return entries_.emplace_back(Entry{part, quantity, -1e300, 0.0, Vec3::Zero()});
}

void LargestValues::visit_state(StateVisitor& state) {
  std::string names;  // a line each
  std::vector<double> value, time;
  std::vector<Vec3> place;
  for (const Entry& each : entries_) {
    names += each.part + ' ' + each.quantity + '\n';
    value.push_back(each.value);
    time.push_back(each.time);
    place.push_back(each.place);
  }
  state("names", names);
  state("value", value);
  state("time", time);
  state("place", place);
  if (!state.restores()) return;
  entries_.clear();
  std::istringstream lines(names);
  Entry each;
  for (std::size_t k = 0; lines >> each.part >> each.quantity; ++k)
    entries_.push_back({each.part, each.quantity, value.at(k), time.at(k), place.at(k)});
}

void LargestValues::look(const Simulation& simulation) {
  constexpr long on_a_line = 4;  // steps, where to look costs a fiftieth of one
  if (!wanted_ || (simulation.line() && simulation.steps() % on_a_line != 0)) return;
  for (const LargestOf& part : simulation.largest())
    for (const auto& [quantity, largest] : part.quantities) {
      Entry& so_far = entry(part.part, quantity);
      if (!(largest.value > so_far.value)) continue;
      so_far.value = largest.value;
      so_far.time = simulation.time();
      so_far.place = largest.place;
    }
}

std::vector<output::LargestRecord> LargestValues::records(int dimension) const {
  std::vector<output::LargestRecord> all;
  for (const Entry& each : entries_)
    all.push_back({.part = each.part,
                   .quantity = each.quantity,
                   .value = each.value,
                   .place = {each.place.data(), each.place.data() + dimension},
                   .time_s = each.time});
  return all;
}

}  // namespace undex::run
