// Walls with radiating faces: what they need to know of the water behind them.
#include "scene/validator.hpp"

namespace undex::scene {
namespace {

/// Has the container faces that can move?
bool may_radiate(const Primitive& container, Geometry geometry, int dimension) {
  if (geometry == Geometry::spherical) return std::holds_alternative<Sphere>(container);
  if (std::holds_alternative<Box>(container)) return true;
  if (dimension == 1) return false;
  const auto* cylinder = std::get_if<Cylinder>(&container);
  return std::holds_alternative<Sphere>(container) || (cylinder && (dimension == 3 || cylinder->axis == 2));
}

}  // namespace

void Validator::radiating() {
  for (std::size_t w = 0; w < fluid_.walls.size(); ++w) {
    const sph::Wall& wall = fluid_.walls[w];
    const Node& node = *draft_.wall_nodes[w];
    if (!draft_.wall_shape_good[w]) continue;
    if (wall.radiates()) radiating(wall, node);
    else if (wall.source)
      complain(node, "source", "walls." + wall.name + ".source means nothing without radiating faces; leave it out");
  }
}

void Validator::radiating(const sph::Wall& wall, const Node& node) {
  const std::string path = "walls." + wall.name;
  if (fluid_.numerics.scheme == sph::SchemeName::paper && !on_a_line(scene_.geometry))
    complain(node, "condition",
             path +
                 ": a radiating face mirrors the water, and scheme.name = \"paper\" lines walls with dummy particles; take "
                 "\"riemann\", or \"open\" faces");
  if (!may_radiate(wall.container, scene_.geometry, dimension_)) {
    complain(node, "condition",
             path + ": radiating faces are those of boxes, cylinders and spheres (in two dimensions of boxes and circles)");
    return;
  }
  const auto* cylinder = std::get_if<Cylinder>(&wall.container);
  const auto* sphere = std::get_if<Sphere>(&wall.container);
  for (int a = 0; a < dimension_; ++a) {
    if (!fluid_.symmetry.axis[a] || !(cylinder || sphere) || (cylinder && cylinder->axis == a)) continue;
    if (std::abs((cylinder ? cylinder->center : sphere->center)[a]) > tolerance())
      complain(node, "condition",
               path + ": a round wall that radiates has its middle on the symmetry planes; that across " + "xyz"[a] +
                   " does not go through it");
  }
  if (wall.source && signed_distance(wall.container, *wall.source, dimension_) > 0.0)
    complain(
        node, "source",
        path + ".source = " + text(*wall.source, dimension_) + " m lies outside the wall; waves that leave come from inside");
  if (fluid_.gravity.isZero()) return;
  for (const sph::Body& body : fluid_.bodies)
    if (!body.level && !body.variable_h)
      complain(node, "condition",
               path + ": behind a radiating face stands the water at rest, but under gravity bodies." + body.name +
                   " is not: give it a level and a pressure there");
}

}  // namespace undex::scene
