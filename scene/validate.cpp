// What single keys cannot tell: names used twice or not known, geometry that does not fit together, probes in nowhere.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/geometry.hpp"
#include "scene/numbers.hpp"
#include "scene/structure_shape.hpp"
#include "scene/suggestion.hpp"

namespace undex::scene {
namespace {

std::string text(const Vec3& x, int dimension) {
  std::string words = "[";
  for (int a = 0; a < dimension; ++a) words += (a ? ", " : "") + rounded(x[a]);
  return words + "]";
}

const Node& value_or_self(const Node& node, const char* key) {
  const Node* found = node.find(key);
  return found ? *found : node;
}

class Validator {
 public:
  explicit Validator(Draft& draft)
      : draft_(draft),
        scene_(draft.scene),
        fluid_(draft.scene.fluid),
        dimension_(draft.scene.fluid.dimension),
        kept_(kept_part(draft.scene.fluid.symmetry.axis)) {
    if (scene_.structure && draft.structure_shape_good) solid_ = structure_shape(scene_.structure->mesh);
  }

  void run() {
    names();
    parts();
    lattice();
    if (!draft_.dimension_good) return;
    collect();
    gravity();
    for (const Part& each : parts_) usable_.push_back(part(each));
    overlaps();
    walls();
    structure();
    solids();
    planes();
    for (std::size_t i = 0; i < scene_.probes.size(); ++i)
      if (draft_.probe_good[i]) probe(scene_.probes[i], *draft_.probe_nodes[i]);
  }

 private:
  void complain(const Node& node, const char* key, const std::string& message) {
    draft_.report.add(value_or_self(node, key), message);
  }

  /// A body of fluid or a solid in particles: geometry treats them alike. The bodies come first.
  struct Part {
    std::string list, name;
    const Shape* shape;
    std::optional<double> spacing;
    const Node* node;
    bool shape_good;

    std::string path() const { return list + '.' + name; }
  };
  void collect() {
    for (std::size_t i = 0; i < fluid_.bodies.size(); ++i) {
      const sph::Body& body = fluid_.bodies[i];
      parts_.push_back({.list = "bodies",
                        .name = body.name,
                        .shape = &body.shape,
                        .spacing = body.spacing,
                        .node = draft_.body_nodes[i],
                        .shape_good = draft_.body_shape_good[i]});
    }
    for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) {
      const solid::Body& solid = scene_.solids.bodies[i];
      parts_.push_back({.list = "solids",
                        .name = solid.name,
                        .shape = &solid.shape,
                        .spacing = solid.spacing,
                        .node = draft_.solid_nodes[i],
                        .shape_good = draft_.solid_shape_good[i]});
    }
  }
  bool all_usable() const { return std::find(usable_.begin(), usable_.end(), false) == usable_.end(); }
  /// Overlaps and gaps below this count as none.
  double tolerance() const { return draft_.spacing_good ? 0.01 * fluid_.lattice.spacing : 1e-6; }
  double near() const { return 2 * fluid_.lattice.spacing; }
  bool touches_water(const Vec3& x) const {
    return std::any_of(fluid_.bodies.begin(), fluid_.bodies.end(),
                       [&](const sph::Body& body) { return signed_distance(body.shape, x, dimension_) <= near(); });
  }

