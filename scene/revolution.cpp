#include "scene/revolution.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "scene/faces.hpp"
#include "scene/geometry.hpp"
#include "scene/numbers.hpp"

namespace undex::scene {
namespace {

constexpr const char* letters[] = {"x", "y", "z"};

Vec3 across(Vec3 v, int axis) {
  v[axis] = 0.0;
  return v;
}

std::string words(const Vec3& x) { return "[" + rounded(x[0]) + ", " + rounded(x[1]) + ", " + rounded(x[2]) + "]"; }

/// The shapes that one is made of; null for those that are not.
const std::vector<Primitive>* parts_of(const Primitive& shape) {
  return std::visit(
      [](const auto& each) -> const std::vector<Primitive>* {
        if constexpr (requires { each.shapes; }) return &each.shapes;
        else return nullptr;
      },
      shape);
}

class Judge {
 public:
  Judge(const Scene& scene, const Meridian& meridian) : scene_(scene), line_(meridian), axis_(letters[meridian.axis]) {}

  std::vector<Objection> findings() {
    setting();
    for (const sph::Body& body : scene_.fluid.bodies) of_body(body);
    for (const sph::Wall& wall : scene_.fluid.walls) of_wall(wall);
    for (const fem::Settings& structure : scene_.structures) of_structure(structure);
    for (const solid::Body& solid : scene_.solids.bodies) of_solid(solid);
    for (const coupling::Obstacle& obstacle : scene_.obstacles) of_obstacle(obstacle);
    return std::move(found_);
  }

 private:
  void object(const std::string& key, const std::string& why) { found_.push_back({key, key + ": " + why}); }
  bool is_along(const Vec3& v) const { return across(v, line_.axis).isZero(); }
  bool is_on_axis(const Vec3& x) const {
    return across(x - line_.center, line_.axis).norm() <= 1e-9 * std::max(1e-3, x.cwiseAbs().maxCoeff());
  }
  std::string off_axis(const Vec3& x) const {
    return "its middle " + words(x) + " m lies off the axis of revolution, along " + axis_ + " through " + words(line_.center) +
           " m";
  }
  std::string wrong_axis(int axis) const {
    return std::string("its axis is \"") + letters[axis] + "\", that of revolution is \"" + axis_ + "\"";
  }

  /// Why a shape is not of revolution; empty: it is.
  std::string flaw(const Primitive& shape) const {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return is_on_axis(sphere->center) ? "" : off_axis(sphere->center);
    if (const auto* slab = std::get_if<Slab>(&shape)) return slab->axis == line_.axis ? "" : wrong_axis(slab->axis);
    const auto round = [&](const auto& s) {
      return s.axis != line_.axis ? wrong_axis(s.axis) : is_on_axis(s.center) ? std::string() : off_axis(s.center);
    };
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return round(*cylinder);
    if (const auto* tube = std::get_if<TubeShape>(&shape)) return round(*tube);
    if (const auto* cone = std::get_if<Cone>(&shape)) return round(*cone);
    if (const auto* revolution = std::get_if<Revolution>(&shape)) return round(*revolution);
    if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
      const Vec3& s = ellipsoid->semi_axes;
      if (s[(line_.axis + 1) % 3] != s[(line_.axis + 2) % 3])
        return "its semi-axes across the axis of revolution, " + axis_ + ", differ; make them equal";
      return is_on_axis(ellipsoid->center) ? "" : off_axis(ellipsoid->center);
    }
    if (const auto* half = std::get_if<HalfSpace>(&shape))
      return is_along(half->normal) ? "" : "its normal " + words(half->normal) + " is not along the axis of revolution, " + axis_;
    if (const std::vector<Primitive>* parts = parts_of(shape)) {
      for (const Primitive& part : *parts)
        if (const std::string why = flaw(part); !why.empty()) return why;
      return "";
    }
    if (std::holds_alternative<Stl>(shape)) return "a surface of triangles is not computed in a meridian; take a \"revolution\"";
    if (std::holds_alternative<Placed>(shape))
      return "a shape with `rotate` or `move` is not computed in a meridian; write it in its place";
    return "a box is no body of revolution; take a cylinder";
  }
  void of_shape(const std::string& path, const Shape& shape) {
    if (const std::string why = flaw(shape.base); !why.empty()) object(path + ".shape", why);
    for (const Primitive& removed : shape.removed)
      if (const std::string why = flaw(removed); !why.empty()) object(path + ".subtract", why);
  }

