// The radial component of a vector history: how a round body moves away from its axis.
#pragma once

#include <array>

#include "core/vector.hpp"
#include "output/series.hpp"

namespace undex::judge {

/// The axis of a tube or a rod.
struct Axis {
  int direction = 2;
  Vec3 center = Vec3::Zero();
  /// Unit vector away from the axis at a point; zero on the axis.
  Vec3 outward(const Vec3& point) const;
  bool operator==(const Axis&) const = default;
};

/// The sum of the components (x, y, z; empty where a plane scene has none) times those of `outward`, as long as the shortest.
output::Series radial(const std::array<output::Series, 3>& components, const Vec3& outward);

}  // namespace undex::judge
