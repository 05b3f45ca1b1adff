// A named field as the writers take it.
#pragma once

#include <span>
#include <string>

#include "core/vector.hpp"

namespace undex::output {

/// Values of one field, `components` doubles per point (or cell), those of a point side by side: v0x v0y v0z v1x ...
/// The span is borrowed for the call. Files hold float32.
struct Field {
  std::string name;
  int components = 1;
  std::span<const double> values;
};

/// The same memory seen as doubles, three per vector, for Field::values.
inline std::span<const double> as_components(std::span<const Vec3> vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return vectors.empty() ? std::span<const double>() : std::span<const double>(vectors.front().data(), 3 * vectors.size());
}

}  // namespace undex::output
