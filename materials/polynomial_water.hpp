// Water by a cubic polynomial in its compression: the form of Wardlaw and Luton, as public codes of close-in underwater
// explosions have it. SI units; the energy argument is per mass.
#pragma once

#include <algorithm>
#include <cmath>

#include "materials/pressure_sound.hpp"

namespace undex::materials {

/// With mu = rho/rho0 - 1 and e counted from the state of reference (rho0, no pressure),
///   p = A mu + B mu^2 + C mu^3 + omega rho e   for mu > 0,
///   p = A mu + omega rho e                     otherwise,
/// cut off at p_floor. Where it is, the sound speed is that of the liquid at the density where it reaches p_floor at the same
/// energy. In tension the parabola would turn back at mu = -A/(2 B), which no liquid does: the line goes on.
class PolynomialWater {
 public:
  /// Defaults: the set of two public codes (blastFoam, validation/blastFSIFoam; amrex_implicit_interfaces, PROBCOMMON.F90).
  struct Parameters {
    double rho0 = 1000.0;                        ///< [kg/m^3]
    double A = 2.2e9, B = 9.94e9, C = 14.57e9;   ///< [Pa]
    double omega = 0.28;                         ///< [-]
    Cavitation cavitation = Cavitation::cutoff;  ///< none or cutoff
    double p_floor = 5000.0;                     ///< [Pa]
  };
  static constexpr const char* name = "polynomial";
  static constexpr const char* summary = "water with energy: p = A mu + B mu^2 + C mu^3 + omega rho e, mu = rho/rho0 - 1";
  static constexpr bool uses_energy = true, is_gas = false;
  /// Throws std::invalid_argument unless rho0, A > 0, B, C, omega >= 0 and the cavitation model is none or cutoff.
  explicit PolynomialWater(const Parameters& parameters);
  const Parameters& parameters() const { return p_; }
  PressureSound evaluate(double rho, double energy) const;
  /// Volume fraction of vapour (without mass) in [0, 1]; 0 at and above the density at which the liquid of that energy [J/kg]
  /// reaches p_floor, always 0 without cavitation.
  double void_fraction(double rho, double energy = 0.0) const;
  /// Least pressure [Pa]: that of the cut-off; without one there is none, and the answer is -1e30.
  double least_pressure() const { return p_.cavitation == Cavitation::none ? -1e30 : p_.p_floor; }
  /// Density [kg/m^3] at `pressure` [Pa] and `energy` [J/kg]; at p_floor the cut-off density. Searched up to twice rho0; throws
  /// std::domain_error where there is none.
  double density_at(double pressure, double energy) const;
  /// Density at which the liquid of `energy` [J/kg] reaches p_floor [kg/m^3].
  double cutoff_density(double energy) const;

 private:
  Parameters p_;
};

template <class Visit>
void describe(PolynomialWater::Parameters& p, Visit&& visit) {
  visit(p.rho0, {.name = "rho0", .unit = "kg/m^3", .range = Range::positive(), .meaning = "density of reference"});
  visit(p.A, {.name = "A", .unit = "Pa", .range = Range::positive(), .meaning = "bulk modulus: linear term"});
  visit(p.B, {.name = "B", .unit = "Pa", .range = Range::at_least(0), .meaning = "quadratic term, in compression only"});
  visit(p.C, {.name = "C", .unit = "Pa", .range = Range::at_least(0), .meaning = "cubic term, in compression only"});
  visit(p.omega, {.name = "omega", .range = Range::at_least(0), .meaning = "Grüneisen parameter"});
  visit(p.cavitation,
        {.name = "cavitation", .values = "\"cutoff\", \"none\"", .meaning = "pressure held at `p_floor`, or tension"});
  visit(p.p_floor, {.name = "p_floor", .unit = "Pa", .used = p.cavitation != Cavitation::none, .meaning = "least pressure"});
}

/// Root of A (rho/rho0 - 1) + omega rho e = p_floor on the branch in tension, and above rho0 of the cubic, by Newton's method.
inline double PolynomialWater::cutoff_density(double energy) const {
  const double line = p_.rho0 * (p_.A + p_.p_floor) / (p_.A + p_.omega * p_.rho0 * energy);
  if (line <= p_.rho0) return line;
  double mu = line / p_.rho0 - 1.0;  // above the root: the polynomial is convex
  for (int k = 0; k < 50; ++k) {
    const double excess = mu * (p_.A + mu * (p_.B + mu * p_.C)) + p_.omega * p_.rho0 * (1.0 + mu) * energy - p_.p_floor;
    const double step = excess / (p_.A + mu * (2.0 * p_.B + 3.0 * mu * p_.C) + p_.omega * p_.rho0 * energy);
    mu -= step;
    if (!(std::abs(step) > 1e-16)) break;
  }
  return p_.rho0 * (1.0 + mu);
}

inline PressureSound PolynomialWater::evaluate(double rho, double energy) const {
  const double mu = rho / p_.rho0 - 1.0, bent = std::max(mu, 0.0);
  double pressure = p_.A * mu + bent * bent * (p_.B + bent * p_.C) + p_.omega * rho * energy;
  double slope = p_.A + bent * (2.0 * p_.B + 3.0 * bent * p_.C);
  if (pressure < p_.p_floor && p_.cavitation == Cavitation::cutoff) {
    pressure = p_.p_floor;
    rho = cutoff_density(energy);
    const double at = std::max(rho / p_.rho0 - 1.0, 0.0);
    slope = p_.A + at * (2.0 * p_.B + 3.0 * at * p_.C);
  }
  const double sound_squared = slope / p_.rho0 + p_.omega * (energy + pressure / rho);
  return {pressure, std::sqrt(std::max(sound_squared, 0.01 * p_.A / p_.rho0))};
}

inline double PolynomialWater::void_fraction(double rho, double energy) const {
  if (p_.cavitation == Cavitation::none) return 0.0;
  return std::clamp(1.0 - rho / cutoff_density(energy), 0.0, 1.0);
}

}  // namespace undex::materials
