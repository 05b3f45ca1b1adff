// Vectors and small tensors in three dimensions. One- and two-dimensional scenes leave the unused components zero.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace undex {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Axis-aligned box [m]; it begins empty.
struct Bounds {
  Vec3 low = Vec3::Constant(1e300);
  Vec3 high = Vec3::Constant(-1e300);

  void include(const Vec3& x) {
    for (int a = 0; a < 3; ++a) {
      if (x[a] < low[a]) low[a] = x[a];
      if (x[a] > high[a]) high[a] = x[a];
    }
  }
  void include(const Bounds& other) {
    for (int a = 0; a < 3; ++a) {
      if (other.low[a] < low[a]) low[a] = other.low[a];
      if (other.high[a] > high[a]) high[a] = other.high[a];
    }
  }
  bool empty() const { return low[0] > high[0] || low[1] > high[1] || low[2] > high[2]; }
  /// Is x in it, or at most `margin` [m] outside along each axis?
  bool holds(const Vec3& x, double margin) const {
    for (int a = 0; a < 3; ++a)
      if (!(low[a] - margin <= x[a] && x[a] <= high[a] + margin)) return false;
    return true;
  }
  /// From x to the nearest of its points [m].
  double distance(const Vec3& x) const {
    double square = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double outside = x[a] < low[a] ? low[a] - x[a] : x[a] > high[a] ? x[a] - high[a] : 0.0;
      square += outside * outside;
    }
    return std::sqrt(square);
  }
};

}  // namespace undex
