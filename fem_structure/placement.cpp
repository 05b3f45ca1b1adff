// The point of a mesh nearest to a given one.
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/hexahedral_mesh.hpp"
#include "fem_structure/grid.hpp"
#include "fem_structure/hexahedron_corners.hpp"

namespace undex::fem {
namespace {

struct Projection {
  std::array<double, 3> unit;
  double distance;
};

/// Gauss-Newton on the unit cube: directions that press against a side of the cube are left out, one by one.
Projection project(const Grid& grid, const std::array<int, 8>& cell, const Vec3& target) {
  const std::array<Vec3, 8> corners = corners_of(cell, grid.nodes);
  Vec3 unit = Vec3::Constant(0.5);
  const auto residual_at = [&](const Vec3& u) {
    const auto n = shape_values({u[0], u[1], u[2]});
    Vec3 x = -target;
    for (int i = 0; i < 8; ++i) x += n[i] * corners[i];
    return x;
  };
  Vec3 residual = residual_at(unit);
  for (int iteration = 0; iteration < 50; ++iteration) {
    Mat3 jacobian = Mat3::Zero();
    for (int i = 0; i < 8; ++i)
      for (int d = 0; d < 3; ++d) {
        double slope = 1.0;
        for (int e = 0; e < 3; ++e) {
          if (e == d) slope *= corner[i][e] ? 1.0 : -1.0;
          else slope *= corner[i][e] ? unit[e] : 1.0 - unit[e];
        }
        jacobian.col(d) += slope * corners[i];
      }
    const Vec3 downhill = -jacobian.transpose() * residual;
    Mat3 normal = jacobian.transpose() * jacobian;
    Vec3 right = downhill;
    for (int d = 0; d < 3; ++d)
      if ((unit[d] <= 0.0 && downhill[d] < 0.0) || (unit[d] >= 1.0 && downhill[d] > 0.0)) {
        const double diagonal = normal(d, d);
        normal.row(d).setZero();
        normal.col(d).setZero();
        normal(d, d) = diagonal;
        right[d] = 0.0;
      }
    const Vec3 step = normal.inverse() * right;
    const Vec3 before = unit;
    for (double length = 1.0;; length *= 0.5) {
      unit = (before + length * step).cwiseMax(0.0).cwiseMin(1.0);
      const Vec3 trial = residual_at(unit);
      if (trial.squaredNorm() <= residual.squaredNorm() || length < 1e-3) {
        residual = trial;
        break;
      }
    }
    if ((unit - before).cwiseAbs().maxCoeff() < 1e-13) break;
  }
  return {{unit[0], unit[1], unit[2]}, residual.norm()};
}

}  // namespace

std::array<double, 8> shape_values(const std::array<double, 3>& unit) {
  std::array<double, 8> values;
  for (int i = 0; i < 8; ++i) {
    values[i] = 1.0;
    for (int d = 0; d < 3; ++d) values[i] *= corner[i][d] ? unit[d] : 1.0 - unit[d];
  }
  return values;
}

Place nearest_place(const Grid& grid, const Vec3& reference_position) {
  // No point of a cell is nearer than its bounding box: cells are tried from the nearest box on.
  std::vector<std::pair<double, std::size_t>> reach(grid.cells.size());
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    Bounds box;
    for (int node : grid.cells[c]) box.include(grid.nodes[node]);
    const Vec3 nearest = reference_position.cwiseMax(box.low).cwiseMin(box.high);
    reach[c] = {(reference_position - nearest).norm(), c};
  }
  std::sort(reach.begin(), reach.end());
  Place best{0, {0, 0, 0}, std::numeric_limits<double>::infinity()};
  for (const auto& [bound, c] : reach) {
    if (bound >= best.distance) break;
    const Projection projection = project(grid, grid.cells[c], reference_position);
    if (projection.distance < best.distance) best = {c, projection.unit, projection.distance};
  }
  return best;
}

}  // namespace undex::fem
