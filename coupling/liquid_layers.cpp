#include "coupling/liquid_layers.hpp"

#include <algorithm>
#include <variant>

namespace undex::coupling {

LiquidLayers::LiquidLayers(const sph::Settings& fluid) : dimension_(fluid.dimension) {
  for (const sph::Body& body : fluid.bodies) {
    if (body.variable_h) continue;
    const double rho = sph::start_density(body), energy = sph::start_energy(body);
    const double c = std::visit([&](const auto& law) { return law.evaluate(rho, energy).sound_speed; }, body.material.law);
    layers_.push_back({&body, rho * c * c / body.spacing.value_or(fluid.lattice.spacing), rho * c});
  }
}

const LiquidLayers::Layer& LiquidLayers::nearest(const Vec3& x) const {
  const auto distance = [&](const Layer& layer) { return signed_distance(layer.body->shape, x, dimension_); };
  return *std::min_element(layers_.begin(), layers_.end(),
                           [&](const Layer& one, const Layer& other) { return distance(one) < distance(other); });
}

}  // namespace undex::coupling