  void setting() {
    const sph::Settings& fluid = scene_.fluid;
    if (fluid.dimension != 3) {
      object("dimension", "places of an axisymmetric scene are given as in three dimensions");
      return;
    }
    if (!is_along(fluid.gravity)) object("gravity", "it must act along the axis of revolution, " + axis_);
    for (int a = 0; a < 3; ++a)
      if (a != line_.axis && fluid.symmetry.axis[a] && line_.center[a] != 0.0)
        object("symmetry.planes", std::string("the plane ") + letters[a] + " = 0 does not go through the axis of revolution");
    if (!fluid.lattice.rotation.isZero()) object("resolution.rotation", "the lattice of a meridian is not turned; leave it out");
    if (!fluid.bodies.empty() && !sph::has_rings(fluid.numerics.scheme))
      object("scheme.name", "this scheme does not compute rings; take \"riemann\", \"riemann_corrected\" or \"monaghan\"");
    if (scene_.start.kind == Start::Kind::plane_wave && scene_.start.wave.axis != line_.axis)
      object("start.axis", "the wave must run along the axis of revolution, " + axis_);
    for (std::size_t k = 0; k < scene_.solids.planes.size(); ++k)
      if (scene_.solids.planes[k].axis != line_.axis)
        object("planes." + std::to_string(k) + ".axis", "a rigid plane must lie across the axis of revolution, " + axis_);
  }

  void of_motion(const std::string& path, const std::optional<RadialMotion>& motion) {
    if (!motion) return;
    if (!is_on_axis(motion->center))
      object(path + ".radial", "its centre " + words(motion->center) + " m lies off the axis of revolution");
    if (motion->about != RadialMotion::About::point && int(motion->about) != line_.axis)
      object(path + ".radial", "it is about another axis than that of revolution, " + axis_);
  }

  void of_body(const sph::Body& body) {
    const std::string path = "bodies." + body.name;
    of_shape(path, body.shape);
    of_motion(path, body.radial);
    if (!is_along(body.velocity)) object(path + ".velocity", "it must be along the axis of revolution, " + axis_);
    if (!body.spin.isZero()) object(path + ".spin", "nothing turns in an axisymmetric scene; leave it out");
    if (body.radial_velocity != 0.0 && std::holds_alternative<TubeShape>(body.shape.base))
      object(path + ".radial_velocity", "it points away from the middle of the shape, which a tube of revolution does not have");
    if (body.burn && !body.burn->instantaneous && !is_on_axis(body.burn->origin))
      object(path + ".burn", "the initiation " + words(body.burn->origin) + " m lies off the axis of revolution");
  }

  void of_wall(const sph::Wall& wall) {
    const std::string path = "walls." + wall.name;
    if (const std::string why = flaw(wall.container); !why.empty()) object(path + ".shape", why);
    if (wall.source && !is_on_axis(*wall.source))
      object(path + ".source", "the source " + words(*wall.source) + " m lies off the axis of revolution");
    for (const auto& [face, condition] : wall.faces)
      if (condition == sph::FaceCondition::no_slip)
        object(path, "the fluid slips along walls of revolution; take \"free_slip\" (or \"open\") for the face '" + face + "'");
  }

