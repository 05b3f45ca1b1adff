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
      : draft_(draft), scene_(draft.scene), fluid_(draft.scene.fluid), dimension_(draft.scene.fluid.dimension),
        kept_(kept_part(draft.scene.fluid.symmetry.axis)) {
    if (scene_.structure && draft.structure_shape_good) solid_ = structure_shape(scene_.structure->mesh);
  }

  void run() {
    names();
    parts();
    lattice();
    if (!draft_.dimension_good) return;
    for (std::size_t i = 0; i < fluid_.bodies.size(); ++i) usable_.push_back(body(i));
    overlaps();
    walls();
    structure();
    for (std::size_t i = 0; i < scene_.probes.size(); ++i)
      if (draft_.probe_good[i]) probe(scene_.probes[i], *draft_.probe_nodes[i]);
  }

 private:
  void complain(const Node& node, const char* key, const std::string& message) {
    draft_.report.add(value_or_self(node, key), message);
  }
  double spacing_of(const sph::Body& body) const { return body.spacing.value_or(fluid_.lattice.spacing); }
  /// Overlaps and gaps below this count as none.
  double tolerance() const { return draft_.spacing_good ? 0.01 * fluid_.lattice.spacing : 1e-6; }
  double near() const { return 2 * fluid_.lattice.spacing; }

  template <class Things>
  void unique(const char* list, const Things& things, const std::vector<const Node*>& nodes) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < things.size(); ++i)
      if (!seen.insert(things[i].name).second)
        complain(*nodes[i], "name", std::string(list) + ": the name '" + things[i].name + "' is used twice; choose another one");
  }

  void names() {
    unique("bodies", fluid_.bodies, draft_.body_nodes);
    unique("walls", fluid_.walls, draft_.wall_nodes);
    unique("probes", scene_.probes, draft_.probe_nodes);
  }

  void parts() {
    if (draft_.body_nodes.empty() && !draft_.structure_node)
      draft_.report.add(draft_.root, "the scene has neither [[bodies]] nor a [structure]: there is nothing to compute; add one");
    if (draft_.body_nodes.empty() && !draft_.wall_nodes.empty())
      draft_.report.add(*draft_.wall_nodes[0], "walls without [[bodies]]: add the fluid that they hold, or remove them");
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
    if (rings && dimension_ == 1 && draft_.dimension_good)
      complain(*node, "lattice", "resolution.lattice = \"rings\" needs dimension = 2 or 3; take \"cartesian\"");
    if (lattice.fit.empty()) {
      if (rings) complain(*node, "lattice", "resolution.lattice = \"rings\" needs a round body or wall to fit; add fit = \"its name\"");
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
      complain(*node, "fit", "resolution.fit: rings need something round, and '" + lattice.fit +
                                 "' is not a cylinder, tube or sphere; take lattice = \"cartesian\"");
    }
  }

  /// Checks of one body by itself; returns whether its geometry can be compared with others'.
  bool body(std::size_t i) {
    if (!draft_.body_shape_good[i]) return false;
    const sph::Body& body = fluid_.bodies[i];
    const Node& node = *draft_.body_nodes[i];
    const std::string path = "bodies." + body.name;
    const Bounds extent = bounds(body.shape, dimension_);
    for (int a = 0; a < dimension_; ++a) {
      if (!(extent.high[a] - extent.low[a] < 1e200)) {
        complain(node, "shape", path + " has no end along " + "xyz"[a] + "; take a box instead of a slab");
        return false;
      }
      if (fluid_.symmetry.axis[a] && extent.high[a] <= 0) {
        complain(node, "shape", path + " lies wholly at " + "xyz"[a] + " <= 0, in the part that the symmetry plane leaves out; "
                                "move it to the other side");
        return false;
      }
    }
    if (draft_.spacing_good || body.spacing) {
      const double thinnest = thickness(body.shape.base, dimension_);
      if (thinnest < spacing_of(body))
        complain(node, body.spacing ? "spacing" : "shape",
                 path + " is " + rounded(thinnest) + " m at its thinnest, less than the spacing " + rounded(spacing_of(body)) +
                     " m; make the spacing smaller or the body larger");
    }
    const Bounds window = common(kept_, extent);
    const Shape base{body.shape.base, {}};
    for (std::size_t k = 0; k < body.shape.removed.size(); ++k) {
      const Shape removed{body.shape.removed[k], {}};
      if (!find_in_both(inside(base, dimension_), inside(removed, dimension_), window, 0, dimension_))
        complain(node, "subtract", path + ".subtract: the shape number " + std::to_string(k) +
                                       " (from 0) does not meet the body, it removes nothing; correct it or leave it out");
    }
    const Depth within = inside(body.shape, dimension_);
    if (!body.shape.removed.empty() && !find_in_both(within, within, window, 0, dimension_)) {
      complain(node, "subtract", path + ": its subtractions leave nothing of it; make them smaller");
      return false;
    }
    return true;
  }

  void overlaps() {
    const std::vector<sph::Body>& bodies = fluid_.bodies;
    for (std::size_t j = 0; j < bodies.size(); ++j) {
      if (!usable_[j]) continue;
      const Bounds extent = common(kept_, bounds(bodies[j].shape, dimension_));
      for (std::size_t i = 0; i < j; ++i) {
        if (!usable_[i]) continue;
        const Bounds window = common(extent, bounds(bodies[i].shape, dimension_));
        if (const auto at = find_in_both(inside(bodies[i].shape, dimension_), inside(bodies[j].shape, dimension_), window,
                                         tolerance(), dimension_))
          complain(*draft_.body_nodes[j], "shape", "bodies." + bodies[j].name + " overlaps bodies." + bodies[i].name + ", e.g. at " +
                                                       text(*at, dimension_) + " m; move one, or write subtract = [\"" +
                                                       bodies[j].name + "\"] in bodies." + bodies[i].name);
      }
      if (!solid_ || dimension_ != 3) continue;
      const Shape solid{*solid_, {}};
      const Bounds window = common(extent, bounds(solid, 3));
      if (const auto at = find_in_both(inside(solid, 3), inside(bodies[j].shape, 3), window, tolerance(), 3))
        complain(*draft_.body_nodes[j], "shape", "bodies." + bodies[j].name + " overlaps the structure, e.g. at " + text(*at, 3) +
                                                     " m; make it end at the structure's face");
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
        const auto at = find_in_both(inside(body.shape, dimension_), outside(container, dimension_), window, tolerance(), dimension_);
        if (!at) contained = true;
        else if (!out) out = at;
      }
      if (contained) continue;
      std::vector<std::string> containers;
      for (const sph::Wall& wall : fluid_.walls) containers.push_back("'" + wall.name + "'");
      complain(*draft_.body_nodes[i], "shape", "bodies." + body.name + " reaches outside the wall " + listed(containers) + ", e.g. at " +
                                                   text(*out, dimension_) + " m; make it smaller or the wall larger");
    }
  }

  void structure() {
    if (!draft_.structure_node || dimension_ != 3) return;
    const Node& node = *draft_.structure_node;
    const fem::Settings& structure = *scene_.structure;
    if (solid_) mirrored_structure(node);
    const bool fluid = !fluid_.bodies.empty();
    if (fluid && structure.wet_faces.empty())
      complain(node, "wet", "structure.wet is empty, so the water does not see the structure; name the faces that it touches, "
                            "e.g. wet = [\"inner\"]");
    if (draft_.body_nodes.empty() && !structure.wet_faces.empty())
      complain(node, "wet", "structure.wet names faces, but the scene has no [[bodies]]; add the water or leave out wet");
    if (!fluid || !solid_ || !draft_.spacing_good || std::find(usable_.begin(), usable_.end(), false) != usable_.end()) return;
    for (const std::string& face : structure.wet_faces) {
      const std::vector<Vec3> points = face_points(structure.mesh, face);
      const bool touched = points.empty() || std::any_of(points.begin(), points.end(), [&](const Vec3& x) {
        for (const int axis : structure.symmetry_axes)
          if (x[axis] < -tolerance()) return false;
        return std::any_of(fluid_.bodies.begin(), fluid_.bodies.end(), [&](const sph::Body& body) {
          return signed_distance(body.shape, x, 3) <= near();
        });
      });
      if (!touched)
        complain(node, "wet", "structure.wet: the face '" + face + "' touches no water: no body comes within two spacings (" +
                                  rounded(near()) + " m) of it; move the water or the structure, or leave the face out");
    }
  }

  /// A symmetry plane that meets a structure must halve it.
  void mirrored_structure(const Node& node) {
    const Bounds extent = bounds(*solid_, 3);
    for (const int axis : scene_.structure->symmetry_axes) {
      const double low = extent.low[axis], high = extent.high[axis];
      if (low >= 0 || std::abs(low + high) <= 1e-9 * (high - low)) continue;
      complain(node, "shape", std::string("structure: the symmetry plane ") + "xyz"[axis] + " = 0 does not halve it (it runs from " +
                                  rounded(low) + " to " + rounded(high) + " m); centre the whole structure on the plane");
    }
  }

  void probe(const Probe& probe, const Node& node) {
    const std::string path = "probes." + probe.name;
    for (int a = 0; a < dimension_; ++a)
      if (fluid_.symmetry.axis[a] && probe.point[a] < -1e-9) {
        complain(node, "point", path + ".point lies at " + "xyz"[a] + " < 0, in the part that the symmetry plane leaves out; mirror it");
        return;
      }
    if (probe.kind == Probe::Kind::structure) {
      if (!draft_.structure_node) {
        complain(node, "kind", path + " is a structure probe, but the scene has no [structure]; add one or change kind");
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
    if (!draft_.spacing_good || std::find(usable_.begin(), usable_.end(), false) != usable_.end()) return;
    for (std::size_t w = 0; w < fluid_.walls.size(); ++w)
      if (!draft_.wall_shape_good[w]) return;
    const bool gmsh = scene_.structure && !solid_;
    if (probe.kind == Probe::Kind::wall) {
      const bool wet = scene_.structure && !scene_.structure->wet_faces.empty();
      if (fluid_.walls.empty() && !wet && !gmsh) {
        complain(node, "kind", path + " is a wall probe, but the scene has neither [[walls]] nor a wet face; take kind = \"fluid\"");
        return;
      }
      double away = 1e300;
      for (const sph::Wall& wall : fluid_.walls)
        away = std::min(away, std::abs(signed_distance(wall.container, probe.point, dimension_)));
      if (solid_ && dimension_ == 3) away = std::min(away, std::abs(signed_distance(*solid_, probe.point, 3)));
      if (away > near() && !gmsh)
        complain(node, "point", path + ".point is " + rounded(away) + " m away from every wall, more than two spacings; move it to the wall");
      return;
    }
    double away = 1e300;
    for (const sph::Body& body : fluid_.bodies) away = std::min(away, signed_distance(body.shape, probe.point, dimension_));
    for (const sph::Wall& wall : fluid_.walls)
      away = std::min(away, signed_distance(wall.container, probe.point, dimension_));
    if (away > near())
      complain(node, "point", path + ".point lies outside everything: " + rounded(away) + " m from the nearest fluid or wall; move it");
  }

  Draft& draft_;
  Scene& scene_;
  sph::Settings& fluid_;
  int dimension_;
  Bounds kept_;
  std::optional<Primitive> solid_;
  std::vector<bool> usable_;
};

}  // namespace

void validate(Draft& draft) { Validator(draft).run(); }

}  // namespace undex::scene
