// The largest value of a quantity over a part of the scene, and where it is.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/vector.hpp"

namespace undex {

struct Largest {
  double value = -1e300;
  Vec3 place = Vec3::Zero();  ///< now [m]
  std::uint32_t owner = 0;    ///< number of the particle, node or cell: the least of those with that value

  /// Takes what is larger.
  void take(double other, std::uint32_t by, const auto& place_of) {
    if (other < value || (other == value && by >= owner)) return;
    value = other;
    owner = by;
    place = place_of();
  }
  void operator+=(const Largest& other) {
    take(other.value, other.owner, [&] { return other.place; });
  }
};

/// Quantities that are looked for, by name: "pressure" [Pa], "speed" [m/s], "plastic_strain" [-], "damage" [-],
/// "temperature" [K].
struct LargestOf {
  std::string part;  ///< name of the body, solid or structure
  std::vector<std::pair<const char*, Largest>> quantities;
};

}  // namespace undex
