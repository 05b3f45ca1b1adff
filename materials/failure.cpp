#include "materials/failure.hpp"

#include <algorithm>
#include <cmath>

namespace undex::materials {

double fracture_strain(const JohnsonCookDamage& law, double triaxiality, double rate, double temperature) {
  constexpr double highest_triaxiality = 1.5, least = 1e-9;
  const double homologous = std::clamp((temperature - law.T_room) / (law.T_melt - law.T_room), 0.0, 1.0);
  // Far in compression the exponential is infinite, which D2 = 0 must not make a NaN of.
  const double constrained = law.D2 > 0.0 ? law.D2 * std::exp(law.D3 * std::min(triaxiality, highest_triaxiality)) : 0.0;
  const double by_rate = rate > law.rate0 ? 1.0 + law.D4 * std::log(rate / law.rate0) : 1.0;
  return std::max(least, (law.D1 + constrained) * std::max(by_rate, 0.0) * std::max(1.0 + law.D5 * homologous, 0.0));
}

}  // namespace undex::materials
