// Pressure and temperature behind plane shocks in perfectly plastic solids, from the conservation laws.
#pragma once

#include <cmath>

#include "materials/solid.hpp"

namespace undex::materials::testing {

/// Pressure [Pa] behind the shock of a perfectly plastic solid that stops from `u` [m/s] in uniaxial strain: mass, momentum and
/// energy across the front, the normal stress being p + 2Y/3.
inline double hugoniot_pressure(const Solid& solid, double u) {
  const double Y = flow_stress(solid.flow, 0, 0, 293);
  double low = 1.0001, high = 2.0;  // rho/rho0
  for (int k = 0; k < 200; ++k) {
    const double ratio = 0.5 * (low + high), strain = 1 - 1 / ratio;
    const double p = evaluate(solid.pressure, solid.rho0, solid.rho0 * ratio, 0.5 * u * u).pressure;
    // u^2 = stress strain/rho0, and the energy is u^2/2.
    ((p + 2.0 / 3.0 * Y) * strain / solid.rho0 < u * u ? low : high) = ratio;
  }
  return evaluate(solid.pressure, solid.rho0, solid.rho0 * low, 0.5 * u * u).pressure;
}

/// Temperature [K] behind that shock: c dT = -c Gamma T dv/v + de + p dv along the Hugoniot (Walsh and Christian 1955), less the cold
/// share of the plastic work 2Y/3 |dv|.
inline double hugoniot_temperature(const Solid& solid, double u) {
  const double Y = flow_stress(solid.flow, 0, 0, 293), gamma = *gruneisen(solid.pressure);
  const double v0 = 1 / solid.rho0, last = hugoniot_pressure(solid, u);
  double T = solid.T_room, v = v0, p = 0, e = 0;
  for (int k = 1; k <= 20000; ++k) {
    // The state of pressure k/20000 of the last: e = (p + 2Y/3)(v0 - v)/2 fixes v.
    const double next_p = last * k / 20000;
    double thin = 0.4 * v0, thick = v0;
    for (int m = 0; m < 60; ++m) {
      const double middle = 0.5 * (thin + thick);
      const double energy = 0.5 * (next_p + 2.0 / 3.0 * Y) * (v0 - middle);
      (evaluate(solid.pressure, solid.rho0, 1 / middle, energy).pressure > next_p ? thin : thick) = middle;
    }
    const double next_v = thin, next_e = 0.5 * (next_p + 2.0 / 3.0 * Y) * (v0 - next_v), dv = next_v - v;
    const double heat = next_e - e + 0.5 * (p + next_p) * dv + (1 - solid.taylor_quinney) * 2.0 / 3.0 * Y * dv;
    const double half = gamma * dv / (v + next_v);
    T = (T * (1 - half) + heat / solid.heat_capacity) / (1 + half);
    v = next_v, p = next_p, e = next_e;
  }
  return T;
}

/// Temperature [K] of a state: that of the isentrope through rest, T_room (rho/rho0)^Gamma, and what the energy [J/kg] is above it.
inline double temperature_of(const Solid& solid, double rho, double energy) {
  const int steps = 2000;
  double cold = 0, at = solid.rho0;
  const double h = (rho - at) / steps;
  for (int k = 0; k < steps; ++k, at += h) {  // de = p drho/rho^2
    const auto slope = [&](double r, double e) { return evaluate(solid.pressure, solid.rho0, r, e).pressure / (r * r); };
    cold += h * slope(at + h / 2, cold + h / 2 * slope(at, cold));
  }
  return solid.T_room * std::pow(rho / solid.rho0, *gruneisen(solid.pressure)) + (energy - cold) / solid.heat_capacity;
}

}  // namespace undex::materials::testing