  void of_structure(const fem::Settings& structure) {
    const std::string table = scene_.path_of(structure), path = table + ".shape";
    if (const auto* tube = std::get_if<fem::TubeMesh>(&structure.mesh)) {
      if (const std::string why = flaw(shape_of(*tube)); !why.empty()) object(path, why);
    } else if (const auto* rod = std::get_if<fem::RodMesh>(&structure.mesh)) {
      if (const std::string why = flaw(shape_of(*rod)); !why.empty()) object(path, why);
    } else if (std::holds_alternative<fem::PlateMesh>(structure.mesh)) {
      object(path, "a rectangular plate is no body of revolution; take a \"rod\", which is a disc where it is short");
    } else if (const auto& read = std::get<fem::GmshMesh>(structure.mesh).read; !read || !is_quadrangle(read->cells.at(0))) {
      object(path, "its mesh is one of hexahedra in space; mesh its meridian with quadrangles, or take \"tube\" or \"rod\"");
    }
    of_motion(table, structure.radial);
    if (!is_along(structure.initial_velocity)) object(table + ".velocity", "it must be along the axis of revolution, " + axis_);
    if (!structure.spin.isZero()) object(table + ".spin", "nothing turns in an axisymmetric scene; leave it out");
    of_supports(table, structure.supports);
    slip(structure.wet_faces.empty());
  }

  void of_supports(const std::string& path, const std::vector<Support>& supports) {
    for (const Support& support : supports) {
      const int a = (line_.axis + 1) % 3, b = (line_.axis + 2) % 3;
      if (support.fixed[a] != support.fixed[b])
        object(path + ".supports", std::string("on the face '") + support.face +
                                       "' both components across the axis of revolution are held, or neither: " + letters[a] +
                                       " and " + letters[b]);
    }
  }

  void of_solid(const solid::Body& solid) {
    const std::string path = "solids." + solid.name;
    of_shape(path, solid.shape);
    of_motion(path, solid.radial);
    of_supports(path, solid.supports);
    if (!is_along(solid.velocity)) object(path + ".velocity", "it must be along the axis of revolution, " + axis_);
    if (!solid.spin.isZero()) object(path + ".spin", "nothing turns in an axisymmetric scene; leave it out");
    if (solid.residual_stress != 0.0) object(path + ".residual_stress", "it is there for cylinders in two and three dimensions");
    slip(scene_.fluid.bodies.empty());
  }

  void of_obstacle(const coupling::Obstacle& obstacle) {
    const std::string path = "obstacles." + obstacle.name;
    if (const std::string why = flaw(obstacle.shape); !why.empty()) object(path + ".shape", why);
    if (!is_along(obstacle.velocity)) object(path + ".velocity", "it must be along the axis of revolution, " + axis_);
    if (!is_along(obstacle.direction)) object(path + ".direction", "it must be along the axis of revolution, " + axis_);
    if (!obstacle.spin.isZero()) object(path + ".spin", "nothing turns in an axisymmetric scene; leave it out");
    if (!obstacle.inertia.empty()) object(path + ".inertia", "nothing turns in an axisymmetric scene; leave it out");
  }

  void slip(bool dry) {
    if (!dry && !scene_.coupling.free_slip) object("coupling.slip", "the fluid slips along walls of revolution; take true");
  }

  const Scene& scene_;
  const Meridian& line_;
  std::string axis_;
  std::vector<Objection> found_;
};

/// The middle of a shape that is round about the axis.
std::optional<Vec3> round_about(const Primitive& shape, int axis) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return across(sphere->center, axis);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape); cylinder && cylinder->axis == axis)
    return across(cylinder->center, axis);
  if (const auto* tube = std::get_if<TubeShape>(&shape); tube && tube->axis == axis) return across(tube->center, axis);
  if (const auto* cone = std::get_if<Cone>(&shape); cone && cone->axis == axis) return across(cone->center, axis);
  return std::nullopt;
}

// ---- The meridian -----------------------------------------------------------------------------------------------------

constexpr int axial = 1;

