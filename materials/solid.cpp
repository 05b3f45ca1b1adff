#include "materials/solid.hpp"

#include <cmath>

namespace undex::materials {

Warming warming(const Solid& solid, const VolumeStep& step) {
  const std::optional<double> gamma = gruneisen(solid.pressure);
  if (!gamma) return {};
  if (step.parted) return {.rise = rise_by(solid, step.dissipated)};
  // Along the isentrope de = -p dv: one step of Runge and Kutta's.
  const double opened = step.after - step.before, middle = 0.5 * (step.before + step.after);
  const auto slope = [&](double volume, double e) { return -evaluate(solid.pressure, solid.rho0, 1.0 / volume, e).pressure; };
  const double a = slope(step.before, step.energy), b = slope(middle, step.energy + 0.5 * opened * a),
               c = slope(middle, step.energy + 0.5 * opened * b), d = slope(step.after, step.energy + opened * c);
  const double isentropic = opened / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  return {.factor = std::pow(step.before / step.after, *gamma),
          .rise = (step.pressure_work - isentropic + step.dissipated) / solid.heat_capacity};
}

double rise_by(const Solid& solid, double dissipated) {
  return gruneisen(solid.pressure) ? dissipated / solid.heat_capacity : 0.0;
}

double bulk_modulus(const Solid& solid) { return bulk_modulus(solid.pressure, solid.rho0); }

double wave_speed(const Solid& solid) { return std::sqrt((bulk_modulus(solid) + 4.0 / 3.0 * solid.shear_modulus) / solid.rho0); }

}  // namespace undex::materials
