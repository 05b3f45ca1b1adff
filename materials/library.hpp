// Named material sets, every one with its source.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "materials/equation_of_state.hpp"
#include "materials/solid.hpp"

namespace undex::materials {

/// A fluid of the library: its law with all constants, and where they come from.
struct Fluid {
  std::string name, source;
  FluidLaw law;
  double rho0 = 1000.0;  ///< reference density [kg/m^3]
};

template <class Visit>
void describe(Fluid& fluid, Visit&& visit) {
  visit(ByHand{}, {.name = "base", .rule = "none", .values = "a material's name", .meaning = "start from its values"});
  visit(fluid.name, {.name = "name", .rule = "made from base or law", .meaning = "for records"});
  visit(fluid.source, {.name = "source", .rule = "\"the scene file\"", .meaning = "where the values come from"});
  visit(ByHand{}, {.name = "law", .rule = "that of `base`", .values = "a law below", .meaning = "needed without `base`"});
}

/// The set of that name, or nothing.
std::optional<Fluid> find_fluid(std::string_view name);
std::optional<Solid> find_solid(std::string_view name);
/// The names, in the order of the tables.
std::vector<std::string> fluid_names();
std::vector<std::string> solid_names();
/// Name in a scene file with unit ("B [Pa]", "flow.A [Pa]") and value, for tables; only those that the set uses.
std::vector<std::pair<std::string, double>> parameters(const Fluid& fluid);
std::vector<std::pair<std::string, double>> parameters(const Solid& solid);

}  // namespace undex::materials
