#include "coupling/wall_depth.hpp"

#include <algorithm>
#include <cmath>

namespace undex::coupling {
namespace {

double depth_in(const sph::Wall& wall, const Vec3& x, int dimension) {
  double least = 1e300;
  const auto face = [&](const std::string& name, double depth) {
    const auto found = wall.faces.find(name);
    if (found != wall.faces.end() && found->second != sph::FaceCondition::open) least = std::min(least, depth);
  };
  const auto radius = [&](const Vec3& center, int axis) {
    double square = 0;
    for (int a = 0; a < dimension; ++a)
      if (a != axis) square += (x[a] - center[a]) * (x[a] - center[a]);
    return std::sqrt(square);
  };
  if (const auto* box = std::get_if<Box>(&wall.container)) {
    for (int a = 0; a < dimension; ++a) {
      face(std::string(1, "xyz"[a]) + "_low", x[a] - box->low[a]);
      face(std::string(1, "xyz"[a]) + "_high", box->high[a] - x[a]);
    }
  } else if (const auto* sphere = std::get_if<Sphere>(&wall.container)) {
    face("side", sphere->radius - radius(sphere->center, -1));
  } else if (const auto* cone = std::get_if<Cone>(&wall.container)) {
    const double rise = (cone->high_radius - cone->low_radius) / (cone->high - cone->low);
    face("side", (cone->radius_at(x[cone->axis]) - radius(cone->center, cone->axis)) / std::hypot(1.0, rise));
    face("low", x[cone->axis] - cone->low);
    face("high", cone->high - x[cone->axis]);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&wall.container)) {
    if (dimension > 1 || cylinder->axis != 0) face("side", cylinder->radius - radius(cylinder->center, cylinder->axis));
    if (cylinder->axis < dimension) {
      face("low", x[cylinder->axis] - cylinder->low);
      face("high", cylinder->high - x[cylinder->axis]);
    }
  }
  return least;
}

}  // namespace

double depth_in_walls(const Vec3& x, const sph::Settings& fluid) {
  if (fluid.walls.empty()) return 1e300;
  double deepest = -1e300;
  for (const sph::Wall& wall : fluid.walls) deepest = std::max(deepest, depth_in(wall, x, fluid.dimension));
  return deepest;
}

}  // namespace undex::coupling
