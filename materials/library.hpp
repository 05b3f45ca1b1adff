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
  double rho0;  ///< reference density [kg/m^3]
};

/// The set of that name, or nothing.
std::optional<Fluid> find_fluid(std::string_view name);
std::optional<Solid> find_solid(std::string_view name);
/// The names, in the order of the tables.
std::vector<std::string> fluid_names();
std::vector<std::string> solid_names();
/// Parameter name with unit ("B [Pa]") and value, for tables; only those which the set uses.
std::vector<std::pair<std::string, double>> parameters(const Fluid& fluid);
std::vector<std::pair<std::string, double>> parameters(const Solid& solid);

}  // namespace undex::materials
