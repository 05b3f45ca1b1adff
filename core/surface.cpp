#include "core/surface.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace undex {

std::vector<double> nodal_areas(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position) {
  std::vector<double> area(position.size(), 0.0);
  for (const std::array<int, 4>& face : faces) {
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
    const Vec3 area = 0.5 * (position[face[2]] - position[face[0]]).cross(position[face[3]] - position[face[1]]);
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
