// Scenes that are run on the one-dimensional mesh: layers that touch, nothing that acts across the line, and what belongs to
// particles alone.
#include "scene/line.hpp"
#include "scene/validator.hpp"

namespace undex::scene {

void Validator::line() {
  const std::string words = std::string("dimension = \"") + word_of(scene_.geometry) + "\"";
  off_the_line(words);
  std::vector<bool> good;
  for (const auto* shapes : {&draft_.body_shape_good, &draft_.solid_shape_good, &draft_.wall_shape_good})
    good.insert(good.end(), shapes->begin(), shapes->end());
  if (std::find(good.begin(), good.end(), false) != good.end()) return;
  const Line line = line_of(scene_);
  for (const LineFlaw& flaw : line.flaws) {
    const auto& nodes = flaw.list == "bodies"   ? draft_.body_nodes
                        : flaw.list == "solids" ? draft_.solid_nodes
                                                : draft_.wall_nodes;
    complain(*nodes[flaw.index], flaw.key, flaw.message);
  }
  if (!line.flaws.empty() || line.layers.empty()) return;
  if (line.graded && !line.rests_ahead && line.held >= 1e6)
    warn(draft_.root, "dimension",
         "what lies round the charge does not rest uniformly until its wave comes, for it moves, stands under gravity or begins "
         "at "
         "pressures that differ by more than " +
             rounded(line.held) + " Pa: the wave's front is smeared over some cells and the run is slower");
  cells_of(line);
  burns_on(line, words);
  for (std::size_t i = 0; i < scene_.probes.size(); ++i)
    if (draft_.probe_good[i]) probe_on(line, scene_.probes[i], *draft_.probe_nodes[i]);
  of_particles(words);
}

/// What one coordinate does not have.
void Validator::off_the_line(const std::string& words) {
  const bool spherical = scene_.geometry == Geometry::spherical;
  if (!structures_.empty())
    draft_.report.add(*structures_.front().node,
                      words + " has no finite elements; write the structure as a layer, in [[solids]]");
  if (!draft_.obstacle_nodes.empty())
    draft_.report.add(*draft_.obstacle_nodes[0],
                      "[[obstacles]] do not go with " + words +
                          "; take [[solids]] as a rigid layer's stand-in, or dimension = 1, whose particles meet obstacles");
  if (spherical && !fluid_.gravity.isZero())
    complain(draft_.root, "gravity",
             "gravity has a direction, which " + words +
                 " does not; leave it out, and give the water the pressure of the charge's depth");
  if (!draft_.plane_nodes.empty())
    draft_.report.add(*draft_.plane_nodes[0], "[[planes]] do not go with " + words + "; take [[walls]] at an end");
  if (const Node* start = draft_.root.find("start")) {
    if (scene_.start.kind == Start::Kind::spherical || scene_.start.kind == Start::Kind::run)
      complain(*start, "kind",
               std::string("start.kind = \"") + word_of(scene_.start.kind) + "\" means nothing with " + words +
                   ": the whole run is one-dimensional; leave it out");
    if (scene_.start.kind == Start::Kind::plane_wave && (spherical || scene_.start.wave.axis != 0))
      complain(*start, "kind", "start.kind = \"plane_wave\" needs dimension = \"plane\" and axis = \"x\"");
  }
  for (std::size_t i = 0; i < fluid_.bodies.size(); ++i) {
    const sph::Body& body = fluid_.bodies[i];
    const Node& node = *draft_.body_nodes[i];
    if (spherical && !body.velocity.isZero())
      complain(node, "velocity",
               "bodies." + body.name + ".velocity has a direction, which " + words + " does not; take radial_velocity");
    if (!body.spin.isZero()) complain(node, "spin", "bodies." + body.name + ".spin does not go with " + words + "; leave it out");
    if (!spherical && body.radial_velocity != 0)
      complain(node, "radial_velocity",
               "bodies." + body.name + ".radial_velocity has no middle with " + words + "; take velocity");
  }
  for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) {
    const solid::Body& solid = scene_.solids.bodies[i];
    const Node& node = *draft_.solid_nodes[i];
    const std::string path = "solids." + solid.name;
    if (spherical && !solid.velocity.isZero())
      complain(node, "velocity", path + ".velocity has a direction, which " + words + " does not; leave it out");
    if (!solid.spin.isZero()) complain(node, "spin", path + ".spin does not go with " + words + "; leave it out");
    if (!solid.supports.empty())
      complain(node, "supports", path + ".supports do not go with " + words + ", whose ends rest; leave them out");
    if (solid.residual_stress != 0)
      complain(node, "residual_stress", path + ".residual_stress does not go with " + words + "; leave it out");
  }
}

