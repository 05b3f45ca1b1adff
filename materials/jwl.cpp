// Jones-Wilkins-Lee products: checks and inverse.
#include "materials/jwl.hpp"

#include "materials/density_search.hpp"

namespace undex::materials {

Jwl::Jwl(const Parameters& parameters) : p_(parameters) {
  const auto positive = [](double value, const char* what) {
    if (value > 0) return;
    std::ostringstream text;
    text << "Jwl: " << what << " must be positive, got " << value;
    throw std::invalid_argument(text.str());
  };
  positive(p_.rho0, "rho0 [kg/m^3]");
  positive(p_.R1, "R1");
  positive(p_.R2, "R2");
  positive(p_.omega, "omega");
  positive(p_.E0, "E0 [J/kg]");
  positive(p_.D, "D [m/s]");
}

double Jwl::density_at(double pressure, double energy) const {
  return search_density(*this, "JWL", pressure, energy, 1e-6 * p_.rho0, 4.0 * p_.rho0);
}

}  // namespace undex::materials
