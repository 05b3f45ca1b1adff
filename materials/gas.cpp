// Gases: checks, compression energy and inverses.
#include "materials/gas.hpp"

#include <sstream>
#include <stdexcept>

namespace undex::materials {

namespace {

void require(bool holds, const char* what, double value) {
  if (holds) return;
  std::ostringstream text;
  text << what << ", got " << value;
  throw std::invalid_argument(text.str());
}

}  // namespace

BarotropicGas::BarotropicGas(const Parameters& parameters) : p_(parameters) {
  require(p_.rho0 > 0, "BarotropicGas: rho0 [kg/m^3] must be positive", p_.rho0);
  require(p_.p0 > 0, "BarotropicGas: p0 [Pa] must be positive", p_.p0);
  require(p_.gamma > 1, "BarotropicGas: gamma must exceed 1", p_.gamma);
}

double BarotropicGas::barotropic_energy(double rho) const {
  return p_.p0 / ((p_.gamma - 1.0) * p_.rho0) * std::pow(rho / p_.rho0, p_.gamma - 1.0);
}

double BarotropicGas::density_at(double pressure, double) const {
  if (!(pressure > 0)) {
    std::ostringstream text;
    text << "barotropic gas has no density at " << pressure << " Pa: its pressures are positive";
    throw std::domain_error(text.str());
  }
  return p_.rho0 * std::pow(pressure / p_.p0, 1.0 / p_.gamma);
}

IdealGas::IdealGas(const Parameters& parameters) : p_(parameters) {
  require(p_.rho0 > 0, "IdealGas: rho0 [kg/m^3] must be positive", p_.rho0);
  require(p_.gamma > 1, "IdealGas: gamma must exceed 1", p_.gamma);
}

double IdealGas::density_at(double pressure, double energy) const {
  if (!(pressure > 0 && energy > 0)) {
    std::ostringstream text;
    text << "ideal gas has no density at " << pressure << " Pa and " << energy
         << " J/kg: its pressures are positive, and need a positive energy";
    throw std::domain_error(text.str());
  }
  return pressure / ((p_.gamma - 1.0) * energy);
}

}  // namespace undex::materials
