#include "materials/solid_pressure.hpp"

#include <algorithm>
#include <cmath>

namespace undex::materials {

SolidPressureSound evaluate(const LinearPressure& law, double rho0, double rho, double) {
  return {law.bulk_modulus * (rho / rho0 - 1.0), std::sqrt(law.bulk_modulus / rho0)};
}

double bulk_modulus(const LinearPressure& law, double) { return law.bulk_modulus; }

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

double bulk_modulus(const MieGruneisenPressure& law, double rho0) { return rho0 * law.C * law.C; }

SolidPressureSound evaluate(const SolidPressure& law, double rho0, double rho, double energy) {
  return std::visit([&](const auto& each) { return evaluate(each, rho0, rho, energy); }, law);
}

std::optional<double> gruneisen(const SolidPressure& law) {
  return std::visit([](const auto& each) { return gruneisen(each); }, law);
}

double bulk_modulus(const SolidPressure& law, double rho0) {
  return std::visit([&](const auto& each) { return bulk_modulus(each, rho0); }, law);
}

}  // namespace undex::materials
