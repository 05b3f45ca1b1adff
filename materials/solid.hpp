// A solid: pressure law, flow stress, failure. Shared by every discretisation. Chen, Peng, Lien, Zhao 2019, doi
// 10.1007/s40571-019-00230-7, eqs 14-23. Cauchy stress, positive in tension; pressure positive in compression; SI units.
// Compiled once, in solid.cpp, and not inlined, as the flow stress. Where a loop knows its pressure law, the overloads for
// the single laws save the dispatch.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "materials/failure.hpp"
#include "materials/flow_stress.hpp"

namespace undex::materials {

/// p = K (rho/rho0 - 1).
struct LinearPressure {
  double bulk_modulus;  ///< [Pa]
};
/// Mie-Grueneisen with a Hugoniot cubic in eta = rho/rho0 - 1 (eqs 21-23):
/// p = (1 - Gamma eta/2) p_H + Gamma rho e, with p_H linear in tension.
struct MieGruneisenPressure {
  double C;      ///< bulk sound speed at rest [m/s]
  double S;      ///< slope of shock speed over particle speed [-]
  double Gamma;  ///< [-]
};
using SolidPressure = std::variant<LinearPressure, MieGruneisenPressure>;

struct Solid {
  std::string name, source;
  double rho0;           ///< [kg/m^3]
  double shear_modulus;  ///< [Pa]
  SolidPressure pressure;
  FlowStress flow;
  double heat_capacity = 900.0;             ///< [J/kg/K]
  double taylor_quinney = 0.9;              ///< share of the plastic work that heats
  double T_room = 293.0;                    ///< temperature at the start [K]
  std::optional<Spall> spall;               ///< without it any tension is carried
  std::optional<JohnsonCookDamage> damage;  ///< without it plastic strain does not break
};

/// p [Pa] and bulk sound speed [m/s].
struct SolidPressureSound {
  double pressure, bulk_sound;
};
/// At density rho [kg/m^3] and specific internal energy e [J/kg], counted from zero at rest at room
/// temperature. Bulk sound is the isentropic dp/drho of the pressure law alone (no shear), at least a tenth
/// of C for Mie-Grueneisen.
SolidPressureSound evaluate(const SolidPressure& law, double rho0, double rho, double energy);
SolidPressureSound evaluate(const LinearPressure& law, double rho0, double rho, double energy);
SolidPressureSound evaluate(const MieGruneisenPressure& law, double rho0, double rho, double energy);

/// A point that has failed has damage 1 [-]; below that its damage counts the share of the fracture strain spent.
inline constexpr double failed = 1.0;
/// Can a point of this solid fail? Then its damage has to be kept.
inline bool can_fail(const Solid& solid) { return solid.damage || (solid.spall && solid.spall->mode == Spall::Mode::fail); }
/// Does a point fail in which the pressure law gives `pressure` [Pa]? Then set its damage to `failed`.
inline bool spalls(const Solid& solid, double pressure) {
  return solid.spall && solid.spall->mode == Spall::Mode::fail && pressure <= -solid.spall->strength;
}
/// What a point of that damage carries of the `pressure` [Pa] that the pressure law (`evaluate`) gives: all compression,
/// tension up to the spall strength, none once it has failed.
inline double carried_pressure(const Solid& solid, double pressure, double damage) {
  if (pressure >= 0.0) return pressure;
  if (damage >= failed) return 0.0;
  return solid.spall && pressure < -solid.spall->strength ? -solid.spall->strength : pressure;
}

/// Radial return with the solid's law and shear modulus.
inline PlasticStep radial_return(const Solid& solid, double trial, double plastic_strain, double temperature, double dt) {
  return radial_return(solid.flow, solid.shear_modulus, trial, plastic_strain, temperature, dt);
}

/// Bulk modulus at rest [Pa].
double bulk_modulus(const Solid& solid);
/// Longitudinal (dilatational) elastic wave speed at rest [m/s].
double wave_speed(const Solid& solid);

}  // namespace undex::materials