/// The meridian of a shape of revolution; of one that meets the axis both halves, mirror images of each other.
Primitive meridian_of(const Primitive& shape, const Meridian& line) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return Sphere{Vec3(0.0, sphere->center[line.axis], 0.0), sphere->radius};
  if (const auto* slab = std::get_if<Slab>(&shape)) return Slab{axial, slab->low, slab->high};
  if (const auto* tube = std::get_if<TubeShape>(&shape))
    return Box{Vec3(tube->inner, tube->low, 0.0), Vec3(tube->outer, tube->high, 0.0)};
  if (const auto* cone = std::get_if<Cone>(&shape)) {
    Cone section = *cone;
    section.axis = axial;
    section.center.setZero();
    return section;
  }
  if (const auto* revolution = std::get_if<Revolution>(&shape)) {
    Revolution section = *revolution;
    section.axis = axial;
    section.center.setZero();
    return section;
  }
  if (const auto* e = std::get_if<Ellipsoid>(&shape))
    return Ellipsoid{Vec3(0.0, e->center[line.axis], 0.0), Vec3(e->semi_axes[(line.axis + 1) % 3], e->semi_axes[line.axis], 1.0)};
  if (const auto* half = std::get_if<HalfSpace>(&shape))
    return HalfSpace{Vec3(0.0, half->point[line.axis], 0.0), Vec3(0.0, half->normal[line.axis], 0.0)};
  if (parts_of(shape)) {
    Primitive section = shape;
    std::visit(
        [&](auto& each) {
          if constexpr (requires { each.shapes; })
            for (Primitive& part : each.shapes) part = meridian_of(part, line);
        },
        section);
    return section;
  }
  const Cylinder& cylinder = std::get<Cylinder>(shape);
  return Box{Vec3(-cylinder.radius, cylinder.low, 0.0), Vec3(cylinder.radius, cylinder.high, 0.0)};
}

Shape meridian_of(const Shape& shape, const Meridian& line) {
  Shape meridian{meridian_of(shape.base, line), {}};
  for (const Primitive& removed : shape.removed) meridian.removed.push_back(meridian_of(removed, line));
  return meridian;
}

std::shared_ptr<const sph::StartField> meridian_of(std::shared_ptr<const sph::StartField> start, const Meridian& line) {
  if (!start) return nullptr;
  auto field = std::make_shared<sph::StartField>(*start);
  field->state = [start, line](const Vec3& x, double spacing) {
    const Vec3 outward = line.outward();
    sph::StartState state = start->state(line.place_in_space(x, outward), spacing);
    state.velocity = line.vector(state.velocity, outward);
    return state;
  };
  if (start->covers) {
    field->covers = [start, line](const Vec3& x) { return start->covers(line.place_in_space(x, line.outward())); };
    const Vec3 farthest =
        across((start->box.low - line.center).cwiseAbs().cwiseMax((start->box.high - line.center).cwiseAbs()), line.axis);
    field->box = {Vec3(0.0, start->box.low[line.axis], 0.0), Vec3(farthest.norm(), start->box.high[line.axis], 0.0)};
  }
  field->momentum = Vec3(0.0, start->momentum[line.axis], 0.0);
  return field;
}

std::optional<RadialMotion> meridian_of(std::optional<RadialMotion> motion, const Meridian& line) {
  if (!motion) return motion;
  motion->center = line.place(motion->center);
  if (motion->about != RadialMotion::About::point) motion->about = RadialMotion::About(axial);
  return motion;
}

sph::Body meridian_of(const sph::Body& body, const Meridian& line) {
  sph::Body meridian = body;
  meridian.shape = meridian_of(body.shape, line);
  meridian.velocity = line.vector(body.velocity, line.outward());
  meridian.radial = meridian_of(body.radial, line);
  if (meridian.burn) meridian.burn->origin = line.place(body.burn->origin);
  if (meridian.level) *meridian.level = line.place(*body.level);
  meridian.start = meridian_of(body.start, line);
  return meridian;
}

