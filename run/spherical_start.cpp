#include "run/spherical_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/errors.hpp"
#include "exact/lagrangian_1d.hpp"
#include "sph_fluid/lattice.hpp"

namespace undex::run {
namespace {

constexpr int cells_in_charge = 250;

[[noreturn]] void refuse(const scene::Scene& scene, const std::string& why) {
  throw SceneError(scene.file.string(), {scene.places.finding("start.kind", "start.kind = \"spherical\": " + why)});
}

bool same_sphere(const Primitive& shape, const Sphere& sphere) {
  const auto* other = std::get_if<Sphere>(&shape);
  return other && other->center == sphere.center && other->radius == sphere.radius;
}

std::size_t find_charge(const scene::Scene& scene) {
  const auto& bodies = scene.fluid.bodies;
  std::size_t charge = bodies.size();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const sph::Body& body = bodies[i];
    if (!scene.start.body.empty() ? body.name != scene.start.body : !body.variable_h) continue;
    if (!std::holds_alternative<Sphere>(body.shape.base) || !body.shape.removed.empty()) continue;
    if (charge < bodies.size())
      refuse(scene, "bodies '" + bodies[charge].name + "' and '" + body.name + "' are both spherical; name one by start.body");
    charge = i;
  }
  if (charge == bodies.size())
    refuse(scene, "no spherical body of gas or products; name one by start.body, or use start.kind = \"plain\"");
  return charge;
}

std::size_t find_medium(const scene::Scene& scene, const Sphere& sphere) {
  const auto& bodies = scene.fluid.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (const Primitive& hole : bodies[i].shape.removed)
      if (same_sphere(hole, sphere)) return i;
  refuse(scene, "no body surrounds the charge; the medium's `subtract` must name it");
}

/// Distance from the charge's center to the nearest place where the flow stops being spherical.
double obstacle_distance(const scene::Scene& scene, const sph::Body& charge, const sph::Body& medium, const Sphere& sphere) {
  double distance = -signed_distance(medium.shape.base, sphere.center, 3);
  for (const Primitive& hole : medium.shape.removed)
    if (!same_sphere(hole, sphere)) distance = std::min(distance, signed_distance(hole, sphere.center, 3));
  for (const sph::Body& body : scene.fluid.bodies)
    if (&body != &charge && &body != &medium) distance = std::min(distance, signed_distance(body.shape, sphere.center, 3));
  return distance;
}

exact::Layer layer_of(const sph::Body& body, double inner, double outer, double cell) {
  exact::Layer layer{.law = body.material.law, .inner = inner, .outer = outer};
  layer.cells = std::max(1, int(std::lround((outer - inner) / cell)));
  layer.density = start_density(body);
  layer.energy = start_energy(body);
  return layer;
}

std::vector<exact::Layer> layers_of(const sph::Body& charge, const sph::Body& medium, double outer, int charge_cells) {
  const double radius = std::get<Sphere>(charge.shape.base).radius, cell = radius / charge_cells;
  std::vector<exact::Layer> layers{layer_of(charge, 0.0, radius, cell), layer_of(medium, radius, outer, cell)};
  if (charge.burn && !charge.burn->instantaneous) {
    layers[0].burn = charge.burn;
    layers[0].burn->origin = Vec3::Zero();
    layers[0].burn->width = 4.0 * cell;
  }
  return layers;
}

/// State, mass and energies of one layer of the mesh for the particles of one body. `share`: kept part of the sphere.
std::shared_ptr<const sph::StartField> field_of(std::shared_ptr<const exact::Lagrangian1D> flow, int layer, const Vec3& center,
                                                const sph::Body& body, double kept_mass, double share) {
  auto field = std::make_shared<sph::StartField>();
  const double at_rest = start_density(body), energy_at_rest = start_energy(body);
  const double mesh_end = flow->node_radius().back();
  field->state = [=](const Vec3& x, double spacing) {
    const double r = (x - center).norm();
    const double from = std::max(0.0, r - 0.5 * spacing), to = r + 0.5 * spacing;
    const exact::IntervalIntegral part = flow->integral(from, to, layer);
    sph::StartState state{at_rest, energy_at_rest, Vec3::Zero()};
    if (to > mesh_end || part.mass <= 0) return state;  // beyond the mesh nothing has arrived
    state.density = part.density();
    state.energy = part.energy_with_lost_motion();
    state.velocity = part.velocity() / std::max(r, 1e-30) * (x - center);
    return state;
  };
  const exact::IntervalIntegral whole = flow->integral(0.0, mesh_end, layer);
  field->mass = kept_mass;
  field->kinetic_energy = share * whole.kinetic_energy;
  field->internal_energy = share * whole.internal_energy + (kept_mass - share * whole.mass) * energy_at_rest;
  return field;
}

}  // namespace

