#include "materials/flow_stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace undex::materials {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_hardening_strain = 1e-6;

double power_of(double strain, double factor, double exponent) {
  return strain > 0.0 ? factor * std::pow(strain, exponent) : 0.0;
}

/// A law at one temperature. Each has
///   least()           what the flow stress never falls below, without a transcendental function [Pa]
///   at_rest(strain)   flow stress at zero rate [Pa]
///   at(strain, rate)  flow stress with its slopes; strain > 0 where a power needs it
///   kink()            rate up to which the rate does not count [1/s]
template <class Law>
struct Isotherm;

template <>
struct Isotherm<PowerHardening> {
  const PowerHardening& law;
  Isotherm(const PowerHardening& of, double) : law(of) {}
  double least() const { return law.A; }
  double at_rest(double strain) const { return law.A + power_of(strain, law.B, law.n); }
  Flow at(double strain, double) const {
    const double power = power_of(strain, law.B, law.n);
    return {law.A + power, law.n * power / strain, 0.0};
  }
  double kink() const { return 0.0; }
};

template <>
struct Isotherm<JohnsonCook> {
  const JohnsonCook& law;
  double thermal;  ///< 1 - T*^m
  Isotherm(const JohnsonCook& of, double temperature) : law(of), thermal(1.0) {
    if (temperature <= law.T_room) return;
    const double homologous = (temperature - law.T_room) / (law.T_melt - law.T_room);
    thermal = temperature >= law.T_melt ? 0.0 : 1.0 - (law.m == 1.0 ? homologous : std::pow(homologous, law.m));
  }
  double least() const { return law.A * thermal; }
  double at_rest(double strain) const { return (law.A + power_of(strain, law.B, law.n)) * thermal; }
  Flow at(double strain, double rate) const {
    const double power = power_of(strain, law.B, law.n);
    double rate_factor = 1.0, rate_slope = 0.0;
    if (rate > law.rate0 && law.C > 0.0) {
      rate_factor += law.C * std::log(rate / law.rate0);
      rate_slope = law.C / rate;
    }
    return {(law.A + power) * rate_factor * thermal, thermal * rate_factor * law.n * power / strain,
            thermal * rate_slope * (law.A + power)};
  }
  double kink() const { return law.rate0; }
};

template <>
struct Isotherm<CowperSymonds> {
  const CowperSymonds& law;
  Isotherm(const CowperSymonds& of, double) : law(of) {}
  double least() const { return law.Y0; }
  double at_rest(double strain) const { return law.Y0 + law.H * strain; }
  Flow at(double strain, double rate) const {
    const double power = rate > 0.0 ? std::pow(rate / law.D, 1.0 / law.q) : 0.0;
    const double still = at_rest(strain);
    return {still * (1.0 + power), law.H * (1.0 + power), rate > 0.0 ? still * power / (law.q * rate) : infinite};
  }
  double kink() const { return 0.0; }
};

template <>
struct Isotherm<ZerilliArmstrong> {
  const ZerilliArmstrong& law;
  double temperature;
  Isotherm(const ZerilliArmstrong& of, double at_temperature) : law(of), temperature(at_temperature) {}
  double least() const { return law.C0; }
  double at_rest(double strain) const { return at(strain, 0.0).stress; }
  Flow at(double strain, double rate) const {
    const double thermal = std::exp(temperature * (law.C4 * std::log(std::max(rate, law.rate0)) - law.C3));
    const double root = law.C2 > 0.0 ? law.C2 * std::sqrt(strain) : 0.0;
    const double power = law.C5 > 0.0 ? power_of(strain, law.C5, law.n) : 0.0;
    const double activated = (law.C1 + root) * thermal;
    return {law.C0 + activated + power, (0.5 * root * thermal + law.n * power) / strain,
            rate > law.rate0 ? activated * law.C4 * temperature / rate : 0.0};
  }
  double kink() const { return law.rate0; }
};

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
