#include "run/spherical_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/errors.hpp"
#include "run/rest.hpp"
#include "run/spherical_flow.hpp"
#include "run/spherical_state.hpp"
#include "scene/numbers.hpp"
#include "scene/opened.hpp"
#include "sph_fluid/lattice.hpp"

namespace undex::run {
namespace {

constexpr int cells_in_charge = 250;

[[noreturn]] void refuse_start(const scene::Scene& scene, const std::string& why) {
  throw SceneError(scene.file.string(), {scene.places.finding("start.kind", std::string("start.kind = \"") +
                                                                                word_of(scene.start.kind) + "\": " + why)});
}

/// The least and the largest pressure [Pa] of a body at rest.
std::pair<double, double> pressures_at_rest(const sph::Body& body, const scene::Scene& scene) {
  const auto at_rest = rest_of(body, scene);
  const Bounds box = bounds(body.shape, scene.fluid.dimension);
  std::pair range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 x = Vec3::Zero();
    for (int a = 0; a < scene.fluid.dimension; ++a) x[a] = corner >> a & 1 ? box.high[a] : box.low[a];
    const double p = at_rest(x).pressure;
    range = {std::min(range.first, p), std::max(range.second, p)};
  }
  return range;
}

bool same_sphere(const Primitive& shape, const Sphere& sphere) {
  const auto* other = std::get_if<Sphere>(&shape);
  return other && other->center == sphere.center && other->radius == sphere.radius;
}

/// Distance from the charge's center to the nearest place where the flow stops being spherical: none at radiating faces.
double obstacle_distance(const scene::Scene& scene, const sph::Body& charge, const sph::Body& medium, const Sphere& sphere) {
  double distance = -signed_distance(scene::without_radiating_faces(medium.shape.base, scene.fluid), sphere.center, 3);
  for (const Primitive& hole : medium.shape.removed)
    if (!same_sphere(hole, sphere)) distance = std::min(distance, signed_distance(hole, sphere.center, 3));
  for (const sph::Body& body : scene.fluid.bodies)
    if (&body != &charge && &body != &medium) distance = std::min(distance, signed_distance(body.shape, sphere.center, 3));
  for (int a = 0; a < 3; ++a)  // a plane beside the charge mirrors it
    if (scene.fluid.symmetry.axis[a] && sphere.center[a] > 0.0) distance = std::min(distance, sphere.center[a]);
  return distance;
}

/// A charge and its flow.
struct Charge {
  std::size_t body;
  Sphere sphere;
  double share;       // that symmetry planes keep
  double obstacle;    // distance from its center [m]
  double exit;        // that to the nearest radiating face [m]
  double last_front;  // beyond which it is too near to the obstacle; where there is none, to the radiating face [m]
  std::shared_ptr<SphericalFlow> flow = nullptr;

