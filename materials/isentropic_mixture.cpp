#include "materials/isentropic_mixture.hpp"

#include <algorithm>
#include <cmath>

namespace undex::materials {

IsentropicMixture::IsentropicMixture(const Constants& constants)
    : c_(constants),
      k_(constants.initial_void / (1.0 - constants.initial_void)),
      mass_(constants.liquid_density + k_ * constants.vapour_density) {}

// The liquid stretches by a millionth between p_sat and nothing: what it adds to the vapour's share is kept to round-off.
double IsentropicMixture::liquid_stretch(double p) const {
  return std::expm1(-std::log1p((p - c_.p_sat) / (c_.p_sat + c_.stiffness)) / c_.N);
}

double IsentropicMixture::vapour_stretch(double p) const { return std::pow(p / c_.p_sat, -1.0 / c_.gamma); }

double IsentropicMixture::density(double p) const { return mass_ / (1.0 + liquid_stretch(p) + k_ * vapour_stretch(p)); }

double IsentropicMixture::pressure(double rho) const {
  // L(y) - 1 + k y = r: the left side rises with y, ever more slowly. From below the root Newton's steps climb to it without
  // passing it; L is at most its value in empty space.
  const double r = (mass_ - rho) / rho;
  double y = std::max(1.0, (r - liquid_stretch(0.0)) / k_);
  for (int step = 0; step < 60; ++step) {
    const double p = c_.p_sat * std::pow(y, -c_.gamma), L = liquid_stretch(p);
    const double slope = (1.0 + L) / (c_.N * (p + c_.stiffness)) * c_.gamma * p / y + k_;
    const double change = (r - L - k_ * y) / slope;
    y = std::max(1.0, y + change);
    if (std::abs(change) <= 1e-15 * y) break;
  }
  return c_.p_sat * std::pow(y, -c_.gamma);
}

double IsentropicMixture::void_fraction(double p) const {
  const double vapour = k_ * vapour_stretch(p);
  return vapour / (1.0 + liquid_stretch(p) + vapour);
}

double IsentropicMixture::sound_squared(double p) const {
  const double alpha = void_fraction(p);
  return 1.0 / (density(p) * ((1.0 - alpha) / (c_.N * (p + c_.stiffness)) + alpha / (c_.gamma * p)));
}

double IsentropicMixture::energy(double p) const {
  // Per volume that the phase has at p_sat.
  const double vapour = (p * vapour_stretch(p) - c_.p_sat) / (c_.gamma - 1.0);
  const double L = liquid_stretch(p), stiff = c_.p_sat + c_.stiffness;
  const double liquid = stiff * std::expm1((1.0 - c_.N) * std::log1p(L)) / (c_.N - 1.0) + c_.stiffness * L;
  return (liquid + k_ * vapour) / mass_;
}

}  // namespace undex::materials
