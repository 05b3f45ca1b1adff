#include "run/spherical_flow.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "run/rest.hpp"

namespace undex::run {
namespace {

[[noreturn]] void refuse_flow(const scene::Scene& scene, const std::string& why) {
  throw SceneError(scene.file.string(), {{{}, "start.kind = \"spherical\": " + why}});
}

const Sphere& sphere_of(const sph::Body& charge) { return std::get<Sphere>(charge.shape.base); }

exact::Layer layer_of(const sph::Body& body, double density, double inner, double outer, int cells) {
  exact::Layer layer{.law = body.material.law, .inner = inner, .outer = outer, .cells = cells};
  layer.density = density;
  layer.energy = start_energy(body);
  return layer;
}

/// Under gravity the medium is all as it is at the charge's depth.
std::vector<exact::Layer> layers_of(const scene::Scene& scene, const sph::Body& charge, const sph::Body& medium, double outer,
                                    int charge_cells) {
  const double radius = sphere_of(charge).radius, cell = radius / charge_cells, length = outer - radius;
  // w(r) = w (a + r)/(2 a) sums up to `length` in so many cells.
  const int cells = std::max(2, int(std::lround(2.0 * charge_cells * std::log1p(length / (2.0 * radius)))));
  const double at_depth = rest_of(medium, scene)(sphere_of(charge).center).density;
  std::vector<exact::Layer> layers{layer_of(charge, start_density(charge), 0.0, radius, charge_cells),
                                   layer_of(medium, at_depth, radius, outer, cells)};
  if (cell < length / cells) layers[1].ratio = exact::grading(length, cells, cell);
  if (charge.burn && !charge.burn->instantaneous) {
    layers[0].burn = charge.burn;
    layers[0].burn->origin = Vec3::Zero();
    layers[0].burn->width = 4.0 * cell;
  }
  return layers;
}

}  // namespace

std::vector<std::size_t> charges_of(const scene::Scene& scene) {
  const auto& bodies = scene.fluid.bodies;
  std::vector<std::size_t> charges;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const sph::Body& body = bodies[i];
    if (!scene.start.body.empty() ? body.name != scene.start.body : !body.variable_h) continue;
    if (std::holds_alternative<Sphere>(body.shape.base) && body.shape.removed.empty()) charges.push_back(i);
  }
  return charges;
}

std::size_t charge_of(const scene::Scene& scene) {
  const auto& bodies = scene.fluid.bodies;
  const std::vector<std::size_t> charges = charges_of(scene);
  if (charges.empty())
    refuse_flow(scene, "no spherical body of gas or products; name one by start.body, or use start.kind = \"plain\"");
  if (charges.size() > 1)
    refuse_flow(scene, "bodies '" + bodies[charges[0]].name + "' and '" + bodies[charges[1]].name +
                           "' are both spherical; name one by start.body");
  return charges.front();
}

std::size_t medium_of(const scene::Scene& scene, std::size_t charge) {
  const auto& bodies = scene.fluid.bodies;
  const Sphere& sphere = sphere_of(bodies[charge]);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (const Primitive& hole : bodies[i].shape.removed)
      if (const auto* other = std::get_if<Sphere>(&hole);
          other && other->center == sphere.center && other->radius == sphere.radius)
        return i;
  refuse_flow(scene, "no body surrounds the charge '" + bodies[charge].name + "'; the medium's `subtract` must name it");
}

Sphere spherical_charge(const scene::Scene& scene) { return sphere_of(scene.fluid.bodies[charge_of(scene)]); }

SphericalFlow::SphericalFlow(const scene::Scene& scene, double outer, int charge_cells)
    : SphericalFlow(scene, charge_of(scene), outer, charge_cells) {}

SphericalFlow::SphericalFlow(const scene::Scene& scene, std::size_t charge, double outer, int charge_cells)
    : charge_radius_(sphere_of(scene.fluid.bodies[charge]).radius),
      charge_cell_(charge_radius_ / charge_cells),
      mesh_(3, layers_of(scene, scene.fluid.bodies[charge], scene.fluid.bodies[medium_of(scene, charge)], outer, charge_cells),
            exact::Boundary::rigid, exact::Boundary::transmitting),
      threshold_(1e6),
      merged_at_(charge_radius_) {
  // A weak bubble's wave would never be seen.
  const double above = mesh_.cell_pressure().front() - mesh_.cell_pressure().back();
  if (above > 0) threshold_ = std::min(threshold_, 0.01 * above);
}

void SphericalFlow::visit_state(StateVisitor& state) {
  mesh_.visit_state(state);
  state("merged at", merged_at_);
}

double SphericalFlow::front() const { return mesh_.shock_front(threshold_); }

double SphericalFlow::cell_width(double radius) const {
  return charge_cell_ * std::max(1.0, 0.5 * (1.0 + radius / charge_radius_));
}

void SphericalFlow::advance(double t) {
  while (mesh_.time() < t) {
    constexpr double fastest = 1e4;  // [m/s]: no front grows by more than a twentieth between two looks
    mesh_.advance(std::min(t, mesh_.time() + 0.05 * merged_at_ / fastest));
    if (const double now = front(); now > 1.1 * merged_at_) {
      merged_at_ = now;
      mesh_.coarsen(cell_width(now));
    }
  }
}

}  // namespace undex::run