  bool meets_obstacle() const { return obstacle < 0.5 * scene::endless; }
  double way() const { return meets_obstacle() ? obstacle : exit; }   // of the wave [m]
  double radius() const { return flow->mesh().interface_radius(0); }  // of the gas [m]
};

Charge charge_in(const scene::Scene& scene, std::size_t index, std::size_t medium, double reach) {
  const sph::Body& body = scene.fluid.bodies[index];
  const Sphere sphere = std::get<Sphere>(body.shape.base);
  const std::optional<double> share = kept_share(scene, sphere.center);
  for (int a = 0; a < 3; ++a)
    if (scene.fluid.symmetry.axis[a] && sphere.center[a] != 0.0 && sphere.center[a] < sphere.radius)
      refuse_start(scene,
                   "the center of '" + body.name +
                       "' must lie on every symmetry plane, or so far from it, on the kept side, that the plane does not cut the "
                       "charge");
  if (body.burn && !body.burn->instantaneous && body.burn->origin != sphere.center)
    refuse_start(scene, "'" + body.name + "' must burn from its center");
  const sph::Body& around = scene.fluid.bodies[medium];
  Charge charge{.body = index,
                .sphere = sphere,
                .share = share.value(),
                .obstacle = obstacle_distance(scene, body, around, sphere),
                .exit = -signed_distance(scene::with_radiating_faces_only(around.shape.base, scene.fluid), sphere.center, 3),
                .last_front = 0};
  const auto last_front = [&](double way) { return way - reach - scene.fluid.lattice.spacing; };
  charge.last_front = last_front(charge.way());
  if (last_front(std::min(charge.obstacle, charge.exit)) <= sphere.radius)
    refuse_start(scene, "the " + std::string(charge.exit < charge.obstacle ? "radiating face" : "obstacle") +
                            " is too near to the charge for this spacing; take a smaller one, or start.kind = \"plain\"");
  return charge;
}

/// Of the mesh [m]. Where no obstacle says how far the flow goes, a front does not come there by start.time.
double outer_radius(const scene::Scene& scene, const Charge& charge) {
  constexpr double fastest = 1e4;  // front [m/s]
  if (charge.meets_obstacle()) return charge.obstacle;
  return std::max(charge.exit, charge.sphere.radius + fastest * scene.start.time.value_or(0.0));
}

/// Flows in a medium of one rest only are laid beside each other.
void one_depth(const scene::Scene& scene, const std::vector<std::size_t>& charges, const sph::Body& medium) {
  const auto at_rest = rest_of(medium, scene);
  const auto pressure = [&](std::size_t charge) {
    return at_rest(std::get<Sphere>(scene.fluid.bodies[charge].shape.base).center).pressure;
  };
  for (const std::size_t charge : charges)
    if (std::abs(pressure(charge) - pressure(charges.front())) > 1e-3 * std::abs(pressure(charges.front())) + 1.0)
      refuse_start(scene, "'" + scene.fluid.bodies[charges.front()].name + "' and '" + scene.fluid.bodies[charge].name +
                              "' lie in water under other pressures; put them at one depth, name one by start.body, or take "
                              "start.kind = \"plain\"");
}

/// The room left between the waves of two charges [m].
double room_between(const Charge& one, const Charge& other) {
  return (one.sphere.center - other.sphere.center).norm() - one.flow->front() - other.flow->front();
}

/// The least of that of any two; of one charge no end of it.
double least_room(const std::vector<Charge>& charges) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < charges.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, room_between(charges[i], charges[k]));
  return least;
}

/// Every flow to the time when the particles take over.
void advance(const scene::Scene& scene, double reach, std::vector<Charge>& charges, Stages& stages) {
  const double spacing = scene.fluid.lattice.spacing;
  double stride = std::numeric_limits<double>::infinity();  // a hundredth of the way at about the speed of sound
  for (const Charge& charge : charges) stride = std::min(stride, (charge.last_front - charge.sphere.radius) / 2e5);
  const auto time = [&] { return charges.front().flow->time(); };
  const auto nears = [&](const Charge& charge) {
    return charge.flow->front() >= charge.last_front - 0.5 * spacing || charge.radius() >= charge.exit - reach - 1.5 * spacing;
  };
  const auto there = [&] {
    if (scene.start.time) return time() >= *scene.start.time;
    return std::any_of(charges.begin(), charges.end(), nears) || least_room(charges) <= 2.0 * reach + 3.0 * spacing;
  };
  while (!there()) {
    const double next = time() + stride;
    for (const Charge& charge : charges) charge.flow->advance(scene.start.time ? std::min(next, *scene.start.time) : next);
    if (scene.start.time) {
      for (const Charge& charge : charges) {
        if (charge.flow->front() > charge.obstacle - 0.5 * reach)
          refuse_start(scene, "at start.time the wave has reached the obstacle; take an earlier time or leave it out");
        if (charge.radius() > charge.exit - 0.5 * reach)
          refuse_start(scene, "at start.time the charge has grown to a radiating face; take an earlier time or leave it out");
      }
      if (least_room(charges) < reach)
        refuse_start(scene, "at start.time the waves of two charges have met; take an earlier time or leave it out");
    }
    if (time() >= scene.end_time) refuse_start(scene, "end_time comes before the start");
    stages.news([&] {
      const SphericalFlow& flow = *charges.front().flow;
      char text[200];
      std::snprintf(text, sizeof text, "%.4g us, front at %.4g mm of %.4g mm", flow.time() * 1e6, flow.front() * 1e3,
                    charges.front().way() * 1e3);
      return std::string(text);
    });
  }
}

