// A face of four nodes as the bilinear surface through them,
//   x(u, v) = (1-u)(1-v) x0 + u(1-v) x1 + u v x2 + (1-u) v x3,  u and v in [0, 1],
// and the space about it: x(u, v, s) = x(u, v) - s n(u, v) with n the unit vector along the blend of the nodes' normals, so that
// neighbouring faces share the lines on which a point leaves one for the other. What lies at (u, v) is blended by the weights of
// the nodes, and what acts there goes to the nodes by the same weights.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <span>

#include "core/vector.hpp"

namespace undex {

/// Weights of a face's four nodes at (u, v); their sum is 1.
inline std::array<double, 4> bilinear_weights(double u, double v) { return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v}; }

/// What the nodes of a face have, at a point of the weights.
inline Vec3 blended(const std::array<double, 4>& weight, const std::array<Vec3, 4>& corner) {
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2] + weight[3] * corner[3];
}
inline Vec3 blended(const std::array<double, 4>& weight, const std::array<int, 4>& face, std::span<const Vec3> nodal) {
  return weight[0] * nodal[face[0]] + weight[1] * nodal[face[1]] + weight[2] * nodal[face[2]] + weight[3] * nodal[face[3]];
}

/// Derivatives of the blend over u and over v.
inline Vec3 slope_along_u(const std::array<Vec3, 4>& corner, double v) {
  return (1 - v) * (corner[1] - corner[0]) + v * (corner[2] - corner[3]);
}
inline Vec3 slope_along_v(const std::array<Vec3, 4>& corner, double u) {
  return (1 - u) * (corner[3] - corner[0]) + u * (corner[2] - corner[1]);
}

/// A place in the space about a face: of the surface, and in front of it.
struct PatchPoint {
  double u = 0.5, v = 0.5;
  double distance = 0;  ///< [m], against the normal
};

struct BilinearPatch {
  std::array<Vec3, 4> corner;  ///< [m]
  std::array<Vec3, 4> normal;  ///< of unit length, at the corners

  /// Foot [m], unit normal and their derivatives at (u, v).
  struct Frame {
    Vec3 foot, normal, foot_u, foot_v, normal_u, normal_v;

    /// Volume element per du dv ds at `behind` [m] along the normal (in front of the surface: negative) [m^2].
    double element(double behind) const { return (foot_u + behind * normal_u).cross(foot_v + behind * normal_v).dot(normal); }
  };
  Frame frame(double u, double v) const {
    const std::array<double, 4> weight = bilinear_weights(u, v);
    Frame f;
    f.foot = blended(weight, corner), f.foot_u = slope_along_u(corner, v), f.foot_v = slope_along_v(corner, u);
    const Vec3 blend = blended(weight, normal), blend_u = slope_along_u(normal, v), blend_v = slope_along_v(normal, u);
    const double length = blend.norm();
    f.normal = blend / length;
    f.normal_u = (blend_u - f.normal.dot(blend_u) * f.normal) / length;
    f.normal_v = (blend_v - f.normal.dot(blend_v) * f.normal) / length;
    return f;
  }

  /// Solves x(u, v, distance) = place [m] from the guess in `at` by Newton's method, to 1e-10 of the face and of `size` [m].
  /// False where that does not end, or leaves the face by far.
  bool project(const Vec3& place, double size, PatchPoint& at) const {
    for (int k = 0; k < 8; ++k) {
      const Frame f = frame(at.u, at.v);
      const Vec3 miss = place - (f.foot - at.distance * f.normal);
      Mat3 jacobian;
      jacobian << f.foot_u - at.distance * f.normal_u, f.foot_v - at.distance * f.normal_v, -f.normal;
      const Vec3 step = jacobian.inverse() * miss;
      at.u += step[0], at.v += step[1], at.distance += step[2];
      if (!(std::abs(at.u - 0.5) < 3.0 && std::abs(at.v - 0.5) < 3.0)) return false;
      if (std::abs(step[0]) + std::abs(step[1]) < 1e-10 && std::abs(step[2]) < 1e-10 * size) return true;
    }
    return false;
  }
};

}  // namespace undex
