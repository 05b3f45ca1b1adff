// Bodies and materials that several tests of the structure share.
#pragma once

#include <Eigen/LU>

#include <cmath>
#include <string>

#include "fem_structure/elements.hpp"
#include "fem_structure/grid.hpp"
#include "fem_structure/structure.hpp"

namespace undex::fem::testing {

inline materials::Solid elastic(double density, double young, double poisson) {
  materials::Solid solid;
  solid.name = "elastic";
  solid.rho0 = density;
  solid.shear_modulus = young / (2.0 * (1.0 + poisson));
  solid.pressure = materials::LinearPressure{young / (3.0 * (1.0 - 2.0 * poisson))};
  solid.flow = materials::Elastic{};
  return solid;
}

inline materials::Solid hardening(double density, double young, double poisson, double Y0, double H) {
  materials::Solid solid = elastic(density, young, poisson);
  solid.flow = materials::LinearHardening{Y0, H};
  return solid;
}

inline Settings plate(const Vec3& low, const Vec3& high, std::array<int, 3> cells, const materials::Solid& material) {
  Settings settings;
  settings.mesh = PlateMesh{low, high, cells};
  settings.material = material;
  return settings;
}

/// Takes the cells' volumes anew, after nodes have been moved.
inline void take_volumes(Grid& grid) {
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    grid.nodal_volume[c].fill(0.0);
    for (int q = 0; q < 8; ++q) {
      Mat3 jacobian = Mat3::Zero();
      for (int i = 0; i < 8; ++i)
        for (int d = 0; d < 3; ++d) jacobian.col(d) += grid.nodes[grid.cells[c][i]] * grid.reference.gradient[d][i][q];
      for (int i = 0; i < 8; ++i)
        grid.nodal_volume[c][i] += grid.reference.value[i][q] * grid.reference.weight[q] * jacobian.determinant();
    }
  }
}

/// Moves the nodes off their places by up to `size` [m], reproducibly.
inline void distort(Grid& grid, double size) {
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    for (int d = 0; d < 3; ++d) grid.nodes[i][d] += size * std::sin(12.9 * (i + 1) + 78.2 * (d + 1));
  take_volumes(grid);
}

/// Moves every node to map(its place).
template <class Map>
void remap(Grid& grid, const Map& map) {
  for (Vec3& x : grid.nodes) x = map(x);
  take_volumes(grid);
}

inline Grid distorted_block(std::array<int, 3> cells, double size) {
  Grid grid = Mesher(plate(Vec3(0, 0, 0), Vec3(cells[0], cells[1], cells[2]), cells, elastic(1, 1, 0.3))).grid();
  distort(grid, size);
  return grid;
}

}  // namespace undex::fem::testing