sph::Wall meridian_of(const sph::Wall& wall, const Meridian& line) {
  sph::Wall meridian = wall;
  if (wall.source) meridian.source = line.place(*wall.source);
  meridian.container = meridian_of(wall.container, line);
  if (std::holds_alternative<Sphere>(wall.container) || std::holds_alternative<Cone>(wall.container)) return meridian;
  meridian.faces.clear();
  meridian.faces["x_low"] = sph::FaceCondition::open;  // beyond the axis
  for (const auto& [face, here] : {std::pair("side", "x_high"), {"low", "y_low"}, {"high", "y_high"}})
    if (const auto found = wall.faces.find(face); found != wall.faces.end()) meridian.faces[here] = found->second;
  return meridian;
}

/// Along r, along the axis, and round it, where nothing moves.
Support meridian_of(const Support& support, const Meridian& line) {
  return {support.face, {support.fixed[std::size_t(line.axis + 1) % 3], support.fixed[std::size_t(line.axis)], true}};
}

fem::Settings meridian_of(const fem::Settings& structure, const Meridian& line) {
  fem::Settings meridian = structure;
  meridian.axisymmetric = true;
  std::visit(
      [&](auto& mesh) {
        if constexpr (requires { mesh.axis; }) {
          mesh.axis = axial;
          mesh.center.setZero();
        }
      },
      meridian.mesh);
  const auto vector = [&](const Vec3& v) { return line.vector(v, line.outward()); };
  meridian.initial_velocity = vector(structure.initial_velocity);
  meridian.radial = meridian_of(structure.radial, line);
  meridian.gravity = vector(structure.gravity);
  for (Support& support : meridian.supports) support = meridian_of(support, line);
  meridian.symmetry_axes.clear();
  if (std::find(structure.symmetry_axes.begin(), structure.symmetry_axes.end(), line.axis) != structure.symmetry_axes.end())
    meridian.symmetry_axes.push_back(axial);
  for (RigidPlane& plane : meridian.planes) plane.axis = axial;
  return meridian;
}

solid::Body meridian_of(const solid::Body& solid, const Meridian& line) {
  solid::Body meridian = solid;
  meridian.shape = meridian_of(solid.shape, line);
  meridian.lattice = sph::LatticeType::cartesian;
  meridian.velocity = line.vector(solid.velocity, line.outward());
  meridian.radial = meridian_of(solid.radial, line);
  for (Support& support : meridian.supports) support = meridian_of(support, line);
  if (std::holds_alternative<Cone>(solid.shape.base) || has_one_face(solid.shape.base)) return meridian;
  const bool tube = std::holds_alternative<TubeShape>(solid.shape.base);
  const auto rename = [&](std::string& face) {
    if (face == "side" || face == "outer") face = std::holds_alternative<Sphere>(solid.shape.base) ? "side" : "x_high";
    else if (face == "inner" && tube) face = "x_low";
    else if (face == "low" || face == "high") face = "y_" + face;
  };
  for (std::string& face : meridian.wet) rename(face);
  for (Support& support : meridian.supports) rename(support.face);
  return meridian;
}

coupling::Obstacle meridian_of(const coupling::Obstacle& obstacle, const Meridian& line) {
  coupling::Obstacle meridian = obstacle;
  meridian.shape = meridian_of(obstacle.shape, line);
  const auto vector = [&](const Vec3& v) { return line.vector(v, line.outward()); };
  meridian.velocity = vector(obstacle.velocity);
  meridian.direction = vector(obstacle.direction);
  const bool held = std::find(obstacle.fixed.begin(), obstacle.fixed.end(), letters[line.axis]) != obstacle.fixed.end();
  meridian.fixed.clear();
  if (held) meridian.fixed.push_back(letters[axial]);
  return meridian;
}

}  // namespace

std::vector<Objection> objections(const Scene& scene, const Meridian& meridian) { return Judge(scene, meridian).findings(); }

