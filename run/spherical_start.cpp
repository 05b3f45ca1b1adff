#include "run/spherical_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/errors.hpp"
#include "run/spherical_flow.hpp"
#include "scene/numbers.hpp"
#include "scene/revolution.hpp"
#include "sph_fluid/lattice.hpp"

namespace undex::run {
namespace {

constexpr int cells_in_charge = 250;

[[noreturn]] void refuse(const scene::Scene& scene, const std::string& why) {
  throw SceneError(scene.file.string(), {scene.places.finding("start.kind", "start.kind = \"spherical\": " + why)});
}

/// At the start [Pa].
double pressure_of(const sph::Body& body) {
  const double rho = start_density(body), energy = start_energy(body);
  return std::visit([&](const auto& law) { return law.evaluate(rho, energy).pressure; }, body.material.law);
}

bool same_sphere(const Primitive& shape, const Sphere& sphere) {
  const auto* other = std::get_if<Sphere>(&shape);
  return other && other->center == sphere.center && other->radius == sphere.radius;
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

/// Until the particles take over nothing but the charge's flow is computed: all else must stay as it is until then.
void require_rest(const scene::Scene& scene, const sph::Body& charge, const sph::Body& medium, double rest) {
  const auto is_rest = [&](double p) { return std::abs(p - rest) <= 1e-3 * std::abs(rest) + 1.0; };
  const std::string remedy =
      " until the particles take over, for only the charge's flow is computed; take start.kind = \"plain\"";
  for (const sph::Body& body : scene.fluid.bodies) {
    if (body.velocity.norm() > 0 || body.radial_velocity != 0)
      refuse(scene, "'" + body.name + "' moves, but all must be at rest" + remedy);
    if (&body == &charge || &body == &medium) continue;
    if (body.burn) refuse(scene, "'" + body.name + "' burns too, but nothing else may happen" + remedy);
    const double p = pressure_of(body);
    if (!is_rest(p))
      refuse(scene, "'" + body.name + "' begins at " + scene::rounded(p) + " Pa, the medium '" + medium.name + "' at " +
                        scene::rounded(rest) + " Pa, but all else must stay at rest" + remedy);
  }
  for (const solid::Body& solid : scene.solids.bodies) {
    if (solid.velocity.norm() > 0 || solid.spin.norm() > 0) refuse(scene, "solids must be at rest: '" + solid.name + "' moves");
    if (solid.residual_stress != 0)
      refuse(scene, "'" + solid.name + "' begins under stress, but all else must stay at rest" + remedy);
  }
  if (!scene.structure) return;
  if (scene.structure->initial_velocity.norm() > 0)
    refuse(scene, "the structure must be at rest, but it has a velocity; take start.kind = \"plain\"");
  for (const fem::PressureLoad& load : scene.structure->loads)
    for (const double p : load.pressure)
      if (p != 0 && !is_rest(p))
        refuse(scene, "a load of " + scene::rounded(p) + " Pa acts on the structure's face '" + load.face +
                          "', which is neither 0 nor the medium's " + scene::rounded(rest) +
                          " Pa, but all else must stay at rest" + remedy);
}

std::string begin_spherically(scene::Scene& scene, const StartProgress& progress) {
  sph::Settings& fluid = scene.fluid;
  sph::Body& charge = fluid.bodies[charge_of(scene)];
  sph::Body& medium = fluid.bodies[medium_of(scene)];
  const Sphere sphere = std::get<Sphere>(charge.shape.base);
  double share = 1.0;
  for (int a = 0; a < 3; ++a)
    if (fluid.symmetry.axis[a]) {
      share *= 0.5;
      if (sphere.center[a] != 0.0) refuse(scene, "the center of '" + charge.name + "' must lie on every symmetry plane");
    }
  require_rest(scene, charge, medium, pressure_of(medium));
  if (charge.burn && !charge.burn->instantaneous && charge.burn->origin != sphere.center)
    refuse(scene, "'" + charge.name + "' must burn from its center");
  if (scene.start.time && *scene.start.time >= scene.end_time) refuse(scene, "end_time comes before the start");

  const double obstacle = obstacle_distance(scene, charge, medium, sphere);
  const double reach = sph::kernel_support(fluid.numerics.kernel) * sph::smoothing_length(fluid, fluid.lattice.spacing);
  const double last_front = obstacle - reach - fluid.lattice.spacing;
  if (last_front <= sphere.radius)
    refuse(scene, "the obstacle is too near to the charge for this spacing; take a smaller one, or start.kind = \"plain\"");
  const auto computed = std::make_shared<SphericalFlow>(scene, obstacle, cells_in_charge);
  const double goal = last_front - 0.5 * fluid.lattice.spacing;
  const double stride = (last_front - sphere.radius) / 2e5;  // a hundredth of the way at about the speed of sound
  while (scene.start.time ? computed->time() < *scene.start.time : computed->front() < goal) {
    const double next = computed->time() + stride;
    computed->advance(scene.start.time ? std::min(next, *scene.start.time) : next);
    if (scene.start.time && computed->front() > obstacle - 0.5 * reach)
      refuse(scene, "at start.time the wave has reached the obstacle; take an earlier time or leave it out");
    if (computed->time() >= scene.end_time) refuse(scene, "end_time comes before the start");
    if (progress) progress(computed->time(), computed->front(), obstacle);
  }
  const double front = computed->front();
  const std::shared_ptr<const exact::Lagrangian1D> flow(computed, &computed->mesh());

  const double radius = flow->interface_radius(0);
  for (const sph::Body* body : {&charge, &medium})
    if (body->spacing && *body->spacing > radius) refuse(scene, "the spacing of '" + body->name + "' exceeds the charge");
  const double medium_mass = start_density(medium) * scene::kept_volume(medium.shape, scene);
  const double charge_mass = share * start_density(charge) * 4.0 / 3.0 * M_PI * std::pow(sphere.radius, 3);
  charge.start = field_of(flow, 0, sphere.center, charge, charge_mass, share);
  medium.start = field_of(flow, 1, sphere.center, medium, medium_mass, share);
  charge.burn.reset();  // it has burned
  const Sphere grown{sphere.center, radius};
  charge.shape.base = grown;
  for (Primitive& hole : medium.shape.removed)
    if (same_sphere(hole, sphere)) hole = grown;
  fluid.start_time = flow->time();
  if (scene.structure) scene.structure->start_time = flow->time();
  fluid.heat_before = share * flow->barotropic_heat();

  char text[300];
  std::snprintf(
      text, sizeof text, "spherical start: %ld steps to %.3f us; front at %.2f mm of %.2f mm, '%s' grown from %.2f to %.2f mm",
      flow->steps(), flow->time() * 1e6, front * 1e3, obstacle * 1e3, charge.name.c_str(), sphere.radius * 1e3, radius * 1e3);
  return text;
}

}  // namespace undex::run
