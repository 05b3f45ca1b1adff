// Reflection in a plane with the unit normal n: a -> R a, R = 1 - 2 n n^T, of what pairs read of a particle, and the volume of an
// image behind a curved wall.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/vector.hpp"
#include "sph_fluid/pairs/rows.hpp"

namespace undex::sph {

inline Vec3 reflected(const Vec3& a, const Vec3& n) { return a - 2.0 * a.dot(n) * n; }

/// R S R of a symmetric matrix (xx, yy, zz, xy, yz, zx).
inline void reflect_symmetric(float* s, const Vec3& n) {
  constexpr int place[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  Mat3 matrix;
  for (int k = 0; k < 6; ++k) matrix(place[k][0], place[k][1]) = matrix(place[k][1], place[k][0]) = s[k];
  const Vec3 sn = matrix * n;
  const double nsn = n.dot(sn);
  matrix += 4.0 * nsn * n * n.transpose() - 2.0 * (n * sn.transpose() + sn * n.transpose());
  for (int k = 0; k < 6; ++k) s[k] = float(matrix(place[k][0], place[k][1]));
}

/// In a wall of that velocity [m/s]; the image's volume is `stretch` times the particle's.
inline void reflect(FluidRow& row, const Vec3& n, const Vec3& wall_velocity, double stretch) {
  const Vec3 v = reflected(Vec3(row.vx, row.vy, row.vz), n) + 2.0 * wall_velocity.dot(n) * n;
  row.vx = v[0], row.vy = v[1], row.vz = v[2];
  row.volume *= stretch;
}

inline void reflect(GradientRow& row, const Vec3& n) {
  reflect_symmetric(row.strain, n);
  const Vec3 p = reflected(Vec3(row.pressure[0], row.pressure[1], row.pressure[2]), n);
  for (int a = 0; a < 3; ++a) row.pressure[a] = float(p[a]);
}

/// The same of an image whose pressure goes on through the wall as 2 p_wall - p.
inline void continue_through(GradientRow& row, const Vec3& n) { reflect_symmetric(row.strain, n); }

inline void reflect(CorrectedRow& row, const Vec3& n) {
  reflect(row.gradient, n);
  reflect_symmetric(row.moment, n);
}

inline void continue_through(CorrectedRow& row, const Vec3& n) {
  continue_through(row.gradient, n);
  reflect_symmetric(row.moment, n);
}

/// An image's share of its particle's volume from the ratio of volume elements behind and in front of the wall, which is
/// 1 + 4 H s to first order at the distance s from a wall of mean curvature H. With a volume stretched by 1 + g H s the pairs
/// (i, images) and (image of i, particles) press on i with w (1 + H s) + (g - 4) H Q and w (1 + (g - 1) H s), where w(s) is the
/// kernel's integral over a plane and Q that of w from s on. Their mean must be w (1 + H s), what a fluid that goes on behind the
/// wall would do. The integrals over s of s w and Q are equal, so the layer as a whole is in balance with g = 3.
inline double image_volume(double ratio) {
  // Near the centre of the curvature, or beyond it, ratios say nothing.
  return std::pow(ratio > 0.1 ? std::min(ratio, 10.0) : ratio > 0.0 ? 0.1 : 10.0, 0.75);
}

}  // namespace undex::sph
