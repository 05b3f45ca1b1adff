// Checks that every pressure law must pass, by independent numerical means.
#pragma once

#include <cmath>

namespace undex::materials::test {

/// Squared sound speed [m^2/s^2] by central differences along the isentrope de = p drho/rho^2.
template <class Law>
double isentropic_slope(const Law& law, double rho, double energy, double relative_step = 1e-5) {
  const double h = relative_step * rho;
  // Second-order step along the isentrope: energy at rho +- h from the pressure half-way there.
  const auto along = [&](double step) {
    const double p0 = law.evaluate(rho, energy).pressure;
    const double half_rho = rho + 0.5 * step;
    const double half = energy + p0 * (1.0 / rho - 1.0 / half_rho);
    const double p_half = law.evaluate(half_rho, half).pressure;
    return law.evaluate(rho + step, energy + p_half * (1.0 / rho - 1.0 / (rho + step))).pressure;
  };
  return (along(h) - along(-h)) / (2.0 * h);
}

/// Integral of p/rho^2 from `from` to `to` [kg/m^3] for a barotropic law, by Simpson's rule in ln rho.
template <class Law>
double compression_work(const Law& law, double from, double to, int intervals = 20000) {
  const double h = std::log(to / from) / intervals;
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double rho = from * std::exp(i * h);
    const double weight = i == 0 || i == intervals ? 1.0 : (i % 2 ? 4.0 : 2.0);
    sum += weight * law.evaluate(rho, 0.0).pressure / rho;
  }
  return sum * h / 3.0;
}

}  // namespace undex::materials::test