void Validator::cells_of(const Line& line) {
  constexpr double most_cells = 1e6;
  const double spacing = fluid_.lattice.spacing, core = line.core_high - line.core_low;
  const Node* resolution = draft_.root.find("resolution");
  const Node& node = resolution ? *resolution : draft_.root;
  const double cells = (line.outer() - line.inner()) / line.cell_width(line.outer(), spacing);
  if (cells > most_cells)
    complain(node, "spacing",
             "resolution.spacing = " + shortest(spacing) + " [m] makes about " + rounded(cells) + " cells, more than " +
                 rounded(most_cells) + "; take a larger one, or leave it out");
  constexpr double few = 100;
  if (core / spacing < few)
    warn(node, "spacing",
         "resolution.spacing = " + shortest(spacing) + " [m] makes " + rounded(std::max(1.0, std::round(core / spacing))) +
             " cells in the core, from " + rounded(line.core_low) + " to " + rounded(line.core_high) +
             " m, where a wave wants some hundreds; leave it out for 400");
}

/// A front that is a sphere or a plane.
void Validator::burns_on(const Line& line, const std::string& words) {
  if (scene_.geometry != Geometry::spherical) return;
  for (const LineLayer& layer : line.layers) {
    if (layer.is_solid) continue;
    const sph::Body& body = fluid_.bodies[layer.index];
    if (!body.burn || body.burn->instantaneous) continue;
    if (layer.inner > 0 || (body.burn->origin - line.center).norm() > 1e-6 * layer.outer)
      complain(*draft_.body_nodes[layer.index], "burn",
               "bodies." + body.name + ".burn: with " + words +
                   " the front is a sphere that begins in the middle of the innermost body; initiate it there, or take "
                   "burn = \"instantaneous\"");
  }
}

void Validator::probe_on(const Line& line, const Probe& probe, const Node& node) {
  const bool spherical = scene_.geometry == Geometry::spherical;
  const std::string path = "probes." + probe.name;
  const double at = spherical ? (probe.point - line.center).norm() : probe.point[0];
  const double slack = 1e-6 * (line.outer() - line.inner());
  if (at < line.inner() - slack || at > line.outer() + slack)
    return complain(node, "point",
                    path + ".point lies at " + rounded(at) + " m, outside of the layers, which go from " + rounded(line.inner()) +
                        " to " + rounded(line.outer()) + " m; move it");
  const auto in_solid = [&](double slack_of_end) {
    return std::any_of(line.layers.begin(), line.layers.end(), [&](const LineLayer& layer) {
      return layer.is_solid && at >= layer.inner - slack_of_end && at <= layer.outer + slack_of_end;
    });
  };
  if (probe.kind == Probe::Kind::structure && !in_solid(slack))
    complain(node, "point",
             path + ".point lies in no solid, and the probe's kind is \"structure\"; move it, or take another kind");
  if (probe.kind != Probe::Kind::wall) return;
  double away = 1e300;
  for (const LineLayer& layer : line.layers)
    if (layer.is_solid) away = std::min({away, std::abs(at - layer.inner), std::abs(at - layer.outer)});
  if (line.closed[0]) away = std::min(away, std::abs(at - line.inner()));
  if (line.closed[1]) away = std::min(away, std::abs(at - line.outer()));
  if (away > near())
    complain(node, "point",
             path + ".point is " + rounded(away) + " m away from every wall and solid, more than two cells; move it there");
}

/// Keys that a mesh has no use for, in one warning.
void Validator::of_particles(const std::string& words) {
  std::vector<std::string> unused;
  const auto look = [&](const Node* table, const std::string& path, std::initializer_list<const char*> keys) {
    if (!table) return;
    for (const char* key : keys)
      if (table->find(key)) unused.push_back(path + "." + key);
  };
  look(draft_.root.find("resolution"), "resolution", {"lattice", "fit", "origin", "rotation", "jitter"});
  for (const char* name : {"scheme", "solid_scheme", "coupling"})
    if (const Node* table = draft_.root.find(name))
      for (const Entry& entry : table->entries) unused.push_back(std::string(name) + "." + entry.key);
  for (std::size_t i = 0; i < fluid_.bodies.size(); ++i)
    look(draft_.body_nodes[i], "bodies." + fluid_.bodies[i].name, {"spacing"});
  for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) {
    look(draft_.solid_nodes[i], "solids." + scene_.solids.bodies[i].name, {"spacing"});
    if (!scene_.solids.bodies[i].wet.empty()) unused.push_back("solids." + scene_.solids.bodies[i].name + ".wet");
  }
  if (!unused.empty())
    warn(draft_.root, "dimension",
         words + " is run on a mesh without particles, for which these keys mean nothing: " + listed(unused));
}

}  // namespace undex::scene