/// A gas that fills few spacings when the particles take over keeps too small a bubble.
void warn_of_coarse_gas(scene::Scene& scene, const Charge& charge, std::size_t medium) {
  constexpr double least = 4;  // spacings: docs/results/accuracy.md, "The bubble behind a spherical start"
  const auto spacing_of = [&](std::size_t body) {
    return scene.fluid.bodies[body].spacing.value_or(scene.fluid.lattice.spacing);
  };
  const double spacings = charge.radius() / std::max(spacing_of(charge.body), spacing_of(medium));
  if (spacings >= least) return;
  char text[300];
  std::snprintf(
      text, sizeof text,
      "bodies.%s: its gas has a radius of %.2g spacings when the particles take over, and its bubble stays too small "
      "(five spacings: a fifth of the volume is missing, two or three: a third or more); take a spacing of %.2g m or less, "
      "or a later start",
      scene.fluid.bodies[charge.body].name.c_str(), spacings, charge.radius() / least);
  scene.warnings.push_back(text);
}

}  // namespace

bool moves_by_itself(const coupling::Obstacle& obstacle) {
  return obstacle.velocity.norm() > 0 || obstacle.spin.norm() > 0 || !obstacle.speed.empty() || !obstacle.force.empty();
}

double start_pressure(const sph::Body& body) {
  const double rho = start_density(body), energy = start_energy(body);
  return std::visit([&](const auto& law) { return law.evaluate(rho, energy).pressure; }, body.material.law);
}

void require_rest(const scene::Scene& scene, const std::vector<std::size_t>& in_motion, const sph::Body& medium) {
  const auto at_rest = rest_of(medium, scene);
  const auto is_rest = [](double p, double rest) { return std::abs(p - rest) <= 1e-3 * std::abs(rest) + 1.0; };
  const std::string remedy =
      " until the particles take over, for only the charge's flow is computed; take start.kind = \"plain\"";
  const std::vector<sph::Body>& bodies = scene.fluid.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const sph::Body& body = bodies[b];
    if (body.moves()) refuse_start(scene, "'" + body.name + "' moves, but all must be at rest" + remedy);
    if (std::find(in_motion.begin(), in_motion.end(), b) != in_motion.end()) continue;
    if (body.burn) refuse_start(scene, "'" + body.name + "' burns too, but nothing else may happen" + remedy);
    const double p = start_pressure(body), rest = at_rest(place_of_pressure(body, scene)).pressure;
    if (!is_rest(p, rest))
      refuse_start(scene, "'" + body.name + "' begins at " + scene::rounded(p) + " Pa, the medium at " + scene::rounded(rest) +
                              " Pa, but all else must stay at rest" + remedy);
  }
  for (const solid::Body& solid : scene.solids.bodies) {
    if (solid.moves()) refuse_start(scene, "solids must be at rest: '" + solid.name + "' moves");
    if (solid.residual_stress != 0)
      refuse_start(scene, "'" + solid.name + "' begins under stress, but all else must stay at rest" + remedy);
  }
  for (const coupling::Obstacle& obstacle : scene.obstacles)
    if (moves_by_itself(obstacle))
      refuse_start(scene, "obstacle '" + obstacle.name + "' moves by itself, but all else must be at rest" + remedy);
  const auto named = [&](const fem::Settings& structure) {
    return scene.structures_listed ? "structure '" + structure.name + "'" : std::string("the structure");
  };
  for (const fem::Settings& structure : scene.structures)
    if (structure.moves())
      refuse_start(scene, named(structure) + " must be at rest, but it has a velocity; take start.kind = \"plain\"");
  // The wet face has what the medium has beyond the surroundings.
  const auto [least, most] = pressures_at_rest(medium, scene);
  const double around = scene.fluid.surroundings.pressure;
  for (const fem::Settings& structure : scene.structures)
    for (const fem::PressureLoad& load : structure.loads)
      for (const double p : load.pressure)
        if (p != 0 && !is_rest(std::clamp(p, least - around, most - around), p))
          refuse_start(scene, "a load of " + scene::rounded(p) + " Pa acts on the face '" + load.face + "' of " +
                                  named(structure) + ", which is neither 0 nor the medium's " + scene::rounded(least - around) +
                                  " Pa" + (around > 0 ? " beyond the surroundings" : "") + ", but all else must stay at rest" +
                                  remedy);
}