  template <class Things>
  void unique(const char* list, const Things& things, const std::vector<const Node*>& nodes) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < things.size(); ++i)
      if (!seen.insert(things[i].name).second)
        complain(*nodes[i], "name", std::string(list) + ": the name '" + things[i].name + "' is used twice; choose another one");
  }

  void names() {
    unique("bodies", fluid_.bodies, draft_.body_nodes);
    unique("solids", scene_.solids.bodies, draft_.solid_nodes);
    for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i)
      for (const sph::Body& body : fluid_.bodies)
        if (body.name == scene_.solids.bodies[i].name)
          complain(*draft_.solid_nodes[i], "name", "solids: the name '" + body.name + "' is that of a body; choose another one");
    unique("walls", fluid_.walls, draft_.wall_nodes);
    unique("probes", scene_.probes, draft_.probe_nodes);
  }

  void parts() {
    const bool solids = !draft_.solid_nodes.empty();
    if (draft_.body_nodes.empty() && !draft_.structure_node && !solids)
      draft_.report.add(
          draft_.root, "the scene has neither [[bodies]] nor [[solids]] nor a [structure]: there is nothing to compute; add one");
    if (solids && draft_.structure_node)
      draft_.report.add(*draft_.structure_node,
                        "[structure] and [[solids]] in one scene are not built: a scene's deforming bodies are "
                        "either finite elements or particles; remove one of the two");
    if (solids && draft_.dimension_good && dimension_ == 1)
      draft_.report.add(*draft_.solid_nodes[0],
                        "[[solids]] need dimension = 2 (plane strain) or 3, but the scene has dimension = 1");
    if (!solids && !draft_.structure_node && !draft_.plane_nodes.empty())
      draft_.report.add(*draft_.plane_nodes[0],
                        "[[planes]] stop solids only, and the scene has neither [[solids]] nor a [structure]; for fluid "
                        "take [[walls]]");
    if (draft_.body_nodes.empty() && !draft_.wall_nodes.empty())
      draft_.report.add(*draft_.wall_nodes[0], "walls without [[bodies]]: add the fluid that they hold, or remove them");
  }

  void gravity() {
    if (fluid_.gravity.isZero()) return;
    // A plane that cuts nothing is a wall; there the image may fall the other way.
    const auto cut = [&](int a) {
      if (solid_ && bounds(*solid_, dimension_).low[a] < -tolerance()) return true;
      for (const Part& part : parts_)
        if (part.shape_good && bounds(*part.shape, dimension_).low[a] < -tolerance()) return true;
      return false;
    };
    for (int a = 0; a < 3; ++a)
      if (fluid_.symmetry.axis[a] && fluid_.gravity[a] != 0 && cut(a))
        complain(draft_.root, "gravity",
                 std::string("gravity is not its own mirror image across the symmetry plane ") + "xyz"[a] +
                     " = 0, which cuts a body; leave that plane out, or that component of gravity");
    if (scene_.start.kind == Start::Kind::spherical)
      complain(draft_.root, "gravity",
               "gravity does not go with start.kind = \"spherical\", whose flow is computed without it; take \"plain\"");
  }

  void lattice() {
    const sph::Lattice& lattice = fluid_.lattice;
    if (const Node* scheme = draft_.root.find("scheme");
        scheme && fluid_.numerics.precision == sph::Precision::mixed && draft_.spacing_good && lattice.spacing < 2e-5)
      complain(*scheme, "precision",
               "scheme.precision = \"mixed\" needs a resolution.spacing of at least 2e-05 m: finer lengths leave the range of "
               "single precision; take \"full\"");
    const Node* node = draft_.root.find("resolution");
    if (!node) return;
    const bool rings = lattice.type == sph::LatticeType::rings;
    if (!lattice.rotation.isZero() && (rings || !lattice.fit.empty() || dimension_ == 1) && draft_.dimension_good)
      complain(*node, "rotation",
               std::string("resolution.rotation turns a Cartesian lattice that is not fitted, in 2D and 3D; leave out ") +
                   (dimension_ == 1 ? "rotation"
                    : rings         ? "lattice = \"rings\""
                                    : "fit") +
                   " or rotation");
    if (rings && dimension_ == 1 && draft_.dimension_good)
      complain(*node, "lattice", "resolution.lattice = \"rings\" needs dimension = 2 or 3; take \"cartesian\"");
    if (lattice.fit.empty()) {
      if (rings)
        complain(*node, "lattice", "resolution.lattice = \"rings\" needs a round body or wall to fit; add fit = \"its name\"");
      return;
    }
    std::vector<std::string> known;
    const Primitive* fitted = nullptr;
    for (const sph::Body& body : fluid_.bodies) {
      known.push_back(body.name);
      if (body.name == lattice.fit) fitted = &body.shape.base;
    }
    for (const sph::Wall& wall : fluid_.walls) {
      known.push_back(wall.name);
      if (wall.name == lattice.fit) fitted = &wall.container;
    }
    if (!fitted) {
      complain(*node, "fit", "resolution.fit: no body or wall '" + lattice.fit + "'" + suggestion(lattice.fit, known));
    } else if (rings && !std::holds_alternative<Cylinder>(*fitted) && !std::holds_alternative<TubeShape>(*fitted) &&
               !std::holds_alternative<Sphere>(*fitted)) {
      complain(*node, "fit",
               "resolution.fit: rings need something round, and '" + lattice.fit +
                   "' is not a cylinder, tube or sphere; take lattice = \"cartesian\"");
    }
  }

  /// Checks of one body or solid by itself; returns whether its geometry can be compared with others'.
  bool part(const Part& one) {
    if (!one.shape_good) return false;
    const Shape& shape = *one.shape;
    const Node& node = *one.node;
    const std::string path = one.path();
    const Bounds extent = bounds(shape, dimension_);
    for (int a = 0; a < dimension_; ++a) {
      if (!(extent.high[a] - extent.low[a] < 1e200)) {
        complain(node, "shape", path + " has no end along " + "xyz"[a] + "; take a box instead of a slab");
        return false;
      }
      if (fluid_.symmetry.axis[a] && extent.high[a] <= 0) {
        complain(node, "shape",
                 path + " lies wholly at " + "xyz"[a] +
                     " <= 0, in the part that the symmetry plane leaves out; "
                     "move it to the other side");
        return false;
      }
    }
    if (draft_.spacing_good || one.spacing) {
      const double spacing = one.spacing.value_or(fluid_.lattice.spacing);
      const double thinnest = thickness(shape.base, dimension_);
      if (thinnest < spacing)
        complain(node, one.spacing ? "spacing" : "shape",
                 path + " is " + rounded(thinnest) + " m at its thinnest, less than the spacing " + rounded(spacing) +
                     " m; make the spacing smaller or the body larger");
    }
    const Bounds window = common(kept_, extent);
    const Shape base{shape.base, {}};
    for (std::size_t k = 0; k < shape.removed.size(); ++k) {
      const Shape removed{shape.removed[k], {}};
      if (!find_in_both(inside(base, dimension_), inside(removed, dimension_), window, 0, dimension_))
        complain(node, "subtract",
                 path + ".subtract: the shape number " + std::to_string(k) +
                     " (from 0) does not meet the body, it removes nothing; correct it or leave it out");
    }
    const Depth within = inside(shape, dimension_);
    if (!shape.removed.empty() && !find_in_both(within, within, window, 0, dimension_)) {
      complain(node, "subtract", path + ": its subtractions leave nothing of it; make them smaller");
      return false;
    }
    return true;
  }

  void overlaps() {
    for (std::size_t j = 0; j < parts_.size(); ++j) {
      if (!usable_[j]) continue;
      const Part& later = parts_[j];
      const Bounds extent = common(kept_, bounds(*later.shape, dimension_));
      for (std::size_t i = 0; i < j; ++i) {
        if (!usable_[i]) continue;
        const Part& first = parts_[i];
        const Bounds window = common(extent, bounds(*first.shape, dimension_));
        if (const auto at =
                find_in_both(inside(*first.shape, dimension_), inside(*later.shape, dimension_), window, tolerance(), dimension_))
          complain(*later.node, "shape",
                   later.path() + " overlaps " + first.path() + ", e.g. at " + text(*at, dimension_) +
                       " m; move one, or write subtract = [\"" + later.name + "\"] in " + first.path());
      }
      if (!solid_ || dimension_ != 3) continue;
      const Shape solid{*solid_, {}};
      const Bounds window = common(extent, bounds(solid, 3));
      if (const auto at = find_in_both(inside(solid, 3), inside(*later.shape, 3), window, tolerance(), 3))
        complain(*later.node, "shape",
                 later.path() + " overlaps the structure, e.g. at " + text(*at, 3) + " m; make it end at the structure's face");
    }
  }

  /// The container, without end where its faces are open.
  static Primitive opened(const sph::Wall& wall) {
    const auto open = [&](const std::string& face) {
      const auto found = wall.faces.find(face);
      return found != wall.faces.end() && found->second == sph::FaceCondition::open;
    };
    constexpr double far = 1e6;
    if (const auto* box = std::get_if<Box>(&wall.container)) {
      Box larger = *box;
      for (int a = 0; a < 3; ++a) {
        if (open(std::string(1, "xyz"[a]) + "_low")) larger.low[a] = -far;
        if (open(std::string(1, "xyz"[a]) + "_high")) larger.high[a] = far;
      }
      return larger;
    }
    Cylinder larger = std::get<Cylinder>(wall.container);
    if (open("side")) larger.radius = far;
    if (open("low")) larger.low = -far;
    if (open("high")) larger.high = far;
    return larger;
  }

  void walls() {
    for (std::size_t w = 0; w < fluid_.walls.size(); ++w)
      if (!draft_.wall_shape_good[w]) return;
    if (fluid_.walls.empty()) return;
    for (std::size_t i = 0; i < fluid_.bodies.size(); ++i) {
      if (!usable_[i]) continue;
      const sph::Body& body = fluid_.bodies[i];
      const Bounds window = common(kept_, bounds(body.shape, dimension_));
      std::optional<Vec3> out;
      bool contained = false;
      for (const sph::Wall& wall : fluid_.walls) {
        const Shape container{opened(wall), {}};
        const auto at =
            find_in_both(inside(body.shape, dimension_), outside(container, dimension_), window, tolerance(), dimension_);
        if (!at) contained = true;
        else if (!out) out = at;
      }
      if (contained) continue;
      std::vector<std::string> containers;
      for (const sph::Wall& wall : fluid_.walls) containers.push_back("'" + wall.name + "'");
      complain(*draft_.body_nodes[i], "shape",
               "bodies." + body.name + " reaches outside the wall " + listed(containers) + ", e.g. at " + text(*out, dimension_) +
                   " m; make it smaller or the wall larger");
    }
  }

  void structure() {
    if (!draft_.structure_node || dimension_ != 3) return;
    const Node& node = *draft_.structure_node;
    const fem::Settings& structure = *scene_.structure;
    if (solid_) halved("structure", node, *solid_);
    const bool fluid = !fluid_.bodies.empty();
    if (fluid && structure.wet_faces.empty())
      complain(node, "wet",
               "structure.wet is empty, so the water does not see the structure; name the faces that it touches, "
               "e.g. wet = [\"inner\"]");
    if (draft_.body_nodes.empty() && !structure.wet_faces.empty())
      complain(node, "wet", "structure.wet names faces, but the scene has no [[bodies]]; add the water or leave out wet");
    if (fluid && solid_ && draft_.spacing_good && all_usable())
      for (const std::string& face : structure.wet_faces) wet_face("structure", node, *solid_, face);
  }

  void wet_face(const std::string& path, const Node& node, const Primitive& shape, const std::string& face) {
    const std::vector<Vec3> points = face_points(shape, face);
    const bool touched = points.empty() || std::any_of(points.begin(), points.end(), [&](const Vec3& x) {
                           for (int a = 0; a < dimension_; ++a)
                             if (fluid_.symmetry.axis[a] && x[a] < -tolerance()) return false;
                           return touches_water(x);
                         });
    if (!touched)
      complain(node, "wet",
               path + ".wet: the face '" + face + "' touches no water: no body comes within two spacings (" + rounded(near()) +
                   " m) of it; move the water or the " + (path == "structure" ? "structure" : "solid") +
                   ", or leave the face out");
  }

  void solids() {
    const bool fluid = !draft_.body_nodes.empty();
    for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) {
      if (!usable_[fluid_.bodies.size() + i]) continue;
      const solid::Body& solid = scene_.solids.bodies[i];
      const Node& node = *draft_.solid_nodes[i];
      const std::string path = "solids." + solid.name;
      halved(path, node, solid.shape.base);
      const Bounds extent = bounds(solid.shape, dimension_);
      for (int a = 0; a < dimension_; ++a) {
        if (!fluid_.symmetry.axis[a] || extent.low[a] >= 0) continue;
        Vec3 mirrored = solid.spin;  // mirrors turn a spin about any other axis round
        mirrored[a] = 0;
        if (solid.velocity[a] != 0 || mirrored.norm() > 0) {
          complain(node, solid.velocity[a] != 0 ? "velocity" : "spin",
                   path + ": its motion is not its own mirror image across the symmetry plane " + "xyz"[a] +
                       " = 0; change the motion or leave the plane out");
        }
      }
      if (!solid.wet.empty() && !fluid)
        complain(node, "wet", path + ".wet names faces, but the scene has no [[bodies]]; add the water or leave out wet");
      if (solid.wet.empty() && fluid && scene_.coupling.solids == coupling::SolidContact::surface)
        complain(node, "wet",
                 path +
                     ".wet is empty, but coupling.solids = \"surface\" couples by wet faces; name those that the "
                     "water touches");
      const bool drawn =
          dimension_ == 3 || is_round(solid.shape.base, dimension_) || std::holds_alternative<Box>(solid.shape.base);
      if (fluid && drawn && draft_.spacing_good && all_usable())
        for (const std::string& face : solid.wet) wet_face(path, node, solid.shape.base, face);
    }
  }

  /// No solid may start beyond a rigid plane.
  void planes() {
    for (std::size_t k = 0; k < scene_.solids.planes.size(); ++k) {
      const RigidPlane& plane = scene_.solids.planes[k];
      if (plane.axis >= dimension_) continue;
      for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) {
        if (!usable_[fluid_.bodies.size() + i]) continue;
        const Bounds extent = common(kept_, bounds(scene_.solids.bodies[i].shape, dimension_));
        const double beyond =
            plane.body_above ? plane.position - extent.low[plane.axis] : extent.high[plane.axis] - plane.position;
        if (beyond > tolerance())
          complain(*draft_.plane_nodes[k], "position",
                   "planes." + std::to_string(k) + ": solids." + scene_.solids.bodies[i].name + " starts " + rounded(beyond) +
                       " m beyond the plane " + "xyz"[plane.axis] + " = " + rounded(plane.position) + ", whose free side is " +
                       (plane.body_above ? "above" : "below") + "; move one of them");
      }
    }
  }

  /// A symmetry plane that meets a structure or a solid must halve it.
  void halved(const std::string& path, const Node& node, const Primitive& shape) {
    const Bounds extent = bounds(shape, dimension_);
    for (int axis = 0; axis < dimension_; ++axis) {
      const double low = extent.low[axis], high = extent.high[axis];
      if (!fluid_.symmetry.axis[axis] || low >= 0 || std::abs(low + high) <= 1e-9 * (high - low)) continue;
      complain(node, "shape",
               path + ": the symmetry plane " + "xyz"[axis] + " = 0 does not halve it (it runs from " + rounded(low) + " to " +
                   rounded(high) + " m); centre the whole " + (path == "structure" ? "structure" : "solid") + " on the plane");
    }
  }

  double distance_to_solids(const Vec3& x) const {
    double away = 1e300;
    for (const solid::Body& solid : scene_.solids.bodies) away = std::min(away, signed_distance(solid.shape, x, dimension_));
    return away;
  }

  void probe(const Probe& probe, const Node& node) {
    const std::string path = "probes." + probe.name;
    for (int a = 0; a < dimension_; ++a)
      if (fluid_.symmetry.axis[a] && probe.point[a] < -1e-9) {
        complain(node, "point",
                 path + ".point lies at " + "xyz"[a] + " < 0, in the part that the symmetry plane leaves out; mirror it");
        return;
      }
    if (probe.kind == Probe::Kind::structure) {
      if (!draft_.structure_node && draft_.solid_nodes.empty()) {
        complain(node, "kind",
                 path + " is a structure probe, but the scene has no [structure] and no [[solids]]; add one or change kind");
      } else if (!draft_.solid_nodes.empty() && all_usable()) {
        double thinnest = 1e300;
        for (const solid::Body& solid : scene_.solids.bodies)
          thinnest = std::min(thinnest, thickness(solid.shape.base, dimension_));
        if (const double away = distance_to_solids(probe.point); away > 0.1 * thinnest)
          complain(node, "point", path + ".point is " + rounded(away) + " m away from every solid; move it onto one");
      } else if (solid_ && dimension_ == 3) {
        const double away = signed_distance(*solid_, probe.point, 3);
        if (away > 0.1 * thickness(*solid_, 3))
          complain(node, "point", path + ".point is " + rounded(away) + " m away from the structure; move it onto it");
      }
      return;
    }
    if (draft_.body_nodes.empty()) {
      complain(node, "kind", path + " reads the fluid, but the scene has no [[bodies]]; add the fluid or change kind");
      return;
    }
    if (!draft_.spacing_good || !all_usable()) return;
    for (std::size_t w = 0; w < fluid_.walls.size(); ++w)
      if (!draft_.wall_shape_good[w]) return;
    const bool gmsh = scene_.structure && !solid_;
    if (probe.kind == Probe::Kind::wall) {
      const bool wet = scene_.structure && !scene_.structure->wet_faces.empty();
      if (fluid_.walls.empty() && !wet && !gmsh && scene_.solids.bodies.empty()) {
        complain(
            node, "kind",
            path + " is a wall probe, but the scene has neither [[walls]] nor a wet face nor [[solids]]; take kind = \"fluid\"");
        return;
      }
      double away = 1e300;
      for (const sph::Wall& wall : fluid_.walls)
        away = std::min(away, std::abs(signed_distance(wall.container, probe.point, dimension_)));
      if (solid_ && dimension_ == 3) away = std::min(away, std::abs(signed_distance(*solid_, probe.point, 3)));
      away = std::min(away, std::abs(distance_to_solids(probe.point)));
      if (away > near() && !gmsh)
        complain(node, "point",
                 path + ".point is " + rounded(away) + " m away from every wall, more than two spacings; move it to the wall");
      return;
    }
    double away = 1e300;
    for (const sph::Body& body : fluid_.bodies) away = std::min(away, signed_distance(body.shape, probe.point, dimension_));
    for (const sph::Wall& wall : fluid_.walls) away = std::min(away, signed_distance(wall.container, probe.point, dimension_));
    if (away > near())
      complain(node, "point",
               path + ".point lies outside everything: " + rounded(away) + " m from the nearest fluid or wall; move it");
  }

  Draft& draft_;
  Scene& scene_;
  sph::Settings& fluid_;
  int dimension_;
  Bounds kept_;
  std::optional<Primitive> solid_;  // of the [structure]
  std::vector<Part> parts_;
  std::vector<bool> usable_;  // beside parts_: can it be compared with others?
};

}  // namespace

void validate(Draft& draft) { Validator(draft).run(); }

}  // namespace undex::scene
