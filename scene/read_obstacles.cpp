// [[obstacles]]: rigid bodies in the water, for which its bodies leave room.
#include <algorithm>

#include "scene/draft.hpp"
#include "scene/geometry.hpp"
#include "scene/record_reader.hpp"

namespace undex::scene {
namespace {

using coupling::Motion;
using coupling::Obstacle;

/// Keys that mean nothing with this motion.
void refuse_idle_keys(const TableReader& table, const Obstacle& obstacle) {
  const auto refuse = [&](std::initializer_list<const char*> keys, const std::string& of) {
    for (const char* key : keys)
      if (table.has(key))
        table.complain(key, table.path_of(key) + " is of a " + of + " body, and motion = \"" + word_of(obstacle.motion) +
                                "\"; leave it out or change the motion");
  };
  if (obstacle.motion != Motion::free) refuse({"density", "mass", "inertia", "fixed", "velocity", "spin", "force"}, "\"free\"");
  if (obstacle.motion != Motion::prescribed) refuse({"speed"}, "\"prescribed\"");
  if (obstacle.motion == Motion::fixed) refuse({"direction", "time"}, "moving");
}

Obstacle read_obstacle(const Node& node, const std::string& path, Draft& draft, bool& good, std::size_t index) {
  const TableReader table(node, path, "obstacles", draft.scene.fluid.dimension, draft.report);
  const std::size_t before = draft.report.size();
  Obstacle obstacle;
  obstacle.name = std::to_string(index);
  read_fields(table, obstacle);
  if (const Node* shape = table.find("shape"))
    read_shape(*shape, table.path_of("shape"), draft, ShapeUse::bounded, obstacle.shape);
  if (draft.report.size() == before) refuse_idle_keys(table, obstacle);
  good = draft.report.size() == before;
  return obstacle;
}

/// Has the body's shape no part of this one left?
bool leaves_room(const Shape& body, const Primitive& shape, const Scene& scene) {
  const int dimension = scene.fluid.dimension;
  const Shape base{body.base, {}}, obstacle{shape, {}};
  const Bounds window = common(kept_part(scene.fluid.symmetry.axis), bounds(base, dimension));
  return !find_in_both(inside(base, dimension), inside(obstacle, dimension), window, 0, dimension) ||
         std::any_of(body.removed.begin(), body.removed.end(), [&](const Primitive& hole) { return same_shape(hole, shape); });
}

}  // namespace

void read_obstacles(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  const auto nodes = top.tables("obstacles");
  Scene& scene = draft.scene;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    bool good = false;
    scene.obstacles.push_back(read_obstacle(*nodes[i], element_path("obstacles", *nodes[i], i), draft, good, i));
    draft.obstacle_nodes.push_back(nodes[i]);
    draft.obstacle_good.push_back(good);
  }
  Bounds water;
  for (std::size_t b = 0; b < scene.fluid.bodies.size(); ++b)
    if (draft.body_shape_good[b]) water.include(bounds(scene.fluid.bodies[b].shape, top.dimension()));
  const double most = water.empty() ? 0.0 : most_lengths_of_water * longest(water, top.dimension());
  // Also those that walls of any shape have become, and none that is in other units (validate_obstacles.cpp).
  for (std::size_t i = 0; i < scene.obstacles.size() && draft.dimension_good; ++i) {
    if (!draft.obstacle_good[i]) continue;
    const Primitive& shape = scene.obstacles[i].shape;
    if (longest(bounds(shape, top.dimension()), top.dimension()) > most) continue;
    for (std::size_t b = 0; b < scene.fluid.bodies.size(); ++b)
      if (draft.body_shape_good[b] && !leaves_room(scene.fluid.bodies[b].shape, shape, scene))
        scene.fluid.bodies[b].shape.removed.push_back(shape);
  }
}

}  // namespace undex::scene
