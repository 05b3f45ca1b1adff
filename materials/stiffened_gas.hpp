// Stiffened gas, the simplest law of a liquid with an energy of its own: an ideal gas under the constant inner
// pressure p_inf (F. H. Harlow, A. A. Amsden, Fluid Dynamics, Los Alamos report LA-4700, 1971); with the volume b
// of its molecules the Noble-Abel stiffened gas (O. Le Metayer, R. Saurel, Phys. Fluids 28, 046102, 2016). SI units;
// energies are per mass.
#pragma once

#include <algorithm>

#include "materials/pressure_sound.hpp"

namespace undex::materials {

/// p = (gamma - 1) rho (e - q)/(1 - b rho) - gamma p_inf, c^2 = gamma (p + p_inf)/(rho (1 - b rho)). With b = 0 its Riemann
/// problems are those of the ideal gas with p + p_inf in place of p. It carries tension down to -p_inf: it does not cavitate.
/// It ends at rho = 1/b, where pressure is infinite; the free volume is held at a thousandth from there on.
class StiffenedGas {
 public:
  struct Parameters {
    double rho0;   ///< reference density [kg/m^3]; the law itself does not depend on it
    double gamma;  ///< [-], above 1
    double p_inf;  ///< [Pa], not negative; 0 is the ideal gas
    double b = 0;  ///< volume of the molecules [m^3/kg], not negative
    double q = 0;  ///< energy without heat [J/kg]
  };
  static constexpr const char* name = "stiffened_gas";
  static constexpr const char* summary =
      "p = (gamma - 1) rho (e - q)/(1 - b rho) - gamma p_inf, a liquid that carries tension down to -p_inf (its bodies need "
      "`energy`); with `b` the Noble-Abel stiffened gas";
  static constexpr bool uses_energy = true, is_gas = false;
  /// Throws std::invalid_argument unless rho0 > 0, gamma > 1, p_inf >= 0 and 0 <= b < 1/rho0.
  explicit StiffenedGas(const Parameters& parameters);
  const Parameters& parameters() const { return p_; }
  PressureSound evaluate(double rho, double energy) const;
  /// Share of the volume that the molecules leave free [-].
  double free_share(double rho) const { return std::max(1.0 - p_.b * rho, 1e-3); }
  double void_fraction(double, double = 0.0) const { return 0.0; }
  double least_pressure() const { return -p_.p_inf; }
  /// Density [kg/m^3] at `pressure` [Pa] and `energy` [J/kg]; throws std::domain_error unless the pressure is
  /// above -gamma p_inf and the energy above q.
  double density_at(double pressure, double energy) const;
  /// Energy [J/kg] at which it has `pressure` [Pa] at `rho` [kg/m^3].
  double energy_at(double pressure, double rho) const {
    return (pressure + p_.gamma * p_.p_inf) * (1.0 - p_.b * rho) / ((p_.gamma - 1.0) * rho) + p_.q;
  }

 private:
  Parameters p_;
};

template <class Visit>
void describe(StiffenedGas::Parameters& p, Visit&& visit) {
  visit(p.rho0, {.name = "rho0", .unit = "kg/m^3", .range = Range::positive(), .needed = true, .meaning = "reference density"});
  visit(p.gamma, {.name = "gamma", .range = Range::above(1, 100), .needed = true, .meaning = "ratio of specific heats"});
  visit(p.p_inf, {.name = "p_inf", .unit = "Pa", .range = Range::at_least(0), .needed = true, .meaning = "inner pressure"});
  visit(p.b, {.name = "b", .unit = "m^3/kg", .range = Range::at_least(0), .meaning = "volume of the molecules, below 1/`rho0`"});
  visit(p.q, {.name = "q", .unit = "J/kg", .meaning = "energy without heat, from which the law counts"});
}

inline PressureSound StiffenedGas::evaluate(double rho, double energy) const {
  const double free = free_share(rho);
  const double pressure = (p_.gamma - 1.0) * rho * (energy - p_.q) / free - p_.gamma * p_.p_inf;
  return {pressure, guarded_sound_speed(p_.gamma * (pressure + p_.p_inf) / (rho * free))};
}

}  // namespace undex::materials
