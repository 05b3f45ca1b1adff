#include "sph_fluid/walls/line_walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "sph_fluid/lattice.hpp"
#include "sph_fluid/lattice_grid.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::sph {
namespace {

/// Which faces of the container the point lies beyond, and the outward normal there.
struct Beyond {
  std::vector<std::string> faces;
  Vec3 normal = Vec3::Zero();  // behind an edge, the edge's direction
  double distance = 0;
};

Beyond beyond(const Primitive& container, const Vec3& x, int dimension) {
  static const char* const low_name[3] = {"x_low", "y_low", "z_low"};
  static const char* const high_name[3] = {"x_high", "y_high", "z_high"};
  Beyond result;
  Vec3 away = Vec3::Zero();
  if (const auto* box = std::get_if<Box>(&container)) {
    for (int a = 0; a < dimension; ++a) {
      if (x[a] < box->low[a]) {
        result.faces.push_back(low_name[a]);
        away[a] = x[a] - box->low[a];
      }
      if (x[a] > box->high[a]) {
        result.faces.push_back(high_name[a]);
        away[a] = x[a] - box->high[a];
      }
    }
  } else if (const auto* cylinder = std::get_if<Cylinder>(&container)) {
    return beyond(Cone{.axis = cylinder->axis,
                       .center = cylinder->center,
                       .low_radius = cylinder->radius,
                       .high_radius = cylinder->radius,
                       .low = cylinder->low,
                       .high = cylinder->high},
                  x, dimension);
  } else if (const auto* cone = std::get_if<Cone>(&container)) {
    Vec3 radial = x - cone->center;
    radial[cone->axis] = 0.0;
    for (int a = dimension; a < 3; ++a) radial[a] = 0.0;
    const double r = radial.norm(), z = x[cone->axis], radius = cone->radius_at(z);
    if (r > radius) {
      // Along the side's normal; straight away from the axis where it does not widen.
      const double slope = (cone->high_radius - cone->low_radius) / (cone->high - cone->low);
      const double share = (r - radius) / (1.0 + slope * slope);
      result.faces.push_back("side");
      away += radial * (share / r);
      away[cone->axis] -= slope * share;
    }
    if (cone->axis < dimension) {
      if (z < cone->low) {
        result.faces.push_back("low");
        away[cone->axis] = z - cone->low;
      }
      if (z > cone->high) {
        result.faces.push_back("high");
        away[cone->axis] = z - cone->high;
      }
    }
  } else if (const auto* sphere = std::get_if<Sphere>(&container)) {
    const Vec3 radial = x - sphere->center;
    const double r = radial.norm();
    if (r > sphere->radius) {
      result.faces.push_back("side");
      away = radial * ((r - sphere->radius) / r);
    }
  } else {
    throw std::invalid_argument("a wall must be a box, a cylinder, a cone or a sphere");
  }
  result.distance = away.norm();
  const int faces = int(result.faces.size());
  if (faces == 1 && result.distance > 0) result.normal = away / result.distance;
  if (faces == 2 && dimension == 3) {
    Vec3 first = Vec3::Zero(), second = Vec3::Zero();
    if (std::holds_alternative<Box>(container)) {
      for (int a = 0; a < 3; ++a)
        if (away[a] != 0.0) (first.isZero() ? first : second)[a] = 1.0;
    } else {
      const int axis = std::get<Cone>(container).axis;
      first[axis] = 1.0;
      second = away - away.dot(first) * first;
    }
    result.normal = first.cross(second).normalized();
  }
  return result;
}

}  // namespace

std::vector<LinedWall> line_walls(const Settings& settings) {
  std::vector<LinedWall> result(2);
  result[0].free_slip = true;
  result[1].free_slip = false;
  if (settings.walls.empty()) return {};
  const Grid grid = scene_grid(settings);
  const double dx = settings.lattice.spacing;
  const double depth = std::max(3.0 * dx, kernel_support(settings.numerics.kernel) * smoothing_length(settings, dx));
  for (const Wall& wall : settings.walls) {
    Bounds box = bounds(wall.container, settings.dimension);
    box.low.array() -= depth;
    box.high.array() += depth;
    walk(grid, settings, box, [&](const Vec3& x, double cell_volume) {
      const Beyond place = beyond(wall.container, x, settings.dimension);
      if (place.faces.empty() || place.distance >= depth) return;
      FaceCondition condition = FaceCondition::free_slip;
      bool radiates = false;
      for (const std::string& face : place.faces) {
        const auto found = wall.faces.find(face);
        const FaceCondition here = found == wall.faces.end() ? FaceCondition::free_slip : found->second;
        if (here == FaceCondition::open) return;
        radiates = radiates || here == FaceCondition::radiating;
        if (here == FaceCondition::no_slip) condition = here;
      }
      if (condition == FaceCondition::free_slip && (radiates || mirrors_fluid(settings.numerics.scheme))) return;
      LinedWall& out = result[condition == FaceCondition::no_slip ? 1 : 0];
      out.position.push_back(x);
      out.normal.push_back(place.normal);
      // In two dimensions an edge is a corner: nothing slips along it.
      out.faces_before.push_back(place.faces.size() == 2 && settings.dimension == 2 ? 3 : int(place.faces.size()));
      out.volume.push_back(cell_volume);
    });
  }
  for (LinedWall& wall : result) {
    wall.velocity.assign(wall.position.size(), Vec3::Zero());
    wall.impulse.assign(wall.position.size(), Vec3::Zero());
  }
  std::erase_if(result, [](const LinedWall& wall) { return wall.position.empty(); });
  return result;
}

}  // namespace undex::sph
