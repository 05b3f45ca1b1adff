// Detonation products after Jones, Wilkins and Lee: eq. 24 of Chen, Peng, Lien, Zhao 2019,
// doi 10.1007/s40571-019-00230-7, with E per mass. SI units.
#pragma once

#include <cmath>

#include "materials/pressure_sound.hpp"

namespace undex::materials {

/// p = A (1 - omega eta/R1) exp(-R1/eta) + B (1 - omega eta/R2) exp(-R2/eta) + omega rho e, eta = rho/rho0.
/// The specific energy e counts from the fully expanded cold products: the explosive starts with E0.
class Jwl {
 public:
  struct Parameters {
    double rho0;    ///< density of the solid explosive [kg/m^3]
    double A, B;    ///< [Pa]
    double R1, R2;  ///< [-]
    double omega;   ///< [-]
    double E0;      ///< detonation energy [J/kg]
    double D;       ///< detonation speed [m/s]
    double p_cj;    ///< Chapman-Jouguet pressure [Pa]; D and p_cj are as published, or else those of the rest (jwl_isentrope.hpp)
  };
  static constexpr const char* name = "jwl";
  static constexpr const char* summary =
      "detonation products, p = A (1 - omega eta/R1) exp(-R1/eta) + B (1 - omega eta/R2) "
      "exp(-R2/eta) + omega rho e, eta = rho/rho0";
  static constexpr bool uses_energy = true, is_gas = true;
  /// Throws std::invalid_argument unless rho0, R1, R2, omega, E0 and D are positive.
  explicit Jwl(const Parameters& parameters);
  const Parameters& parameters() const { return p_; }
  /// Products at rho [kg/m^3] and energy [J/kg]; two exponentials. Sound speed from the isentropic derivative
  /// dp/drho|e + p/rho^2 dp/de|rho, guarded to stay positive where a state has no energy left.
  PressureSound evaluate(double rho, double energy) const;
  double void_fraction(double, double = 0.0) const { return 0.0; }
  double least_pressure() const { return 0.0; }
  /// Density [kg/m^3] at `pressure` [Pa] and `energy` [J/kg], the least one where there are several; searched
  /// between 1e-6 rho0 and 4 rho0. Throws std::domain_error where there is none.
  double density_at(double pressure, double energy) const;

 private:
  Parameters p_;
};

template <class Visit>
void describe(Jwl::Parameters& p, Visit&& visit) {
  visit(p.rho0, {.name = "rho0",
                 .unit = "kg/m^3",
                 .range = Range::positive(),
                 .needed = true,
                 .meaning = "density of the solid explosive"});
  visit(p.A, {.name = "A", .unit = "Pa", .needed = true, .meaning = "stiffness of the products where they are dense"});
  visit(p.B, {.name = "B", .unit = "Pa", .needed = true, .meaning = "and further out"});
  visit(p.R1, {.name = "R1", .range = Range::positive(), .needed = true, .meaning = "decay of the first term"});
  visit(p.R2, {.name = "R2", .range = Range::positive(), .needed = true, .meaning = "and of the second"});
  visit(p.omega, {.name = "omega", .range = Range::positive(), .needed = true, .meaning = "Grüneisen parameter"});
  visit(p.E0, {.name = "E0",
               .unit = "J/kg",
               .range = Range::positive(),
               .rule = "from `C`",
               .meaning = "detonation energy per mass; it or `C` is needed"});
  visit(ByHand{}, {.name = "C",
                   .unit = "Pa",
                   .range = Range::positive(),
                   .rule = "from `E0`",
                   .meaning = "constant of the isentrope, in place of `E0`"});
  visit(p.D, {.name = "D",
              .unit = "m/s",
              .range = Range::positive(),
              .rule = "that of the set's own Chapman-Jouguet state",
              .meaning = "detonation speed"});
  visit(p.p_cj,
        {.name = "p_cj", .unit = "Pa", .range = Range::positive(), .rule = "as of `D`", .meaning = "Chapman-Jouguet pressure"});
}

inline PressureSound Jwl::evaluate(double rho, double energy) const {
  const double eta = rho / p_.rho0, volume = 1.0 / eta;
  const double first = p_.A * std::exp(-p_.R1 * volume), second = p_.B * std::exp(-p_.R2 * volume);
  const double first_factor = 1.0 - p_.omega * eta / p_.R1, second_factor = 1.0 - p_.omega * eta / p_.R2;
  const double pressure = first * first_factor + second * second_factor + p_.omega * rho * energy;
  const double slope = first * (first_factor * p_.R1 * volume * volume - p_.omega / p_.R1) +
                       second * (second_factor * p_.R2 * volume * volume - p_.omega / p_.R2);  // d/d eta, no energy
  const double sound_squared = slope / p_.rho0 + p_.omega * energy + p_.omega * pressure / rho;
  return {pressure, guarded_sound_speed(sound_squared)};
}

}  // namespace undex::materials
