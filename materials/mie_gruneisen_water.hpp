// Water after Mie and Grueneisen with a cubic fit of the shock speed: eq. 27 of Chen, Peng, Lien, Zhao 2019,
// doi 10.1007/s40571-019-00230-7. SI units; the energy argument is per mass.
#pragma once

#include <cmath>
#include <limits>

#include "materials/pressure_sound.hpp"

namespace undex::materials {

/// With mu = rho/rho0 - 1 and G(mu) = gamma0 + alpha mu,
///   p = rho0 C0^2 mu [1 + (1 - gamma0/2) mu - alpha mu^2/2] / F^2 + G E   for mu > 0,
///   F = 1 - (S1 - 1) mu - S2 mu^2/(mu + 1) - S3 mu^3/(mu + 1)^2,
///   p = rho0 C0^2 mu + G E                                                otherwise,
/// cut off at p_floor. E is the energy per INITIAL volume, E = rho0 e. That is no matter of taste: the
/// bracket equals (1 + mu) - G mu/2, so that on the Hugoniot, where rho0 e = p_H mu/(2 (1 + mu)), the formula
/// returns p_H = rho0 C0^2 mu (1 + mu)/F^2 exactly; with rho e it would not.
///
/// Domain. F stays above 0.32 for Steinberg's coefficients, but vanishes near mu = 0.44 for those which the
/// paper prints. Above the compression `limit()` at which F has fallen to 0.1 the reference curve (the part
/// without E) is continued along its tangent: pressure and sound speed stay finite, continuous and rising.
///
/// With Steinberg's coefficients the pressure at E = 0 bends over at mu = 0.86 (7.5 GPa), and that on the
/// isentrope from rest near mu = 1 (12.7 GPa); the Hugoniot rises beyond. Cold water squeezed further is
/// outside the fit: its sound speed is guarded at a tenth of C0, its pressure is left as the formula gives
/// it.
///
/// Cut-off. Where the formula falls below p_floor the pressure is p_floor, and the sound speed that of the
/// liquid at the density where it reaches p_floor at the same energy.
class MieGruneisenWater {
 public:
  /// Defaults: Steinberg's coefficients.
  struct Parameters {
    double rho0 = 1000.0;                        ///< [kg/m^3]
    double C0 = 1480.0;                          ///< [m/s]
    double S1 = 2.56, S2 = -1.986, S3 = 0.2268;  ///< [-]
    double gamma0 = 0.5, alpha = 2.67;           ///< [-]
    Cavitation cavitation = Cavitation::cutoff;  ///< none or cutoff
    double p_floor = 1e-5;                       ///< [Pa]
  };
  static constexpr const char* name = "mie_gruneisen";
  static constexpr const char* summary = "water with energy: Mie and Grüneisen with a cubic fit of the shock speed";
  static constexpr bool uses_energy = true, is_gas = false;
  /// Throws std::invalid_argument unless rho0, C0 > 0 and the cavitation model is none or cutoff.
  explicit MieGruneisenWater(const Parameters& parameters);
  const Parameters& parameters() const { return p_; }
  PressureSound evaluate(double rho, double energy) const;
  /// Volume fraction of vapour (without mass) in [0, 1]; 0 at and above the density at which the liquid of
  /// that energy [J/kg] reaches p_floor, always 0 without cavitation.
  double void_fraction(double rho, double energy = 0.0) const;
  /// Least pressure [Pa]: that of the cut-off; without one there is none, and the answer is -1e30.
  double least_pressure() const { return p_.cavitation == Cavitation::none ? -1e30 : p_.p_floor; }
  /// Density [kg/m^3] at `pressure` [Pa] and `energy` [J/kg], the least one where there are several; at
  /// p_floor the cut-off density. Searched up to twice rho0; throws std::domain_error where there is none.
  double density_at(double pressure, double energy) const;
  /// Density at which the liquid of `energy` [J/kg] reaches p_floor, on the expanded branch [kg/m^3].
  double cutoff_density(double energy) const;
  /// Compression mu above which the reference curve is its tangent; infinite where F never falls to 0.1.
  double limit() const { return mu_limit_; }

