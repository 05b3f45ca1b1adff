// A solid: pressure law, flow stress, failure. Shared by every discretisation. Chen, Peng, Lien, Zhao 2019, doi
// 10.1007/s40571-019-00230-7, eqs 14-23. Cauchy stress, positive in tension; pressure positive in compression; SI units.
#pragma once

#include <optional>
#include <string>

#include "materials/failure.hpp"
#include "materials/flow_stress.hpp"
#include "materials/solid_pressure.hpp"

namespace undex::materials {

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

template <class Visit>
void describe(Solid& solid, Visit&& visit) {
  visit(ByHand{}, {.name = "base", .rule = "none", .values = "a material's name", .meaning = "start from its values"});
  visit(solid.name, {.name = "name", .rule = "made from base", .meaning = "for records"});
  visit(solid.source, {.name = "source", .rule = "\"the scene file\"", .meaning = "where the values come from"});
  visit(solid.rho0, {.name = "rho0",
                     .unit = "kg/m^3",
                     .range = Range::positive(),
                     .needed = true,
                     .remedy = "give the density in kg/m^3",
                     .meaning = "reference density"});
  visit(ByHand{}, {.name = "young_modulus",
                   .unit = "Pa",
                   .range = Range::positive(),
                   .rule = "none",
                   .meaning = "with `poisson_ratio`: gives shear and bulk modulus"});
  visit(ByHand{},
        {.name = "poisson_ratio", .range = Range::above(-1, 0.4999), .rule = "none", .meaning = "with `young_modulus`"});
  visit(solid.shear_modulus, {.name = "shear_modulus",
                              .unit = "Pa",
                              .range = Range::positive(),
                              .rule = "required without `young_modulus`",
                              .meaning = "elastic stiffness in shear"});
  visit(
      ByHand{},
      {.name = "pressure", .rule = "linear, from `young_modulus`", .values = "{law = ..., ...}", .meaning = "the pressure law"});
  visit(ByHand{}, {.name = "flow",
                   .needed = true,
                   .remedy = "e.g. flow = {law = \"elastic\"}",
                   .values = "{law = ..., ...}",
                   .meaning = "the flow stress"});
  visit(ByHand{}, {.name = "spall",
                   .rule = "none: any tension is carried",
                   .values = "{strength = ..., mode = ...}",
                   .meaning = "tensile strength of the pressure"});
  visit(ByHand{}, {.name = "damage",
                   .rule = "none: plastic strain does not break",
                   .values = "{D1 = ..., ...}",
                   .meaning = "Johnson-Cook fracture"});
  visit(solid.heat_capacity, {.name = "heat_capacity",
                              .unit = "J/kg/K",
                              .range = Range::positive(),
                              .meaning = "of what plastic work heats, and with pressure law \"mie_gruneisen\" shocks"});
  visit(solid.taylor_quinney,
        {.name = "taylor_quinney", .range = Range::between(0, 1), .meaning = "share of the plastic work that heats"});
  visit(solid.T_room, {.name = "T_room", .unit = "K", .range = Range::above(0, 1e4), .meaning = "temperature at the start"});
}

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

/// Has matter parted, which carries `pressure` [Pa], and no tension if it is `broken`?
inline bool is_parted(const Solid& solid, double pressure, bool broken) {
  return broken ? pressure <= 0.0 : solid.spall && pressure <= -solid.spall->strength;
}

/// What a step does to the volume of matter.
struct VolumeStep {
  double before, after;  ///< specific volume [m^3/kg]
  double energy;         ///< internal energy before [J/kg]
  double pressure_work;  ///< done on it by the pressure [J/kg]
  double dissipated;     ///< what else heats it, plastic work apart: shocks above all [J/kg]
  bool parted = false;   ///< before or after it (is_parted): its volume is not that of the matter, which does not cool
};
/// Temperature [K] after a step from that before it.
struct Warming {
  double factor = 1.0, rise = 0.0;
  double operator()(double temperature) const { return factor * temperature + rise; }
};
/// That of the isentrope through the state before the step, and what the energy is above it (docs/theory/equations.md,
/// "Temperature"): exact for shocks of any number of steps. A pressure law without energy has neither the warmth of
/// compression nor that of shocks: the temperature is then that of plastic work alone, and unchanged here.
Warming warming(const Solid& solid, const VolumeStep& step);
/// Rise [K] by what is dissipated [J/kg] at a constant volume, plastic work apart; none with a pressure law without energy.
double rise_by(const Solid& solid, double dissipated);

/// Bulk modulus at rest [Pa].
double bulk_modulus(const Solid& solid);
/// Longitudinal (dilatational) elastic wave speed at rest [m/s].
double wave_speed(const Solid& solid);

}  // namespace undex::materials
