// Pressure laws of solids, gathered, and what a law must be. Chen, Peng, Lien, Zhao 2019, doi 10.1007/s40571-019-00230-7,
// eqs 21-23. Pressure positive in compression; SI units. Compiled once, in solid_pressure.cpp, and not inlined, as the flow
// stress. Where a loop knows its pressure law, the overloads for the single laws save the dispatch.
#pragma once

#include <concepts>
#include <optional>
#include <variant>

#include "core/record.hpp"

namespace undex::materials {

/// p [Pa] and bulk sound speed [m/s], the isentropic dp/drho of the pressure law alone (no shear).
struct SolidPressureSound {
  double pressure, bulk_sound;
};

/// p = K (rho/rho0 - 1).
struct LinearPressure {
  static constexpr const char* name = "linear";
  static constexpr const char* summary = "p = K (rho/rho0 - 1)";
  double bulk_modulus;  ///< [Pa]
};
SolidPressureSound evaluate(const LinearPressure& law, double rho0, double rho, double energy);
double bulk_modulus(const LinearPressure& law, double rho0);
inline std::optional<double> gruneisen(const LinearPressure&) { return std::nullopt; }
template <class Visit>
void describe(LinearPressure& law, Visit&& visit) {
  visit(law.bulk_modulus, {.name = "bulk_modulus", .unit = "Pa", .range = Range::positive(), .needed = true, .meaning = "K"});
}

/// Mie-Grueneisen with a Hugoniot cubic in eta = rho/rho0 - 1 (eqs 21-23):
/// p = (1 - Gamma eta/2) p_H + Gamma rho e, with p_H linear in tension. Bulk sound is at least a tenth of C.
struct MieGruneisenPressure {
  static constexpr const char* name = "mie_gruneisen";
  static constexpr const char* summary =
      "p = (1 - Gamma eta/2) p_H + Gamma rho e, eta = rho/rho0 - 1, with a Hugoniot p_H cubic in eta";
  double C;      ///< bulk sound speed at rest [m/s]
  double S;      ///< slope of shock speed over particle speed [-]
  double Gamma;  ///< [-]
};
SolidPressureSound evaluate(const MieGruneisenPressure& law, double rho0, double rho, double energy);
double bulk_modulus(const MieGruneisenPressure& law, double rho0);
inline std::optional<double> gruneisen(const MieGruneisenPressure& law) { return law.Gamma; }
template <class Visit>
void describe(MieGruneisenPressure& law, Visit&& visit) {
  visit(law.C, {.name = "C", .unit = "m/s", .range = Range::positive(), .needed = true, .meaning = "bulk sound speed at rest"});
  visit(law.S, {.name = "S", .range = Range::at_least(0), .needed = true, .meaning = "slope of shock speed over particle speed"});
  visit(law.Gamma, {.name = "Gamma", .range = Range::at_least(0), .needed = true, .meaning = "Grüneisen parameter"});
}

/// A pressure law of a solid: it has a name and described constants, and answers at density rho [kg/m^3] and specific internal
/// energy e [J/kg], counted from zero at rest at room temperature; it knows its bulk modulus at rest [Pa] and its constant
/// Grueneisen parameter [-], none where it does not depend on the energy.
template <class Law>
concept IsSolidPressure = Described<Law> && requires(const Law& law, double rho0, double rho, double energy) {
  { Law::name } -> std::convertible_to<const char*>;     // in a scene file
  { Law::summary } -> std::convertible_to<const char*>;  // its formula, for docs/reference/scene-file.md
  { evaluate(law, rho0, rho, energy) } -> std::same_as<SolidPressureSound>;
  { bulk_modulus(law, rho0) } -> std::same_as<double>;
  { gruneisen(law) } -> std::same_as<std::optional<double>>;
};
template <IsSolidPressure... Laws>
using SolidPressures = std::variant<Laws...>;

using SolidPressure = SolidPressures<LinearPressure, MieGruneisenPressure>;

SolidPressureSound evaluate(const SolidPressure& law, double rho0, double rho, double energy);
std::optional<double> gruneisen(const SolidPressure& law);
double bulk_modulus(const SolidPressure& law, double rho0);

}  // namespace undex::materials
