// Mie-Grueneisen water: checks, the compression at which the shock fit ends, and the inverse.
#include "materials/mie_gruneisen_water.hpp"

#include "materials/density_search.hpp"

namespace undex::materials {

namespace {
constexpr double least_denominator = 0.1;  // of F: the shock fit is far outside its data there
constexpr double largest_compression = 4.0;
}  // namespace

MieGruneisenWater::MieGruneisenWater(const Parameters& parameters) : p_(parameters) {
  if (!(p_.rho0 > 0 && p_.C0 > 0)) {
    std::ostringstream text;
    text << "MieGruneisenWater: rho0 [kg/m^3] and C0 [m/s] must be positive, got " << p_.rho0 << " and " << p_.C0;
    throw std::invalid_argument(text.str());
  }
  if (p_.cavitation == Cavitation::schmidt || p_.cavitation == Cavitation::isentropic)
    throw std::invalid_argument(
        "MieGruneisenWater: cavitating mixtures belong to the Tait law; use cavitation 'cutoff' or 'none'");
  stiffness_ = p_.rho0 * p_.C0 * p_.C0;
  for (double low = 0.0; low < largest_compression; low += 1e-3) {
    double high = low + 1e-3;
    if (denominator(high) >= least_denominator) continue;
    for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
      (denominator(middle) >= least_denominator ? low : high) = middle;
    mu_limit_ = low;
    at_limit_ = compressed(low);
    break;
  }
}

double MieGruneisenWater::density_at(double pressure, double energy) const {
  if (p_.cavitation == Cavitation::cutoff && pressure == p_.p_floor) return cutoff_density(energy);
  const bool under_floor = p_.cavitation == Cavitation::cutoff && pressure < p_.p_floor;
  if (under_floor) {
    std::ostringstream text;
    text << "Mie-Grueneisen water has no density at " << pressure << " Pa: it cavitates at " << p_.p_floor << " Pa";
    throw std::domain_error(text.str());
  }
  return search_density(*this, "Mie-Grueneisen water", pressure, energy, 1e-3 * p_.rho0, 2.0 * p_.rho0);
}

}  // namespace undex::materials
