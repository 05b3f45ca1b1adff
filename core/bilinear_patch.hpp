// A face of four nodes as the bilinear surface through them,
//   x(u, v) = (1-u)(1-v) x0 + u(1-v) x1 + u v x2 + (1-u) v x3,  u and v in [0, 1],
// and the space about it: x(u, v, s) = x(u, v) - s n(u, v) with n the unit vector along the blend of the nodes' normals, so that
// neighbouring faces share the lines on which a point leaves one for the other. What lies at (u, v) is blended by the weights of
// the nodes, and what acts there goes to the nodes by the same weights.
#pragma once

#include <array>
#include <span>

#include "core/vector.hpp"

namespace undex {

/// Weights of a face's four nodes at (u, v); their sum is 1.
inline std::array<double, 4> bilinear_weights(double u, double v) { return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v}; }

/// What the nodes of a face have, at a point of the weights.
Vec3 blended(const std::array<double, 4>& weight, const std::array<Vec3, 4>& corner);
Vec3 blended(const std::array<double, 4>& weight, const std::array<int, 4>& face, std::span<const Vec3> nodal);

/// Derivatives of the blend over u and over v.
Vec3 slope_along_u(const std::array<Vec3, 4>& corner, double v);
Vec3 slope_along_v(const std::array<Vec3, 4>& corner, double u);

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
    double element(double behind) const;
  };
  Frame frame(double u, double v) const;

  /// Solves x(u, v, distance) = place [m] from the guess in `at` by Newton's method, to 1e-10 of the face and of `size` [m].
  /// False where that does not end, or comes farther than `beyond` faces from the face's middle.
  bool project(const Vec3& place, double size, PatchPoint& at, double beyond = 3.0) const;
};

}  // namespace undex
