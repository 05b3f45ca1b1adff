// Gases: the barotropic bubble gas of Chen, Peng, Lien, Zhao 2019, doi 10.1007/s40571-019-00230-7, eqs 25-26,
// and the ideal gas. SI units; energies are per mass.
#pragma once

#include <cmath>

#include "materials/pressure_sound.hpp"

namespace undex::materials {

/// Bubble gas p = p0 (rho/rho0)^gamma (eq. 25). Barotropic: the energy argument is ignored.
class BarotropicGas {
 public:
  struct Parameters {
    double rho0;   ///< [kg/m^3]
    double p0;     ///< pressure at rho0 [Pa]
    double gamma;  ///< [-], above 1
  };
  static constexpr const char* name = "barotropic_gas";
  static constexpr const char* summary = "p = p0 (rho/rho0)^gamma";
  static constexpr bool uses_energy = false, is_gas = true;
  /// Throws std::invalid_argument unless rho0 > 0, p0 > 0, gamma > 1.
  explicit BarotropicGas(const Parameters& parameters);
  const Parameters& parameters() const { return p_; }
  PressureSound evaluate(double rho, double /*energy*/) const;
  /// Compression energy e [J/kg] with de/drho = p/rho^2, zero at infinite expansion: p/((gamma - 1) rho), all
  /// the work that the gas can still do.
  double barotropic_energy(double rho) const;
  double void_fraction(double, double = 0.0) const { return 0.0; }
  double least_pressure() const { return 0.0; }
  /// Density [kg/m^3] at `pressure` [Pa]; throws std::domain_error unless the pressure is positive.
  double density_at(double pressure, double /*energy*/ = 0.0) const;

 private:
  Parameters p_;
};

template <class Visit>
void describe(BarotropicGas::Parameters& p, Visit&& visit) {
  visit(p.rho0, {.name = "rho0", .unit = "kg/m^3", .range = Range::positive(), .needed = true, .meaning = "reference density"});
  visit(p.p0, {.name = "p0", .unit = "Pa", .range = Range::positive(), .needed = true, .meaning = "pressure at `rho0`"});
  visit(p.gamma, {.name = "gamma", .range = Range::above(1, 100), .needed = true, .meaning = "ratio of specific heats"});
}

inline PressureSound BarotropicGas::evaluate(double rho, double) const {
  const double ratio = rho / p_.rho0;
  // The bubble gas of the paper has gamma = 2, for which a pow would be waste.
  const double pressure = p_.p0 * (p_.gamma == 2.0 ? ratio * ratio : std::pow(ratio, p_.gamma));
  return {pressure, guarded_sound_speed(p_.gamma * pressure / rho)};
}

/// Ideal gas p = (gamma - 1) rho e. A negative energy gives a negative pressure: nothing is clamped here but
/// the sound speed, the ledger of such states is the caller's.
class IdealGas {
 public:
  struct Parameters {
    double rho0;   ///< reference density [kg/m^3]; the law itself does not depend on it
    double gamma;  ///< [-], above 1
  };
  static constexpr const char* name = "ideal_gas";
  static constexpr const char* summary = "p = (gamma - 1) rho e";
  static constexpr bool uses_energy = true, is_gas = true;
  /// Throws std::invalid_argument unless rho0 > 0, gamma > 1.
  explicit IdealGas(const Parameters& parameters);
  const Parameters& parameters() const { return p_; }
  PressureSound evaluate(double rho, double energy) const;
  double void_fraction(double, double = 0.0) const { return 0.0; }
  double least_pressure() const { return 0.0; }
  /// Density [kg/m^3] at `pressure` [Pa] and `energy` [J/kg]; throws std::domain_error unless both are
  /// positive.
  double density_at(double pressure, double energy) const;

 private:
  Parameters p_;
};

template <class Visit>
void describe(IdealGas::Parameters& p, Visit&& visit) {
  visit(p.rho0, {.name = "rho0", .unit = "kg/m^3", .range = Range::positive(), .needed = true, .meaning = "reference density"});
  visit(p.gamma, {.name = "gamma", .range = Range::above(1, 100), .needed = true, .meaning = "ratio of specific heats"});
}

inline PressureSound IdealGas::evaluate(double rho, double energy) const {
  const double per_density = (p_.gamma - 1.0) * energy;
  return {per_density * rho, guarded_sound_speed(p_.gamma * per_density)};
}

}  // namespace undex::materials