Sphere spherical_charge(const scene::Scene& scene) { return std::get<Sphere>(scene.fluid.bodies[find_charge(scene)].shape.base); }

exact::Lagrangian1D spherical_flow(const scene::Scene& scene, double outer, int charge_cells) {
  const sph::Body& charge = scene.fluid.bodies[find_charge(scene)];
  const sph::Body& medium = scene.fluid.bodies[find_medium(scene, spherical_charge(scene))];
  return {3, layers_of(charge, medium, outer, charge_cells), exact::Boundary::rigid, exact::Boundary::transmitting};
}

std::string begin_spherically(scene::Scene& scene) {
  sph::Settings& fluid = scene.fluid;
  sph::Body& charge = fluid.bodies[find_charge(scene)];
  const Sphere sphere = std::get<Sphere>(charge.shape.base);
  sph::Body& medium = fluid.bodies[find_medium(scene, sphere)];
  double share = 1.0;
  for (int a = 0; a < 3; ++a)
    if (fluid.symmetry.axis[a]) {
      share *= 0.5;
      if (sphere.center[a] != 0.0) refuse(scene, "the center of '" + charge.name + "' must lie on every symmetry plane");
    }
  if (charge.velocity.norm() > 0 || medium.velocity.norm() > 0) refuse(scene, "charge and medium must be at rest");
  for (const solid::Body& solid : scene.solids.bodies)
    if (solid.velocity.norm() > 0 || solid.spin.norm() > 0) refuse(scene, "solids must be at rest: '" + solid.name + "' moves");
  if (charge.burn && !charge.burn->instantaneous && charge.burn->origin != sphere.center)
    refuse(scene, "'" + charge.name + "' must burn from its center");

  const double obstacle = obstacle_distance(scene, charge, medium, sphere);
  const double reach = sph::kernel_support(fluid.numerics.kernel) * sph::smoothing_length(fluid, fluid.lattice.spacing);
  const auto flow = std::make_shared<exact::Lagrangian1D>(3, layers_of(charge, medium, obstacle, cells_in_charge));
  const double last_front = obstacle - reach - fluid.lattice.spacing;
  if (last_front <= sphere.radius)
    refuse(scene, "the obstacle is too near to the charge for this spacing; take a smaller one, or start.kind = \"plain\"");
  constexpr double threshold = 1e6;  // [Pa] above the medium's own pressure
  if (scene.start.time) {
    flow->advance(*scene.start.time);
  } else {
    const double stride = 0.1 * (last_front - sphere.radius) / 2000.0;  // a tenth of the way at about the speed of sound
    while (flow->shock_front(threshold) < last_front - 0.5 * fluid.lattice.spacing) flow->advance(flow->time() + 0.1 * stride);
  }
  const double front = flow->shock_front(threshold);
  if (front > obstacle - 0.5 * reach)
    refuse(scene, "at start.time the wave has reached the obstacle; take an earlier time or leave it out");
  if (flow->time() >= scene.end_time) refuse(scene, "end_time comes before the start");

  const double radius = flow->interface_radius(0);
  for (const sph::Body* body : {&charge, &medium})
    if (body->spacing && *body->spacing > radius) refuse(scene, "the spacing of '" + body->name + "' exceeds the charge");
  Bounds window = bounds(medium.shape, 3);
  for (int a = 0; a < 3; ++a)
    if (fluid.symmetry.axis[a]) window.low[a] = 0.0;
  const double medium_mass = start_density(medium) * volume(medium.shape, window, 3);
  const double charge_mass = share * start_density(charge) * 4.0 / 3.0 * M_PI * std::pow(sphere.radius, 3);
  charge.start = field_of(flow, 0, sphere.center, charge, charge_mass, share);
  medium.start = field_of(flow, 1, sphere.center, medium, medium_mass, share);
  charge.burn.reset();  // it has burned
  const Sphere grown{sphere.center, radius};
  charge.shape.base = grown;
  for (Primitive& hole : medium.shape.removed)
    if (same_sphere(hole, sphere)) hole = grown;
  fluid.start_time = flow->time();
  fluid.heat_before = share * flow->barotropic_heat();

  char text[300];
  std::snprintf(
      text, sizeof text, "spherical start: %d cells to %.3f us; front at %.2f mm of %.2f mm, '%s' grown from %.2f to %.2f mm",
      flow->cells(), flow->time() * 1e6, front * 1e3, obstacle * 1e3, charge.name.c_str(), sphere.radius * 1e3, radius * 1e3);
  return text;
}

}  // namespace undex::run
