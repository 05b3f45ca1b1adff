// How deep a place lies within the closed faces of a scene's walls.
#pragma once

#include "sph_fluid/water/fluid.hpp"

namespace undex::coupling {

/// The least distance [m] from a place to the planes, cylinders, cones and spheres of the closed faces of one wall, negative
/// beyond one; of several walls that of the one in which it lies deepest. Endless without walls.
double depth_in_walls(const Vec3& x, const sph::Settings& fluid);

}  // namespace undex::coupling