 private:
  struct Curve {
    double value, slope;  // [Pa], d/d mu [Pa]
  };
  double denominator(double mu) const;
  Curve compressed(double mu) const;

  Parameters p_;
  double stiffness_;  // rho0 C0^2 [Pa]
  double mu_limit_ = std::numeric_limits<double>::infinity();
  Curve at_limit_{0.0, 0.0};
};

template <class Visit>
void describe(MieGruneisenWater::Parameters& p, Visit&& visit) {
  visit(p.rho0, {.name = "rho0", .unit = "kg/m^3", .range = Range::positive(), .meaning = "reference density"});
  visit(p.C0, {.name = "C0", .unit = "m/s", .range = Range::positive(), .meaning = "sound speed"});
  visit(p.S1, {.name = "S1", .meaning = "shock speed over particle speed: its slope"});
  visit(p.S2, {.name = "S2", .meaning = "and the quadratic term"});
  visit(p.S3, {.name = "S3", .meaning = "and the cubic one"});
  visit(p.gamma0, {.name = "gamma0", .meaning = "Grüneisen parameter"});
  visit(p.alpha, {.name = "alpha", .meaning = "its first-order correction"});
  visit(p.cavitation,
        {.name = "cavitation", .values = "\"cutoff\", \"none\"", .meaning = "pressure held at `p_floor`, or tension"});
  visit(p.p_floor, {.name = "p_floor", .unit = "Pa", .used = p.cavitation != Cavitation::none, .meaning = "least pressure"});
}

inline double MieGruneisenWater::denominator(double mu) const {
  const double q = mu / (1.0 + mu);
  return 1.0 - mu * ((p_.S1 - 1.0) + q * (p_.S2 + q * p_.S3));
}

inline MieGruneisenWater::Curve MieGruneisenWater::compressed(double mu) const {
  const double q = mu / (1.0 + mu);
  const double F = denominator(mu);
  const double F_slope = -((p_.S1 - 1.0) + q * (p_.S2 * (2.0 - q) + q * p_.S3 * (3.0 - 2.0 * q)));
  const double N = 1.0 + mu * (1.0 - 0.5 * p_.gamma0 - 0.5 * p_.alpha * mu);
  const double N_slope = 1.0 - 0.5 * p_.gamma0 - p_.alpha * mu;
  const double scale = stiffness_ / (F * F);
  return {scale * mu * N, scale * (N + mu * N_slope - 2.0 * mu * N * F_slope / F)};
}

inline double MieGruneisenWater::cutoff_density(double energy) const {
  const double E = p_.rho0 * energy;
  return p_.rho0 * (1.0 + (p_.p_floor - p_.gamma0 * E) / (stiffness_ + p_.alpha * E));
}

inline PressureSound MieGruneisenWater::evaluate(double rho, double energy) const {
  const double mu = rho / p_.rho0 - 1.0;
  Curve reference{stiffness_ * mu, stiffness_};
  if (mu > mu_limit_) reference = {at_limit_.value + at_limit_.slope * (mu - mu_limit_), at_limit_.slope};
  else if (mu > 0.0) reference = compressed(mu);
  double gruneisen = p_.gamma0 + p_.alpha * mu;
  double pressure = reference.value + gruneisen * p_.rho0 * energy;
  if (pressure < p_.p_floor && p_.cavitation == Cavitation::cutoff) {
    pressure = p_.p_floor;
    rho = cutoff_density(energy);
    gruneisen = p_.gamma0 + p_.alpha * (rho / p_.rho0 - 1.0);
    reference.slope = stiffness_;
  }
  const double sound_squared = reference.slope / p_.rho0 + p_.alpha * energy + gruneisen * p_.rho0 * pressure / (rho * rho);
  return {pressure, std::sqrt(std::max(sound_squared, 0.01 * p_.C0 * p_.C0))};
}

inline double MieGruneisenWater::void_fraction(double rho, double energy) const {
  if (p_.cavitation == Cavitation::none) return 0.0;
  return std::clamp(1.0 - rho / cutoff_density(energy), 0.0, 1.0);
}

}  // namespace undex::materials
