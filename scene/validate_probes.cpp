// Probes in nowhere.
#include "scene/validator.hpp"

namespace undex::scene {

double Validator::distance_to_solids(const Vec3& x) const {
  double away = 1e300;
  for (const solid::Body& solid : scene_.solids.bodies) away = std::min(away, signed_distance(solid.shape, x, dimension_));
  return away;
}

/// The structure that a probe names, or the only one.
void Validator::on_structure(const Probe& probe, const Node& node) {
  const std::string path = "probes." + probe.name;
  const Structure* on = structures_.size() == 1 ? &structures_.front() : nullptr;
  std::vector<std::string> names;
  for (const Structure& each : structures_) {
    names.push_back(each.settings->name);
    if (probe.structure && *probe.structure == each.settings->name) on = &each;
    if (!each.shape) return;  // what is wrong with it is said elsewhere
  }
  if (probe.structure && (!on || *probe.structure != on->settings->name))
    return complain(node, "structure",
                    path + ".structure: no structure '" + *probe.structure + "'" + suggestion(*probe.structure, names));
  if (!on) {
    const auto nearest = std::min_element(structures_.begin(), structures_.end(), [&](const Structure& a, const Structure& b) {
      return a.shape->signed_distance(probe.point) < b.shape->signed_distance(probe.point);
    });
    return complain(node, "point",
                    path + ": the scene has several structures; name the one that the probe lies on, e.g. structure = " +
                        quoted(nearest->settings->name) + ", the nearest");
  }
  const double away = on->shape->signed_distance(probe.point);
  if (away > 0.1 * on->shape->thickness())
    complain(node, "point", path + ".point is " + rounded(away) + " m away from " + on->named() + "; move it onto it");
}

/// output.histories with "one_dimensional": one spherical charge or bubble in the one medium from which it is taken.
void Validator::one_dimensional() {
  if (!scene_.output.wants("one_dimensional") || !all_usable()) return;
  const Node* output = draft_.root.find("output");
  const auto refuse = [&](const std::string& why) {
    complain(output ? *output : draft_.root, "histories", "output.histories with \"one_dimensional\" " + why);
  };
  const auto& bodies = fluid_.bodies;
  const auto is_charge = [&](const sph::Body& body) {
    if (!scene_.start.body.empty() && body.name != scene_.start.body) return false;
    return body.variable_h && body.shape.removed.empty() && std::holds_alternative<Sphere>(body.shape.base);
  };
  const auto charge = std::find_if(bodies.begin(), bodies.end(), is_charge);
  if (dimension_ != 3 || scene_.geometry == Geometry::plane || charge == bodies.end() ||
      std::count_if(bodies.begin(), bodies.end(), is_charge) != 1)
    return refuse("needs space and one spherical body of gas or products; leave the word out, or name the charge by start.body");
  const Sphere& sphere = std::get<Sphere>(charge->shape.base);
  const bool surrounded = std::any_of(bodies.begin(), bodies.end(), [&](const sph::Body& body) {
    return std::any_of(body.shape.removed.begin(), body.shape.removed.end(), [&](const Primitive& hole) {
      const auto* other = std::get_if<Sphere>(&hole);
      return other && other->center == sphere.center && other->radius == sphere.radius;
    });
  });
  if (!surrounded) return refuse("needs the medium round bodies." + charge->name + ", whose `subtract` names it");
  for (const Probe& one : scene_.probes)
    for (const Probe& other : scene_.probes)
      if (one.kind == Probe::Kind::fluid && other.name == one.name + "_1d")
        return refuse("writes history/" + other.name + ".csv, which is that of a probe; give the probe another name");
}

void Validator::probe(const Probe& probe, const Node& node) {
  const std::string path = "probes." + probe.name;
  for (int a = 0; a < dimension_; ++a)
    if (fluid_.symmetry.axis[a] && probe.point[a] < -1e-9) {
      complain(node, "point",
               path + ".point lies at " + "xyz"[a] + " < 0, in the part that the symmetry plane leaves out; mirror it");
      return;
    }
  if (probe.structure && (probe.kind != Probe::Kind::structure || structures_.empty())) {
    complain(node, "structure", path + ".structure is of probes of kind = \"structure\" on [[structures]]; leave it out");
    return;
  }
  if (probe.kind == Probe::Kind::structure) {
    if (structures_.empty() && draft_.solid_nodes.empty()) {
      complain(node, "kind",
               path + " is a structure probe, but the scene has no [structure] and no [[solids]]; add one or change kind");
    } else if (!draft_.solid_nodes.empty() && all_usable()) {
      double thinnest = 1e300;
      for (const solid::Body& solid : scene_.solids.bodies)
        thinnest = std::min(thinnest, thickness(solid.shape.base, dimension_));
      if (const double away = distance_to_solids(probe.point); away > 0.1 * thinnest)
        complain(node, "point", path + ".point is " + rounded(away) + " m away from every solid; move it onto one");
    } else if (dimension_ == 3 && !structures_.empty()) {
      on_structure(probe, node);
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
  if (probe.kind == Probe::Kind::wall) {
    const auto unread = [](const Structure& each) { return !each.shape; };
    if (std::any_of(structures_.begin(), structures_.end(), unread)) return;  // what is wrong with it is said elsewhere
    const bool wet =
        std::any_of(structures_.begin(), structures_.end(), [](const auto& each) { return !each.settings->wet_faces.empty(); });
    if (fluid_.walls.empty() && !wet && scene_.solids.bodies.empty() && scene_.obstacles.empty()) {
      complain(node, "kind",
               path +
                   " is a wall probe, but the scene has neither [[walls]] nor a wet face nor [[solids]] nor [[obstacles]]; take "
                   "kind = \"fluid\"");
      return;
    }
    double away = 1e300;
    for (const sph::Wall& wall : fluid_.walls)
      away = std::min(away, std::abs(signed_distance(wall.container, probe.point, dimension_)));
    for (const Structure& each : structures_)
      if (dimension_ == 3) away = std::min(away, std::abs(each.shape->signed_distance(probe.point)));
    away = std::min(away, std::abs(distance_to_solids(probe.point)));
    for (const coupling::Obstacle& obstacle : scene_.obstacles)
      away = std::min(away, std::abs(signed_distance(obstacle.shape, probe.point, dimension_)));
    if (away > near())
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

}  // namespace undex::scene
