#include "run/spherical_state.hpp"

#include <algorithm>
#include <cmath>

#include "run/rest.hpp"
#include "scene/opened.hpp"
#include "scene/revolution.hpp"

namespace undex::run {
namespace {

/// What a state has of a body.
struct Part {
  std::shared_ptr<const exact::Lagrangian1D> flow;
  Vec3 center;
  double front;
  int layer;
  double share;  // that is kept

  double end() const { return flow->node_radius().back(); }
  exact::IntervalIntegral whole() const { return flow->integral(0.0, end(), layer); }
  /// Without the heat that shocks have left in a barotropic layer [J].
  double internal_energy() const {
    const auto& law = std::get<materials::FluidLaw>(flow->layer(layer).law);
    if (materials::uses_energy(law)) return whole().internal_energy;
    double sum = 0;
    for (int i = 0; i < flow->cells(); ++i)
      if (flow->cell_layer()[i] == layer)
        sum += flow->cell_mass()[i] * materials::barotropic_energy(law, flow->cell_density()[i]);
    return sum;
  }
};

/// The mean over a cell of that width [m]; `at_rest` beyond the mesh, where nothing has arrived, and outside of the layer.
sph::StartState state_of(const Part& part, const Vec3& x, double spacing, const sph::StartState& at_rest) {
  const double r = (x - part.center).norm();
  const double from = std::max(0.0, r - 0.5 * spacing), to = r + 0.5 * spacing;
  const exact::IntervalIntegral mean = part.flow->integral(from, to, part.layer);
  if (to > part.end() || mean.mass <= 0) return at_rest;
  sph::StartState state;
  state.density = mean.density();
  state.energy = mean.energy_with_lost_motion();
  state.velocity = mean.velocity() / std::max(r, 1e-30) * (x - part.center);
  return state;
}

bool is_sphere(const Primitive& shape, const Vec3& center, double radius) {
  const auto* sphere = std::get_if<Sphere>(&shape);
  return sphere && sphere->center == center && sphere->radius == radius;
}

/// Has the body's shape been its layer, and nothing else?
bool is_layer(const sph::Body& body, const Part& part) {
  const exact::Layer& layer = part.flow->layer(part.layer);
  if (!is_sphere(body.shape.base, part.center, layer.outer)) return false;
  if (layer.inner == 0.0) return body.shape.removed.empty();
  return body.shape.removed.size() == 1 && is_sphere(body.shape.removed.front(), part.center, layer.inner);
}

/// Has the wave passed a radiating face at which the body ends?
bool has_left(const sph::Body& body, const Part& part, const scene::Scene& scene) {
  return part.front > -signed_distance(scene::with_radiating_faces_only(body.shape.base, scene.fluid), part.center, 3);
}

/// Of what the scene keeps of a body at rest with that density [kg].
double rest_mass(const sph::Body& body, double density, const scene::Scene& scene) {
  const auto* sphere = std::get_if<Sphere>(&body.shape.base);
  if (!sphere || !body.shape.removed.empty()) return density * scene::kept_volume(body.shape, scene);
  const std::optional<double> share = kept_share(scene, sphere->center);
  return share.value_or(1.0) * density * 4.0 / 3.0 * M_PI * std::pow(sphere->radius, 3);
}

/// The contacts of all shapes, from where they were at time zero.
void grow(Primitive& shape, const std::vector<SphericalState>& states) {
  for (const SphericalState& state : states)
    for (int k = 0; k + 1 < state.flow->layers(); ++k)
      if (is_sphere(shape, state.center, state.flow->layer(k).outer)) {
        std::get<Sphere>(shape).radius = state.flow->interface_radius(k);
        return;
      }
}

}  // namespace

std::optional<double> kept_share(const scene::Scene& scene, const Vec3& center) {
  double share = 1.0;
  for (int a = 0; a < 3; ++a) {
    if (!scene.fluid.symmetry.axis[a]) continue;
    if (center[a] == 0.0) share *= 0.5;
    else if (center[a] < 0.0) return std::nullopt;
  }
  return share;
}

void lay(const std::vector<SphericalState>& states, bool exact, scene::Scene& scene) {
  std::vector<sph::Body>& bodies = scene.fluid.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    sph::Body& body = bodies[b];
    std::vector<Part> parts;
    for (const SphericalState& state : states)
      for (std::size_t k = 0; k < state.bodies.size(); ++k)
        if (state.bodies[k] == b) parts.push_back({state.flow, state.center, state.front, int(k), state.share});
    if (parts.empty()) continue;

    auto field = std::make_shared<sph::StartField>();
    const bool hydrostatic = body.level && !body.variable_h;
    const double rest = hydrostatic ? parts.front().flow->layer(parts.front().layer).density : start_density(body);
    const sph::StartState at_rest{rest, start_energy(body), Vec3::Zero()};
    if (hydrostatic)
      field->rest_pressure =
          std::visit([&](const auto& law) { return law.evaluate(rest, at_rest.energy).pressure; }, body.material.law);
    field->state = [=](const Vec3& x, double spacing) {
      const auto depth = [&](const Part& part) { return part.front - (x - part.center).norm(); };
      const auto deepest = std::max_element(parts.begin(), parts.end(),
                                            [&](const Part& one, const Part& other) { return depth(one) < depth(other); });
      return state_of(*deepest, x, spacing, at_rest);
    };
    const bool whole = exact && parts.size() == 1 && is_layer(body, parts.front());
    double of_layers = 0;
    for (const Part& part : parts) {
      of_layers += part.share * part.whole().mass;
      field->kinetic_energy += part.share * part.whole().kinetic_energy;
      field->internal_energy += part.share * part.internal_energy();
    }
    const bool left = std::any_of(parts.begin(), parts.end(), [&](const Part& part) { return has_left(body, part, scene); });
    if (!left) {
      field->mass = whole ? of_layers : rest_mass(body, rest, scene);
      field->internal_energy += (field->mass - of_layers) * rest_energy(body, rest);
    }
    field->exact = exact;
    body.start = field;
    body.burn.reset();  // it has burned
  }
  for (sph::Body& body : bodies) {
    grow(body.shape.base, states);
    for (Primitive& hole : body.shape.removed) grow(hole, states);
  }
  double heat = 0;
  for (const SphericalState& state : states) heat += state.share * state.flow->barotropic_heat();
  scene.fluid.heat_before = heat;
}

}  // namespace undex::run
