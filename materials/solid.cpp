// Flow stress laws, radial return and pressure of solids (Chen et al. 2019, eqs 14-23).
#include "materials/solid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace undex::materials {

namespace {

constexpr double least_hardening_strain = 1e-6;

/// 1 - T*^m; T* clamped to [0, 1].
double thermal_factor(const JohnsonCook& law, double temperature) {
  if (temperature <= law.T_room) return 1.0;
  if (temperature >= law.T_melt) return 0.0;
  const double homologous = (temperature - law.T_room) / (law.T_melt - law.T_room);
  return 1.0 - (law.m == 1.0 ? homologous : std::pow(homologous, law.m));
}

/// 1 + C ln(rate/rate0); rate clamped at rate0.
double rate_factor(const JohnsonCook& law, double rate) {
  return rate > law.rate0 ? 1.0 + law.C * std::log(rate / law.rate0) : 1.0;
}

double strain_power(const JohnsonCook& law, double plastic_strain) {
  return plastic_strain > 0.0 ? law.B * std::pow(plastic_strain, law.n) : 0.0;
}

}  // namespace

double flow_stress(const LinearHardening& law, double plastic_strain, double, double) {
  return law.Y0 + law.H * plastic_strain;
}

double flow_stress(const JohnsonCook& law, double plastic_strain, double rate, double temperature) {
  return (law.A + strain_power(law, plastic_strain)) * rate_factor(law, rate) *
         thermal_factor(law, temperature);
}

double flow_stress(const FlowStress& law, double plastic_strain, double rate, double temperature) {
  if (const auto* jc = std::get_if<JohnsonCook>(&law))
    return flow_stress(*jc, plastic_strain, rate, temperature);
  if (const auto* linear = std::get_if<LinearHardening>(&law))
    return flow_stress(*linear, plastic_strain, rate, temperature);
  return std::numeric_limits<double>::infinity();
}

double hardening(const FlowStress& law, double plastic_strain, double rate, double temperature) {
  if (const auto* jc = std::get_if<JohnsonCook>(&law)) {
    const double strain = std::max(plastic_strain, least_hardening_strain);
    return jc->n * strain_power(*jc, strain) / strain * rate_factor(*jc, rate) *
           thermal_factor(*jc, temperature);
  }
  if (const auto* linear = std::get_if<LinearHardening>(&law)) return linear->H;
  return 0.0;
}

SolidPressureSound evaluate(const LinearPressure& law, double rho0, double rho, double) {
  return {law.bulk_modulus * (rho / rho0 - 1.0), std::sqrt(law.bulk_modulus / rho0)};
}

SolidPressureSound evaluate(const MieGruneisenPressure& law, double rho0, double rho, double energy) {
  const double eta = rho / rho0 - 1.0, s = law.S - 1.0;
  const double a = rho0 * law.C * law.C;
  double hugoniot = a * eta, slope = a;  // slope d/d eta
  if (eta > 0.0) {
    const double b = a * (1.0 + 2.0 * s), c = a * s * (2.0 + 3.0 * s);
    hugoniot = eta * (a + eta * (b + eta * c));
    slope = a + eta * (2.0 * b + eta * 3.0 * c);
  }
  const double weight = 1.0 - 0.5 * law.Gamma * eta;
  const double pressure = weight * hugoniot + law.Gamma * rho * energy;
  const double sound_squared =
      (weight * slope - 0.5 * law.Gamma * hugoniot) / rho0 + law.Gamma * energy + law.Gamma * pressure / rho;
  return {pressure, std::sqrt(std::max(sound_squared, 0.01 * law.C * law.C))};
}

SolidPressureSound evaluate(const SolidPressure& law, double rho0, double rho, double energy) {
  if (const auto* linear = std::get_if<LinearPressure>(&law)) return evaluate(*linear, rho0, rho, energy);
  return evaluate(*std::get_if<MieGruneisenPressure>(&law), rho0, rho, energy);
}

PlasticStep radial_return(const LinearHardening& law, double shear_modulus, double trial,
                          double plastic_strain) {
  const double start = law.Y0 + law.H * plastic_strain;
  if (trial <= start) return {1.0, 0.0, 0.0};
  const double increment = (trial - start) / (3.0 * shear_modulus + law.H);
  const double stress = start + law.H * increment;
  return {stress / trial, increment, stress * increment};
}

PlasticStep radial_return(const JohnsonCook& law, double shear_modulus, double trial, double plastic_strain,
                          double temperature, double dt) {
  assert(law.C == 0.0 || dt > 0.0);
  constexpr PlasticStep elastic{1.0, 0.0, 0.0};
  const double thermal = thermal_factor(law, temperature);
  if (trial <= law.A * thermal) return elastic;  // spares the strain's power where the stress is low
  const double start = (law.A + strain_power(law, plastic_strain)) * thermal;
  if (trial <= start) return elastic;
  const double stiffness = 3.0 * shear_modulus;
  if (thermal <= 0.0) return {0.0, trial / stiffness, 0.0};

  // The excess r(d) = sigma_Y(d) + 3G d - trial rises with d from start - trial < 0 to r(high) >= 0, so the
  // root is bracketed. Newton's steps start at high: 3G dwarfs the hardening but for the first strain after
  // yield, where the slope of eps^n is infinite and high too far out; a step that leaves the bracket is then
  // replaced.
  double low = 0.0, high = (trial - start) / stiffness;
  const double threshold = law.rate0 * dt;  // increment at which the rate begins to count
  const double round_off = 4.0 * std::numeric_limits<double>::epsilon() * trial;
  double increment = high, stress = start;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double power = strain_power(law, plastic_strain + increment);
    double rate_part = 1.0, rate_slope = 0.0;
    if (increment > threshold && law.C > 0.0) {
      rate_part += law.C * std::log(increment / threshold);
      rate_slope = law.C / increment;
    }
    stress = (law.A + power) * rate_part * thermal;
    const double excess = stress + stiffness * increment - trial;
    if (std::abs(excess) <= round_off) break;
    (excess > 0.0 ? high : low) = increment;
    const double slope = stiffness + thermal * (rate_part * law.n * power / (plastic_strain + increment) +
                                                rate_slope * (law.A + power));
    double next = increment - excess / slope;
    // Newton's error is squared, relative to the increment, as long as the step does not cross the kink of
    // the rate: such a small last step needs no further evaluation.
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

PlasticStep radial_return(const Solid& solid, double trial, double plastic_strain, double temperature,
                          double dt) {
  if (const auto* jc = std::get_if<JohnsonCook>(&solid.flow))
    return radial_return(*jc, solid.shear_modulus, trial, plastic_strain, temperature, dt);
  if (const auto* linear = std::get_if<LinearHardening>(&solid.flow))
    return radial_return(*linear, solid.shear_modulus, trial, plastic_strain);
  return {1.0, 0.0, 0.0};
}

double bulk_modulus(const Solid& solid) {
  if (const auto* linear = std::get_if<LinearPressure>(&solid.pressure)) return linear->bulk_modulus;
  const double C = std::get_if<MieGruneisenPressure>(&solid.pressure)->C;
  return solid.rho0 * C * C;
}

double wave_speed(const Solid& solid) {
  return std::sqrt((bulk_modulus(solid) + 4.0 / 3.0 * solid.shear_modulus) / solid.rho0);
}

}  // namespace undex::materials
