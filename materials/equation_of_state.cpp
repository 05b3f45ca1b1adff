// Questions asked of any fluid law when a scene is set up.
#include "materials/equation_of_state.hpp"

namespace undex::materials {

bool uses_energy(const FluidLaw& law) {
  return std::visit([](const auto& l) { return l.uses_energy; }, law);
}

bool is_gas(const FluidLaw& law) {
  return std::visit([](const auto& l) { return l.is_gas; }, law);
}

double least_pressure(const FluidLaw& law) {
  return std::visit([](const auto& l) { return l.least_pressure(); }, law);
}

double density_at(const FluidLaw& law, double pressure, double energy) {
  return std::visit([&](const auto& l) { return l.density_at(pressure, energy); }, law);
}

double barotropic_energy(const FluidLaw& law, double rho) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (std::decay_t<decltype(l)>::uses_energy) return 0.0;
        else return l.barotropic_energy(rho);
      },
      law);
}

}  // namespace undex::materials
