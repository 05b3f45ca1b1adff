// Inverse of a pressure law that has no closed one. Used when a scene is set up, never in a time step.
#pragma once

#include <sstream>
#include <stdexcept>

namespace undex::materials {

/// Least density [kg/m^3] in [low, high] at which law.evaluate(rho, energy) reaches `pressure` [Pa] from
/// below, to round-off. Throws std::domain_error naming the law and the pressures found on the way.
template <class Law>
double search_density(const Law& law, const char* name, double pressure, double energy, double low, double high) {
  const auto at = [&](double rho) { return law.evaluate(rho, energy).pressure; };
  const double lowest = at(low);
  double below = low, highest = lowest;
  if (lowest == pressure) return low;
  if (lowest < pressure) {
    // Steps of one per cent: finer than any fold of the laws in use.
    for (double rho = low; rho < high;) {
      rho = rho * 1.01 < high ? rho * 1.01 : high;
      const double p = at(rho);
      if (p > highest) highest = p;
      if (p < pressure) {
        below = rho;
        continue;
      }
      double above = rho;
      for (double middle = 0.5 * (below + above); middle > below && middle < above; middle = 0.5 * (below + above))
        (at(middle) < pressure ? below : above) = middle;
      return above;
    }
  }
  std::ostringstream text;
  text << name << " has no density at " << pressure << " Pa and " << energy << " J/kg: between " << low << " and " << high
       << " kg/m^3 its pressure goes from " << lowest << " to " << highest << " Pa";
  throw std::domain_error(text.str());
}

}  // namespace undex::materials
