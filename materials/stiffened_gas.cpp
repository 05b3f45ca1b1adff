// Stiffened gas: checks and inverse.
#include "materials/stiffened_gas.hpp"

#include <sstream>
#include <stdexcept>

namespace undex::materials {

StiffenedGas::StiffenedGas(const Parameters& parameters) : p_(parameters) {
  const auto require = [](bool holds, const char* what, double value) {
    if (holds) return;
    std::ostringstream text;
    text << "StiffenedGas: " << what << ", got " << value;
    throw std::invalid_argument(text.str());
  };
  require(p_.rho0 > 0, "rho0 [kg/m^3] must be positive", p_.rho0);
  require(p_.gamma > 1, "gamma must exceed 1", p_.gamma);
  require(p_.b >= 0 && p_.b * p_.rho0 < 1, "b [m^3/kg] must be at least 0 and less than 1/rho0", p_.b);
  require(p_.p_inf >= 0, "p_inf [Pa] must not be negative", p_.p_inf);
}

double StiffenedGas::density_at(double pressure, double energy) const {
  const double stiffened = pressure + p_.gamma * p_.p_inf;
  const double heat = (p_.gamma - 1.0) * (energy - p_.q);
  if (!(stiffened > 0 && heat > 0)) {
    std::ostringstream text;
    text << "stiffened gas has no density at " << pressure << " Pa and " << energy << " J/kg: its pressures are above "
         << -p_.gamma * p_.p_inf << " Pa, and need an energy above " << p_.q << " J/kg";
    throw std::domain_error(text.str());
  }
  return stiffened / (heat + p_.b * stiffened);
}

}  // namespace undex::materials
