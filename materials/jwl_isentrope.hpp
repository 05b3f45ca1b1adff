// Detonation products that are published by their isentrope (the form "JWLC"). SI units.
#pragma once

#include <optional>

#include "materials/jwl.hpp"

namespace undex::materials {

/// The isentrope through the Chapman-Jouguet state, V = rho0/rho:
///   p = A exp(-R1 V) + B exp(-R2 V) + C V^-(1 + omega).
/// It is the isentrope of a Jwl with the same A, B, R1, R2, omega: C is an energy in another spelling.
struct JwlIsentrope {
  double rho0;     ///< [kg/m^3]
  double A, B, C;  ///< [Pa]
  double R1, R2;   ///< [-]
  double omega;    ///< [-]

  double pressure(double volume) const;  ///< [Pa] at V [-]
  double slope(double volume) const;     ///< dp/dV [Pa]
  double energy(double volume) const;    ///< per initial volume [J/m^3], zero at infinite expansion
};

/// Detonation energy E0 [J/kg] of the Jwl that has this isentrope: where the Rayleigh line from rest touches it, at
/// p = (V - 1) dp/dV, the energy is E0 plus the work p (1 - V)/2 of the front. Throws std::domain_error where it touches none at
/// 0.2 < V < 1.
double detonation_energy(const JwlIsentrope& isentrope);

/// What a set leaves out: E0 is that of the isentrope with C [Pa] where there is one, D and p_cj where they are 0 those of the
/// set's own Chapman-Jouguet state. Throws std::domain_error where there is no such state.
void fill_in(Jwl::Parameters& parameters, const std::optional<double>& C);

}  // namespace undex::materials
