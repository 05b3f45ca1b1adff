#include "materials/solid.hpp"

#include <algorithm>
#include <cmath>

namespace undex::materials {

SolidPressureSound evaluate(const LinearPressure& law, double rho0, double rho, double) {
  return {law.bulk_modulus * (rho / rho0 - 1.0), std::sqrt(law.bulk_modulus / rho0)};
}

SolidPressureSound evaluate(const MieGruneisenPressure& law, double rho0, double rho, double energy) {
  const double eta = rho / rho0 - 1.0, s = law.S - 1.0;
  const double a = rho0 * law.C * law.C;
  double hugoniot = a * eta, slope = a;  // slope d/d eta
  if (eta > 0.0) {
    const double b = a * (1.0 + 2.0 * s), c = a * s * (2.0 + 3.0 * s);
    hugoniot = eta * (a + eta * (b + eta * c));
    slope = a + eta * (2.0 * b + eta * 3.0 * c);
  }
  const double weight = 1.0 - 0.5 * law.Gamma * eta;
  const double pressure = weight * hugoniot + law.Gamma * rho * energy;
  const double sound_squared =
      (weight * slope - 0.5 * law.Gamma * hugoniot) / rho0 + law.Gamma * energy + law.Gamma * pressure / rho;
  return {pressure, std::sqrt(std::max(sound_squared, 0.01 * law.C * law.C))};
}

SolidPressureSound evaluate(const SolidPressure& law, double rho0, double rho, double energy) {
  if (const auto* linear = std::get_if<LinearPressure>(&law)) return evaluate(*linear, rho0, rho, energy);
  return evaluate(*std::get_if<MieGruneisenPressure>(&law), rho0, rho, energy);
}

double bulk_modulus(const Solid& solid) {
  if (const auto* linear = std::get_if<LinearPressure>(&solid.pressure)) return linear->bulk_modulus;
  const double C = std::get_if<MieGruneisenPressure>(&solid.pressure)->C;
  return solid.rho0 * C * C;
}

double wave_speed(const Solid& solid) { return std::sqrt((bulk_modulus(solid) + 4.0 / 3.0 * solid.shear_modulus) / solid.rho0); }

}  // namespace undex::materials
