// The largest values of a run so far, with their places and times.
#pragma once

#include <string>
#include <vector>

#include "core/state.hpp"
#include "output/run_record.hpp"
#include "run/simulation.hpp"

namespace undex::run {

class LargestValues {
 public:
  explicit LargestValues(bool wanted) : wanted_(wanted) {}
  void visit_state(StateVisitor& state);
  /// After every step; it looks at every fourth of the one-dimensional mesh.
  void look(const Simulation& simulation);
  std::vector<output::LargestRecord> records(int dimension) const;

 private:
  struct Entry {
    std::string part, quantity;
    double value, time;
    Vec3 place;
  };
  Entry& entry(const std::string& part, const std::string& quantity);

  bool wanted_;
  std::vector<Entry> entries_;
};

}  // namespace undex::run