Meridian line_along(const Scene& scene, int axis) {
  Meridian line{.axis = axis};
  const auto take = [&](const Primitive& shape) {
    const std::optional<Vec3> middle = round_about(shape, axis);
    if (middle) line.center = *middle;
    return middle.has_value();
  };
  const auto& bodies = scene.fluid.bodies;
  const auto& solids = scene.solids.bodies;
  const auto& walls = scene.fluid.walls;
  if (std::any_of(walls.begin(), walls.end(), [&](const sph::Wall& wall) { return take(wall.container); })) return line;
  if (std::any_of(bodies.begin(), bodies.end(), [&](const sph::Body& body) { return take(body.shape.base); })) return line;
  if (std::any_of(solids.begin(), solids.end(), [&](const solid::Body& solid) { return take(solid.shape.base); })) return line;
  const auto take_mesh = [&](const fem::Settings& structure) {
    return std::visit(
        [&](const auto& mesh) {
          if constexpr (requires { mesh.axis; }) return take(Primitive(shape_of(mesh)));
          else return false;
        },
        structure.mesh);
  };
  std::any_of(scene.structures.begin(), scene.structures.end(), take_mesh);
  return line;
}

int likeliest_axis(const Scene& scene) {
  int best = 2;
  std::size_t least = objections(scene, line_along(scene, best)).size();
  for (const int axis : {1, 0})
    if (const std::size_t count = objections(scene, line_along(scene, axis)).size(); count < least) {
      least = count;
      best = axis;
    }
  return best;
}

double kept_volume(const Shape& shape, const Scene& scene) {
  const auto kept = [](Bounds box, const std::array<bool, 3>& symmetric) {
    const Bounds part = kept_part(symmetric);
    return Bounds{box.low.cwiseMax(part.low), box.high.cwiseMin(part.high)};
  };
  const sph::Settings& fluid = scene.fluid;
  if (!scene.meridian) return volume(shape, kept(bounds(shape, fluid.dimension), fluid.symmetry.axis), fluid.dimension);
  const Shape meridian = meridian_of(shape, *scene.meridian);
  const bool halved = fluid.symmetry.axis[static_cast<std::size_t>(scene.meridian->axis)];
  return volume_of_revolution(meridian, kept(bounds(meridian, 2), {true, halved, false}));
}

int mirror_copies(const Scene& scene) {
  if (scene.geometry == Geometry::spherical) return 1;  // of concentric spheres all is computed
  int copies = 1;
  for (const bool plane : scene.fluid.symmetry.axis)
    if (plane) copies *= 2;
  return copies;
}

Scene for_solvers(const Scene& scene) {
  if (!scene.meridian) return scene;
  const Meridian& line = *scene.meridian;
  Scene meridian = scene;
  sph::Settings& fluid = meridian.fluid;
  fluid.dimension = 2;
  fluid.axisymmetric = true;
  fluid.gravity = line.vector(scene.fluid.gravity, line.outward());
  fluid.symmetry.axis = {true, scene.fluid.symmetry.axis[static_cast<std::size_t>(line.axis)], false};
  fluid.lattice.type = sph::LatticeType::cartesian;
  fluid.lattice.origin = Vec3(0.0, scene.fluid.lattice.origin[line.axis], 0.0);
  for (sph::Body& body : fluid.bodies) body = meridian_of(body, line);
  for (sph::Wall& wall : fluid.walls) wall = meridian_of(wall, line);
  for (fem::Settings& structure : meridian.structures) structure = meridian_of(structure, line);
  for (solid::Body& solid : meridian.solids.bodies) solid = meridian_of(solid, line);
  for (RigidPlane& plane : meridian.solids.planes) plane.axis = axial;
  for (coupling::Obstacle& obstacle : meridian.obstacles) obstacle = meridian_of(obstacle, line);
  return meridian;
}

}  // namespace undex::scene
