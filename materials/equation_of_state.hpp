// Pressure laws of fluids, gathered. SI units; pressure is positive in compression; energies are specific
// (per mass, J/kg). Every law answers pressure and sound speed together, so that a pass over one material
// asks once per particle:
//   PressureSound evaluate(double rho, double energy) const       inline, for the loop inside one std::visit
//   per block double void_fraction(double rho, double energy = 0) const double density_at(double pressure,
//   double energy) const static constexpr bool uses_energy; barotropic laws also have barotropic_energy(rho)
#pragma once

#include <variant>

#include "materials/gas.hpp"
#include "materials/jwl.hpp"
#include "materials/mie_gruneisen_water.hpp"
#include "materials/pressure_sound.hpp"
#include "materials/stiffened_gas.hpp"
#include "materials/tait_water.hpp"

namespace undex::materials {

using FluidLaw = std::variant<TaitWater, BarotropicGas, IdealGas, StiffenedGas, Jwl, MieGruneisenWater>;

/// Does the law need an internal-energy field?
bool uses_energy(const FluidLaw& law);
/// Density [kg/m^3] at which the law gives `pressure` [Pa] at specific energy `energy` [J/kg]; throws
/// std::domain_error naming the law and the attainable range when there is none.
double density_at(const FluidLaw& law, double pressure, double energy);

}  // namespace undex::materials
