// Numbers of materials that are in range each by itself, and yet cannot be what was meant: other units, sets that contradict
// themselves.
#pragma once

#include <string>
#include <string_view>

#include "materials/equation_of_state.hpp"
#include "materials/solid.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {

/// Complains of parameters whose values are usual in other units only: before a law is made of them.
void expect_usual_units(const TableReader& table, const materials::Jwl::Parameters& p);
void expect_usual_units(const TableReader& table, const materials::TaitWater::Parameters& p);
void expect_usual_units(const TableReader& table, const materials::MieGruneisenWater::Parameters& p);
void expect_usual_units(const TableReader& table, const materials::PolynomialWater::Parameters& p);
void expect_usual_units(const TableReader& table, const materials::StiffenedGas::Parameters& p);
/// Gases are also used without dimensions.
inline void expect_usual_units(const TableReader&, const materials::BarotropicGas::Parameters&) {}
inline void expect_usual_units(const TableReader&, const materials::IdealGas::Parameters&) {}

/// Complains of what cannot be; `warnings` gets what can, and is unlikely.
void expect_plausible(const TableReader& table, const materials::FluidLaw& law, Report& warnings);
void expect_plausible(const TableReader& table, const materials::Solid& solid, Report& warnings);
/// The same of the front that a scene gives a charge of `products`, at `speed` [m/s].
void expect_plausible_burn(const TableReader& burn, const materials::Jwl& products, double speed, Report& warnings);

/// What is to be said of a pressure [Pa] that lies more than a twentieth beyond those to which a set of the library may be used;
/// empty where it does not, or is no set of the library.
std::string beyond_set(std::string_view material, double pressure);

}  // namespace undex::scene
