// The pressure of a cell or layer at the end of a step. Its own work enters the energy that it depends on,
//   p = carried(law(rho, e)),  m e = other - (p_old + p)/2 dV,
// which two corrections solve; failed points carry no tension.
#pragma once

#include "materials/solid.hpp"

namespace undex::fem {

/// What a step does to a cell or layer beside its pressure, each per mass or per reference volume alike.
struct PressureStep {
  double density = 0;       ///< at the end [kg/m^3]
  double mass = 0;          ///< that the energies are those of
  double opened = 0;        ///< its gain of volume
  double other_energy = 0;  ///< internal energy at the end, but for the pressure's work
  double old_pressure = 0;  ///< [Pa]
  double intact = 1;        ///< share of its points that have not failed
};

/// The pressure that is carried [Pa], and the law's state.
struct CarriedPressure {
  double pressure = 0;
  materials::SolidPressureSound state;
};

/// `guess`: the law's state at the energy of the start.
inline CarriedPressure carried_pressure(const materials::Solid& material, const PressureStep& step,
                                        const materials::SolidPressureSound& guess) {
  const auto carried = [&](double law) {
    return law < 0.0 ? step.intact * materials::carried_pressure(material, law, 0.0) : law;
  };
  CarriedPressure end{.pressure = carried(guess.pressure), .state = guess};
  for (int correction = 0; correction < 2; ++correction) {
    const double energy = step.other_energy - 0.5 * (step.old_pressure + end.pressure) * step.opened;
    end.state = materials::evaluate(material.pressure, material.rho0, step.density, energy / step.mass);
    end.pressure = carried(end.state.pressure);
  }
  return end;
}

}  // namespace undex::fem
