// What single keys cannot tell: names used twice or not known, parts that are missing. The rest by subject in validate_*.cpp.
#include "scene/validator.hpp"

#include <set>

namespace undex::scene {
namespace {

const Node& value_or_self(const Node& node, const char* key) {
  const Node* found = node.find(key);
  return found ? *found : node;
}

}  // namespace

std::string text(const Vec3& x, int dimension) {
  std::string words = "[";
  for (int a = 0; a < dimension; ++a) words += (a ? ", " : "") + rounded(x[a]);
  return words + "]";
}

Validator::Validator(Draft& draft)
    : draft_(draft),
      scene_(draft.scene),
      fluid_(draft.scene.fluid),
      dimension_(draft.scene.fluid.dimension),
      kept_(kept_part(draft.scene.fluid.symmetry.axis)) {
  for (std::size_t i = 0; i < scene_.structures.size(); ++i) {
    const fem::Settings& each = scene_.structures[i];
    structures_.push_back({.path = scene_.path_of(each), .settings = &each, .node = draft.structure_nodes[i], .shape = {}});
    if (draft.structure_shape_good[i]) structures_.back().shape = structure_shape(each.mesh, scene_.meridian);
  }
}

void Validator::run() {
  names();
  parts();
  if (on_a_line(scene_.geometry)) {
    times();
    return line();
  }
  lattice();
  times();
  if (!draft_.dimension_good) return;
  collect();
  gravity();
  for (const Part& each : parts_) usable_.push_back(part(each));
  const std::size_t before = draft_.report.size();
  sizes();
  if (draft_.report.size() > before) return;  // what is far too large is not searched for overlaps
  overlaps();
  walls();
  structures();
  solids();
  mirrors();
  motions();
  planes();
  obstacles();
  thin_walls();
  radiating();
  start_time();
  for (std::size_t i = 0; i < scene_.probes.size(); ++i)
    if (draft_.probe_good[i]) probe(scene_.probes[i], *draft_.probe_nodes[i]);
  one_dimensional();
}

void Validator::complain(const Node& node, const char* key, const std::string& message) {
  draft_.report.add(value_or_self(node, key), message);
}

void Validator::warn(const Node& node, const char* key, const std::string& message) {
  draft_.warnings.add(value_or_self(node, key), message);
}

void Validator::collect() {
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

bool Validator::all_usable() const { return std::find(usable_.begin(), usable_.end(), false) == usable_.end(); }

/// Overlaps and gaps below this count as none.
double Validator::tolerance() const { return draft_.spacing_good ? 0.01 * fluid_.lattice.spacing : 1e-6; }

double Validator::distance_to_water(const Vec3& x) const {
  double away = 1e300;
  for (const sph::Body& body : fluid_.bodies) away = std::min(away, signed_distance(body.shape, x, dimension_));
  return away;
}

bool Validator::in_kept_part(const Vec3& x) const {
  for (int a = 0; a < dimension_; ++a)
    if (fluid_.symmetry.axis[a] && x[a] < -tolerance()) return false;
  return true;
}

namespace {

/// The names that come a second time.
template <class Things>
std::vector<std::size_t> repeated(const Things& things) {
  std::set<std::string> seen;
  std::vector<std::size_t> second;
  for (std::size_t i = 0; i < things.size(); ++i)
    if (!seen.insert(things[i].name).second) second.push_back(i);
  return second;
}

}  // namespace

void Validator::names() {
  const auto unique = [&](const char* list, const auto& things, const std::vector<const Node*>& nodes) {
    for (const std::size_t i : repeated(things))
      complain(*nodes[i], "name", list + (": the name '" + things[i].name) + "' is used twice; choose another one");
  };
  unique("bodies", fluid_.bodies, draft_.body_nodes);
  unique("solids", scene_.solids.bodies, draft_.solid_nodes);
  if (scene_.structures_listed) unique("structures", scene_.structures, draft_.structure_nodes);
  unique("obstacles", scene_.obstacles, draft_.obstacle_nodes);
  for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i)
    for (const sph::Body& body : fluid_.bodies)
      if (body.name == scene_.solids.bodies[i].name)
        complain(*draft_.solid_nodes[i], "name", "solids: the name '" + body.name + "' is that of a body; choose another one");
  unique("walls", fluid_.walls, draft_.wall_nodes);
  unique("probes", scene_.probes, draft_.probe_nodes);
  unique("lines", scene_.lines, draft_.line_nodes);
}

void Validator::parts() {
  const bool solids = !draft_.solid_nodes.empty();
  if (draft_.body_nodes.empty() && structures_.empty() && !solids)
    draft_.report.add(draft_.root,
                      "the scene has neither [[bodies]] nor [[solids]] nor a [structure]: there is nothing to compute; add one");
  if (solids && !structures_.empty())
    draft_.report.add(*structures_.front().node,
                      "[structure] and [[solids]] in one scene are not built: a scene's deforming bodies are "
                      "either finite elements or particles; remove one of the two");
  if (solids && draft_.dimension_good && dimension_ == 1 && scene_.geometry != Geometry::plane)
    draft_.report.add(*draft_.solid_nodes[0],
                      "[[solids]] need dimension = 2 (plane strain) or 3, but the scene has dimension = 1");
  if (!solids && structures_.empty() && !draft_.plane_nodes.empty())
    draft_.report.add(*draft_.plane_nodes[0],
                      "[[planes]] stop solids only, and the scene has neither [[solids]] nor a [structure]; for fluid "
                      "take [[walls]]");
  if (draft_.body_nodes.empty() && !draft_.wall_nodes.empty())
    draft_.report.add(*draft_.wall_nodes[0], "walls without [[bodies]]: add the fluid that they hold, or remove them");
}

void validate(Draft& draft) { Validator(draft).run(); }

}  // namespace undex::scene