std::string begin_spherically(scene::Scene& scene, Stages& stages) {
  sph::Settings& fluid = scene.fluid;
  std::vector<std::size_t> indices = charges_of(scene);
  if (indices.empty()) indices = {charge_of(scene)};  // says what is missing
  const std::size_t medium = medium_of(scene, indices.front());
  for (const std::size_t index : indices)
    if (medium_of(scene, index) != medium)
      refuse_start(scene, "'" + fluid.bodies[indices.front()].name + "' and '" + fluid.bodies[index].name +
                              "' lie in different bodies; name one by start.body, or take start.kind = \"plain\"");
  std::vector<std::size_t> in_motion = indices;
  in_motion.push_back(medium);
  require_rest(scene, in_motion, fluid.bodies[medium]);
  one_depth(scene, indices, fluid.bodies[medium]);
  if (scene.start.time && *scene.start.time >= scene.end_time) refuse_start(scene, "end_time comes before the start");

  const double reach = sph::kernel_support(fluid.numerics.kernel) * sph::smoothing_length(fluid, fluid.lattice.spacing);
  std::vector<Charge> charges;
  for (const std::size_t index : indices) charges.push_back(charge_in(scene, index, medium, reach));
  for (Charge& charge : charges)
    charge.flow = std::make_shared<SphericalFlow>(scene, charge.body, outer_radius(scene, charge), cells_in_charge);
  advance(scene, reach, charges, stages);

  std::string text;
  std::vector<SphericalState> states;
  for (const Charge& charge : charges) {
    const SphericalFlow& flow = *charge.flow;
    const std::string& name = fluid.bodies[charge.body].name;
    if (charges.size() > 1 && flow.front() <= charge.sphere.radius)
      refuse_start(scene, "the waves of two charges meet before '" + name + "' has burned; take start.kind = \"plain\"");
    const double radius = charge.radius();
    warn_of_coarse_gas(scene, charge, medium);
    for (const std::size_t index : {charge.body, medium})
      if (const auto& spacing = fluid.bodies[index].spacing; spacing && *spacing > radius)
        refuse_start(scene, "the spacing of '" + fluid.bodies[index].name + "' exceeds the charge");
    states.push_back({.flow = {charge.flow, &flow.mesh()},
                      .center = charge.sphere.center,
                      .front = flow.front(),
                      .bodies = {charge.body, medium},
                      .share = charge.share});
    char line[300];
    std::snprintf(line, sizeof line, "%s%ld steps to %.3f us; front at %.2f mm of %.2f mm, '%s' grown from %.2f to %.2f mm",
                  text.empty() ? "" : "\n", flow.mesh().steps(), flow.time() * 1e6, flow.front() * 1e3, charge.way() * 1e3,
                  name.c_str(), charge.sphere.radius * 1e3, radius * 1e3);
    text += line;
  }
  lay(states, charges.size() > 1, scene);
  fluid.start_time = charges.front().flow->time();
  for (fem::Settings& structure : scene.structures) structure.start_time = fluid.start_time;
  return text;
}

}  // namespace undex::run
