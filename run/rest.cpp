#include "run/rest.hpp"

namespace undex::run {
namespace {

bool has_column(const sph::Body& body, const scene::Scene& scene) { return body.level && !scene.fluid.gravity.isZero(); }

Rest rest(const sph::Body& body, double density) {
  const double energy = start_energy(body);
  return {density, energy,
          std::visit([&](const auto& law) { return law.evaluate(density, energy).pressure; }, body.material.law)};
}

}  // namespace

std::function<Rest(const Vec3&)> rest_of(const sph::Body& body, const scene::Scene& scene) {
  if (!has_column(body, scene)) return [uniform = rest(body, start_density(body))](const Vec3&) { return uniform; };
  return [body, column = sph::hydrostatic_column(body, scene.fluid.gravity, scene.fluid.dimension),
          down = Vec3(scene.fluid.gravity.normalized())](const Vec3& x) {
    const double depth = (x - *body.level).dot(down);
    return Rest{column.density(depth), start_energy(body), column.pressure(depth)};
  };
}

Vec3 place_of_pressure(const sph::Body& body, const scene::Scene& scene) {
  return body.level ? *body.level : middle(body.shape.base, scene.fluid.dimension);
}

double rest_energy(const sph::Body& body, double density) {
  return materials::uses_energy(body.material.law) ? start_energy(body)
                                                   : materials::barotropic_energy(body.material.law, density);
}

MeanRest mean_rest(const sph::Body& body, const scene::Scene& scene) {
  if (!has_column(body, scene)) return {start_density(body), rest_energy(body, start_density(body))};
  constexpr int slices = 64;
  const Vec3 down = scene.fluid.gravity.normalized();
  const Bounds box = bounds(body.shape, scene.fluid.dimension);
  double low = 0, high = 0;
  for (int a = 0; a < scene.fluid.dimension; ++a) {
    const double one = down[a] * box.low[a], other = down[a] * box.high[a];
    low += std::min(one, other);
    high += std::max(one, other);
  }
  const auto at = rest_of(body, scene);
  MeanRest mean{0, 0};
  for (int k = 0; k < slices; ++k) {
    const double rho = at((low + (k + 0.5) / slices * (high - low)) * down).density;
    mean.density += rho / slices;
    mean.energy += rho * rest_energy(body, rho) / slices;
  }
  mean.energy /= mean.density;
  return mean;
}

}  // namespace undex::run
