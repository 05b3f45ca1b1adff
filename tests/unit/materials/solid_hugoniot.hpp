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

}  // namespace undex::materials::testing
