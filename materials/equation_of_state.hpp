// Pressure laws of fluids, gathered, and what a law must be. SI units; pressure is positive in compression; energies are
// specific (per mass, J/kg).
#pragma once

#include <concepts>
#include <variant>

#include "materials/gas.hpp"
#include "materials/jwl.hpp"
#include "materials/mie_gruneisen_water.hpp"
#include "materials/polynomial_water.hpp"
#include "materials/pressure_sound.hpp"
#include "materials/stiffened_gas.hpp"
#include "materials/tait_water.hpp"

namespace undex::materials {

/// A pressure law of a fluid: it has a name, is made of described parameters, and answers at a density rho [kg/m^3] and a
/// specific energy [J/kg], which a barotropic law ignores. Pressure and sound speed come together and inline, so that a pass over
/// one material asks once per particle, inside one std::visit per body. Where it cavitates into a slower mixture,
/// `liquid_sound()` is the sound speed [m/s] that the fluid's viscosity keeps there.
template <class Law>
concept IsFluidLaw = std::constructible_from<Law, const typename Law::Parameters&> && Described<typename Law::Parameters> &&
    requires(const Law& law, double rho, double energy, double pressure) {
  { Law::name } -> std::convertible_to<const char*>;     // in a scene file
  { Law::summary } -> std::convertible_to<const char*>;  // its formula, for docs/reference/scene-file.md
  { Law::uses_energy } -> std::convertible_to<bool>;     // does it need an energy field?
  { Law::is_gas } -> std::convertible_to<bool>;          // does a body's smoothing length follow its density?
  { law.parameters().rho0 } -> std::convertible_to<double>;
  { law.evaluate(rho, energy) } -> std::same_as<PressureSound>;
  { law.void_fraction(rho, energy) } -> std::same_as<double>;
  { law.density_at(pressure, energy) } -> std::same_as<double>;
  { law.least_pressure() } -> std::same_as<double>;  // that it carries [Pa]: negative where it bears tension
};
/// A barotropic law also knows the energy of compression, de/drho = p/rho^2 [J/kg].
template <class Law>
concept IsBarotropic = !Law::uses_energy && requires(const Law& law, double rho) {
  { law.barotropic_energy(rho) } -> std::same_as<double>;
};

template <class... Laws>
requires((IsFluidLaw<Laws> && (Laws::uses_energy || IsBarotropic<Laws>)) && ...) using FluidLaws = std::variant<Laws...>;

using FluidLaw = FluidLaws<TaitWater, BarotropicGas, IdealGas, StiffenedGas, Jwl, MieGruneisenWater, PolynomialWater>;

/// Does the law need an internal-energy field?
bool uses_energy(const FluidLaw& law);
/// Does the smoothing length of a body follow its density, unless the scene says otherwise?
bool is_gas(const FluidLaw& law);
/// The least pressure [Pa] that the law carries: what it cavitates at, 0 of gases, a tension where the law goes on into it.
double least_pressure(const FluidLaw& law);
/// Density [kg/m^3] at which the law gives `pressure` [Pa] at specific energy `energy` [J/kg]; throws
/// std::domain_error naming the law and the attainable range when there is none.
double density_at(const FluidLaw& law, double pressure, double energy);
/// Energy of compression [J/kg] of a barotropic law; 0 of others.
double barotropic_energy(const FluidLaw& law, double rho);

}  // namespace undex::materials
