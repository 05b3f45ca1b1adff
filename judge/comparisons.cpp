#include "judge/comparisons.hpp"

#include <algorithm>

namespace undex::judge {

// Each in the file of its name.
Comparison rigid_cylinder(), tube(), taylor_bar(), taylor_plate(), free_field(), profile(), similitude();

const std::vector<Comparison>& comparisons() {
  static const std::vector<Comparison> all{rigid_cylinder(), tube(),    taylor_bar(), taylor_plate(),
                                           free_field(),     profile(), similitude()};
  return all;
}

const Comparison* comparison_of(const scene::Scene& scene) {
  const auto found = std::find_if(comparisons().begin(), comparisons().end(),
                                  [&](const Comparison& each) { return each.kind.name == scene.comparison.kind; });
  return found == comparisons().end() ? nullptr : &*found;
}

const std::vector<scene::ComparisonKind>& comparison_kinds() {
  static const std::vector<scene::ComparisonKind> kinds = [] {
    std::vector<scene::ComparisonKind> each;
    for (const Comparison& comparison : comparisons()) each.push_back(comparison.kind);
    return each;
  }();
  return kinds;
}

}  // namespace undex::judge
