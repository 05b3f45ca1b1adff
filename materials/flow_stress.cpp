#include "materials/flow_stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace undex::materials {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_hardening_strain = 1e-6;

/// The return by a bracketed Newton iteration on the increment d of plastic strain.
template <class Law>
PlasticStep newton_return(const Isotherm<Law>& law, double shear_modulus, double trial, double plastic_strain, double dt) {
  constexpr PlasticStep elastic{1.0, 0.0, 0.0};
  if (trial <= law.least()) return elastic;  // spares the strain's power where the stress is low
  const double start = law.at_rest(plastic_strain);
  if (trial <= start) return elastic;

  // The excess r(d) = sigma_Y(d) + 3G d - trial rises with d from start - trial < 0 to r(high) >= 0, so the root is
  // bracketed. Newton's steps start at high: 3G dwarfs the hardening but for the first strain after yield, where the
  // slope of eps^n (or of rate^(1/q)) is infinite and high too far out; a step that leaves the bracket is then replaced.
  const double stiffness = 3.0 * shear_modulus, per_step = dt > 0.0 ? 1.0 / dt : 0.0;
  const double threshold = law.kink() * dt;  // increment at which the rate begins to count
  const double round_off = 4.0 * std::numeric_limits<double>::epsilon() * trial;
  double low = 0.0, high = (trial - start) / stiffness;
  double increment = high, stress = start;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Flow now = law.at(plastic_strain + increment, increment * per_step);
    stress = now.stress;
    const double excess = stress + stiffness * increment - trial;
    if (std::abs(excess) <= round_off) break;
    (excess > 0.0 ? high : low) = increment;
    double next = increment - excess / (stiffness + now.hardening + now.rate_slope * per_step);
    // Newton's error is squared, relative to the increment, as long as the step does not cross the kink of the rate: such
    // a small last step needs no further evaluation.
    if (std::abs(next - increment) <= 1e-8 * increment && (next > threshold) == (increment > threshold)) {
      increment = next;
      stress = trial - stiffness * increment;
      break;
    }
    if (!(next > low && next < high)) next = low > 0.0 ? std::sqrt(low * high) : 1e-2 * high;
    if (!(next > low && next < high)) break;  // neighbouring numbers: as good as it gets
    increment = next;
  }
  stress = std::min(stress, trial);
  return {stress / trial, increment, stress * increment};
}

PlasticStep return_with(const Elastic&, double, double, double, double, double) { return {1.0, 0.0, 0.0}; }

PlasticStep return_with(const LinearHardening& law, double shear_modulus, double trial, double plastic_strain, double, double) {
  const double start = law.Y0 + law.H * plastic_strain;
  if (trial <= start) return {1.0, 0.0, 0.0};
  const double increment = (trial - start) / (3.0 * shear_modulus + law.H);
  const double stress = start + law.H * increment;
  return {stress / trial, increment, stress * increment};
}

template <class Law>
PlasticStep return_with(const Law& law, double shear_modulus, double trial, double plastic_strain, double temperature,
                        double dt) {
  return newton_return(Isotherm<Law>(law, temperature), shear_modulus, trial, plastic_strain, dt);
}

Flow flow_of(const Elastic&, double, double, double) { return {infinite, 0.0, 0.0}; }

Flow flow_of(const LinearHardening& law, double strain, double, double) { return {law.Y0 + law.H * strain, law.H, 0.0}; }

template <class Law>
Flow flow_of(const Law& law, double strain, double rate, double temperature) {
  const Isotherm<Law> isotherm(law, temperature);
  Flow now = isotherm.at(strain, rate);
  if (strain < least_hardening_strain) now.hardening = isotherm.at(least_hardening_strain, rate).hardening;
  return now;
}

}  // namespace

Flow flow(const FlowStress& law, double plastic_strain, double rate, double temperature) {
  return std::visit([&](const auto& each) { return flow_of(each, plastic_strain, rate, temperature); }, law);
}

double flow_stress(const FlowStress& law, double plastic_strain, double rate, double temperature) {
  return flow(law, plastic_strain, rate, temperature).stress;
}

double hardening(const FlowStress& law, double plastic_strain, double rate, double temperature) {
  return flow(law, plastic_strain, rate, temperature).hardening;
}

PlasticStep radial_return(const FlowStress& law, double shear_modulus, double trial, double plastic_strain, double temperature,
                          double dt) {
  return std::visit([&](const auto& each) { return return_with(each, shear_modulus, trial, plastic_strain, temperature, dt); },
                    law);
}

}  // namespace undex::materials
