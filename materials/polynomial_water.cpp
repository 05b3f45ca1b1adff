// Polynomial water: checks and the inverse.
#include "materials/polynomial_water.hpp"

#include "materials/density_search.hpp"

namespace undex::materials {

PolynomialWater::PolynomialWater(const Parameters& parameters) : p_(parameters) {
  if (!(p_.rho0 > 0 && p_.A > 0 && p_.B >= 0 && p_.C >= 0 && p_.omega >= 0)) {
    std::ostringstream text;
    text << "PolynomialWater: rho0 [kg/m^3] and A [Pa] must be positive, B, C [Pa] and omega not negative, got " << p_.rho0
         << ", " << p_.A << ", " << p_.B << ", " << p_.C << " and " << p_.omega;
    throw std::invalid_argument(text.str());
  }
  if (p_.cavitation == Cavitation::schmidt || p_.cavitation == Cavitation::isentropic)
    throw std::invalid_argument("PolynomialWater: cavitating mixtures belong to the Tait law; use cavitation 'cutoff' or 'none'");
}

double PolynomialWater::density_at(double pressure, double energy) const {
  if (p_.cavitation == Cavitation::cutoff && pressure == p_.p_floor) return cutoff_density(energy);
  if (p_.cavitation == Cavitation::cutoff && pressure < p_.p_floor) {
    std::ostringstream text;
    text << "polynomial water has no density at " << pressure << " Pa: it cavitates at " << p_.p_floor << " Pa";
    throw std::domain_error(text.str());
  }
  return search_density(*this, "polynomial water", pressure, energy, 1e-3 * p_.rho0, 2.0 * p_.rho0);
}

}  // namespace undex::materials
