// Vectors and small tensors in three dimensions. One- and two-dimensional scenes leave the unused components zero.
#pragma once

#include <Eigen/Core>

namespace undex {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Axis-aligned box [m].
struct Bounds {
  Vec3 low = Vec3::Constant(1e300);
  Vec3 high = Vec3::Constant(-1e300);

  void include(const Vec3& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  bool empty() const { return (low.array() > high.array()).any(); }
};

}  // namespace undex
