#include "core/surface.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/bilinear_patch.hpp"

namespace undex {

SurfaceFoot nearest_foot(const WetSurface& surface, const Vec3& x) {
  SurfaceFoot foot;
  double best = 1e300;
  constexpr int fine = 8;
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    for (int j = 0; j <= fine; ++j)
      for (int i = 0; i <= fine; ++i) {
        const std::array<double, 4> weight = bilinear_weights(double(i) / fine, double(j) / fine);
        const double distance = (blended(weight, surface.faces[f], surface.nodes) - x).norm();
        if (distance < best) {
          best = distance;
          foot = {.face = int(f), .weight = weight, .distance = distance};
        }
      }
  return foot;
}

std::vector<double> nodal_areas(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position, bool rings) {
  std::vector<double> area(position.size(), 0.0);
  for (const std::array<int, 4>& face : faces) {
    if (is_segment(face)) {
      const Vec3 &a = position[face[0]], &b = position[face[1]];
      const double length = (b - a).norm(), share = std::numbers::pi * length / 3.0;
      area[face[0]] += rings ? share * (2.0 * a[0] + b[0]) : 0.5 * length;
      area[face[1]] += rings ? share * (a[0] + 2.0 * b[0]) : 0.5 * length;
      continue;
    }
    const Vec3 u = position[face[2]] - position[face[0]], v = position[face[3]] - position[face[1]];
    for (const int n : face) area[n] += 0.125 * u.cross(v).norm();
  }
  return area;
}

std::vector<Vec3> node_normals(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position,
                               const std::array<bool, 3>& symmetry) {
  std::vector<Vec3> normal(position.size(), Vec3::Zero());
  Bounds box;
  for (const Vec3& x : position) box.include(x);
  const double tolerance = 1e-9 * (box.high - box.low).norm();
  for (const std::array<int, 4>& face : faces) {
    // Half the product of the diagonals: the face's area vector.
    const std::array<Vec3, 4> x = corners_of(face, position);
    const Vec3 area = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]);
    for (const int n : face) normal[n] += area;
  }
  for (std::size_t n = 0; n < normal.size(); ++n) {
    for (int a = 0; a < 3; ++a)
      if (symmetry[a] && std::abs(position[n][a]) <= tolerance) normal[n][a] = 0.0;
    normal[n].normalize();
  }
  return normal;
}

}  // namespace undex
