#include "sph_solid/solid_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace undex::solid {
namespace {

/// A solid's own lattice. The rings of a tube all have as many particles: its wall is a grid, bent.
sph::Grid solid_grid(const sph::Settings& around, const Body& body, double dx) {
  sph::Grid grid = sph::cartesian(around.lattice.origin, dx, around.dimension);
  sph::fit_grid(grid, body.shape.base, dx, around.symmetry);
  if (body.lattice != sph::LatticeType::rings) return grid;
  const auto about = [&](int axis, const Vec3& center, double inner, double outer) {
    if (around.dimension < 2 || (around.dimension == 2 && axis != 2))
      throw std::invalid_argument("solid '" + body.name +
                                  "': lattice = \"rings\" needs three dimensions, or two with the axis along z");
    grid.rings = true;
    grid.axis = axis;
    for (int a = 0; a < 3; ++a)
      if (a != axis) grid.origin[a] = center[a];
    grid.ring_start = inner;
    grid.ring_width = (outer - inner) / std::max(1.0, std::round((outer - inner) / dx));
    if (inner > 0) grid.around = sph::ring_count(0.5 * (inner + outer), dx);
  };
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape.base))
    about(cylinder->axis, cylinder->center, 0.0, cylinder->radius);
  else if (const auto* tube = std::get_if<TubeShape>(&body.shape.base)) about(tube->axis, tube->center, tube->inner, tube->outer);
  else
    throw std::invalid_argument("solid '" + body.name + "': lattice = \"rings\" needs a cylinder or a tube; use \"cartesian\"");
  return grid;
}

}  // namespace

std::vector<sph::BodyParticles> fill_solids(const Settings& settings, const sph::Settings& around) {
  std::vector<sph::BodyParticles> result;
  for (const Body& body : settings.bodies)
    result.push_back(sph::fill(solid_grid(around, body, body.spacing.value_or(around.lattice.spacing)), around, body.shape,
                               "solid '" + body.name + "'"));
  return result;
}

}  // namespace undex::solid
