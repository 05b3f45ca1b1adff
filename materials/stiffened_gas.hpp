// Stiffened gas, the simplest law of a liquid with an energy of its own: an ideal gas under the constant inner
// pressure p_inf (F. H. Harlow, A. A. Amsden, Fluid Dynamics, Los Alamos report LA-4700, 1971). SI units;
// energies are per mass.
#pragma once

#include "materials/pressure_sound.hpp"

namespace undex::materials {

/// p = (gamma - 1) rho e - gamma p_inf, c^2 = gamma (p + p_inf)/rho. Its Riemann problems are those of the ideal
/// gas with p + p_inf in place of p. It carries tension down to -p_inf: it does not cavitate.
class StiffenedGas {
 public:
  struct Parameters {
    double rho0;   ///< reference density [kg/m^3]; the law itself does not depend on it
    double gamma;  ///< [-], above 1
    double p_inf;  ///< [Pa], not negative; 0 is the ideal gas
  };
  static constexpr const char* name = "stiffened_gas";
  static constexpr const char* summary =
      "p = (gamma - 1) rho e - gamma p_inf, a liquid that carries tension down to -p_inf (its bodies need `energy`)";
  static constexpr bool uses_energy = true, is_gas = false;
  /// Throws std::invalid_argument unless rho0 > 0, gamma > 1 and p_inf >= 0.
  explicit StiffenedGas(const Parameters& parameters);
  const Parameters& parameters() const { return p_; }
  PressureSound evaluate(double rho, double energy) const;
  double void_fraction(double, double = 0.0) const { return 0.0; }
  double least_pressure() const { return -p_.p_inf; }
  /// Density [kg/m^3] at `pressure` [Pa] and `energy` [J/kg]; throws std::domain_error unless the pressure is
  /// above -gamma p_inf and the energy positive.
  double density_at(double pressure, double energy) const;

 private:
  Parameters p_;
};

template <class Visit>
void describe(StiffenedGas::Parameters& p, Visit&& visit) {
  visit(p.rho0, {.name = "rho0", .unit = "kg/m^3", .range = Range::positive(), .needed = true, .meaning = "reference density"});
  visit(p.gamma, {.name = "gamma", .range = Range::above(1, 100), .needed = true, .meaning = "ratio of specific heats"});
  visit(p.p_inf, {.name = "p_inf", .unit = "Pa", .range = Range::at_least(0), .needed = true, .meaning = "inner pressure"});
}

inline PressureSound StiffenedGas::evaluate(double rho, double energy) const {
  const double pressure = (p_.gamma - 1.0) * rho * energy - p_.gamma * p_.p_inf;
  return {pressure, guarded_sound_speed(p_.gamma * (pressure + p_.p_inf) / rho)};
}

}  // namespace undex::materials
