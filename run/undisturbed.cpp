#include "run/undisturbed.hpp"

#include <algorithm>
#include <cmath>

#include "scene/opened.hpp"
#include "scene/structure_shape.hpp"

namespace undex::run {
namespace {

bool same_wall(const sph::Wall& one, const sph::Wall& other) {
  return same_shape(one.container, other.container) && one.faces == other.faces;
}

/// What the first scene has and the second has not. What leaves the scene that is laid over through radiating faces stays what it
/// is in the donor's larger water; what lies beyond a donor's is not known.
void add_of(const scene::Scene& scene, const scene::Scene& other, const std::string& whose, bool is_donor,
            std::vector<Undisturbed>& found) {
  const int dimension = scene.fluid.dimension;
  const auto surface = [&](const std::string& name, const Primitive& shape) {
    const Primitive kept = is_donor ? shape : scene::without_radiating_faces(shape, scene.fluid);
    if (signed_distance(kept, middle(shape, dimension), dimension) > -0.5 * scene::endless)
      found.push_back({name + whose, [=](const Vec3& x) { return std::abs(signed_distance(kept, x, dimension)); }});
  };
  for (const sph::Wall& wall : scene.fluid.walls)
    if (std::none_of(other.fluid.walls.begin(), other.fluid.walls.end(), [&](const auto& one) { return same_wall(wall, one); }))
      surface("wall '" + wall.name + "'", wall.container);
  const auto has = [&](const Primitive& shape) {
    return std::any_of(other.fluid.bodies.begin(), other.fluid.bodies.end(), [&](const sph::Body& body) {
      return same_shape(shape, body.shape.base) || std::any_of(body.shape.removed.begin(), body.shape.removed.end(),
                                                               [&](const Primitive& hole) { return same_shape(shape, hole); });
    });
  };
  for (const sph::Body& body : scene.fluid.bodies) {
    if (!has(body.shape.base)) surface("the outside of body '" + body.name + "'", body.shape.base);
    for (const Primitive& hole : body.shape.removed)
      if (!has(hole)) surface("what is subtracted from body '" + body.name + "'", hole);
    if (std::none_of(other.fluid.bodies.begin(), other.fluid.bodies.end(), [&](const auto& b) { return b.name == body.name; }))
      found.push_back({"body '" + body.name + "'" + whose,
                       [shape = body.shape, dimension](const Vec3& x) { return signed_distance(shape, x, dimension); }});
  }
  for (const solid::Body& solid : scene.solids.bodies)
    found.push_back({"solid '" + solid.name + "'" + whose,
                     [shape = solid.shape, dimension](const Vec3& x) { return signed_distance(shape, x, dimension); }});
  for (const coupling::Obstacle& obstacle : scene.obstacles)
    found.push_back({"obstacle '" + obstacle.name + "'" + whose,
                     [shape = obstacle.shape, dimension](const Vec3& x) { return signed_distance(shape, x, dimension); }});
  for (const fem::Settings& structure : scene.structures) {
    const auto shape = scene::structure_shape(structure.mesh, scene.meridian);
    if (!shape) continue;
    const bool whole = shape->built_in().has_value();
    const std::array<bool, 3> planes = scene.fluid.symmetry.axis;
    const std::string name = scene.structures_listed ? "structure '" + structure.name + "'" : "the structure";
    found.push_back({name + whose, [=](Vec3 x) {
                       for (int a = 0; a < 3; ++a)
                         if (!whole && planes[a]) x[a] = std::abs(x[a]);
                       return shape->signed_distance(x);
                     }});
  }
}

}  // namespace

bool same_shape(const Shape& one, const Shape& other) {
  if (!same_shape(one.base, other.base) || one.removed.size() != other.removed.size()) return false;
  return std::all_of(one.removed.begin(), one.removed.end(), [&](const Primitive& hole) {
    return std::any_of(other.removed.begin(), other.removed.end(),
                       [&](const Primitive& there) { return same_shape(hole, there); });
  });
}

std::vector<Undisturbed> not_shared_by(const scene::Scene& scene, const scene::Scene& donor) {
  std::vector<Undisturbed> found;
  add_of(scene, donor, "", false, found);
  add_of(donor, scene, " of the donor", true, found);
  return found;
}

}  // namespace undex::run
