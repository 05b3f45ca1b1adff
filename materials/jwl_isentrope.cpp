// The isentrope of detonation products, and the energy that belongs to it.
#include "materials/jwl_isentrope.hpp"

#include <cmath>
#include <stdexcept>

#include "materials/burn.hpp"

namespace undex::materials {

double JwlIsentrope::pressure(double volume) const {
  return A * std::exp(-R1 * volume) + B * std::exp(-R2 * volume) + C * std::pow(volume, -1 - omega);
}

double JwlIsentrope::slope(double volume) const {
  return -A * R1 * std::exp(-R1 * volume) - B * R2 * std::exp(-R2 * volume) - C * (1 + omega) * std::pow(volume, -2 - omega);
}

double JwlIsentrope::energy(double volume) const {
  return A / R1 * std::exp(-R1 * volume) + B / R2 * std::exp(-R2 * volume) + C / omega * std::pow(volume, -omega);
}

double detonation_energy(const JwlIsentrope& isentrope) {
  // Near V = 1 the Rayleigh line is steeper than the isentrope.
  const auto steeper = [&](double volume) { return isentrope.pressure(volume) > -isentrope.slope(volume) * (1 - volume); };
  double high = 1, low = high;
  while (steeper(low)) {
    high = low;
    low -= 0.01;
    if (low < 0.2) throw std::domain_error("isentrope of products has no Chapman-Jouguet state at 0.2 < V < 1");
  }
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (steeper(middle) ? high : low) = middle;
  return (isentrope.energy(low) - 0.5 * isentrope.pressure(low) * (1 - low)) / isentrope.rho0;
}

void fill_in(Jwl::Parameters& p, const std::optional<double>& C) {
  if (C) p.E0 = detonation_energy({.rho0 = p.rho0, .A = p.A, .B = p.B, .C = *C, .R1 = p.R1, .R2 = p.R2, .omega = p.omega});
  if (p.D > 0 && p.p_cj > 0) return;
  Jwl::Parameters any = p;
  any.D = 1;
  const ChapmanJouguet own = chapman_jouguet(Jwl(any));
  if (!(p.D > 0)) p.D = own.detonation_speed;
  if (!(p.p_cj > 0)) p.p_cj = own.pressure;
}

}  // namespace undex::materials
