// Water after Tait with its cavitation models: plain cut-off, the modified Schmidt mixture, the isentropic mixture.
// Chen, Peng, Lien, Zhao 2019, doi 10.1007/s40571-019-00230-7, eqs 28-33. SI units.
#pragma once

#include <cmath>

#include "materials/isentropic_mixture.hpp"
#include "materials/pressure_sound.hpp"

namespace undex::materials {

/// Two-phase constants of the modified Schmidt model. The density of the liquid phase is not among them: it
/// is the density at which the liquid law reaches p_sat, so that the mixture starts where the liquid ends.
struct SchmidtMixture {
  double density_ratio = 1e-5;   ///< rho_vapour / rho_liquid
  double vapour_sound = 208.0;   ///< [m/s]
  double liquid_sound = 1538.0;  ///< [m/s]
  double p_sat = 3165.0;         ///< [Pa]
};

/// The pressure scale p_gl [Pa] of eq. 33 for a liquid phase of density rho_liquid [kg/m^3].
double schmidt_pressure_scale(const SchmidtMixture& mixture, double rho_liquid);

/// Water after Tait: p = B ((rho/rho0)^N - 1) + A (eq. 28), with cavitation below p_sat (schmidt) or p_floor
/// (cutoff). Barotropic: the specific energy argument is ignored. Densities must be positive; the law does
/// not check them.
///
/// Below saturation the Schmidt model gives, with falling density,
///   mixture   eq. 32 with void fraction 0 at the Tait density of p_sat: pressure is continuous there, and its slope is
///             the squared mixture sound speed of eq. 31 everywhere;
///   floor     p_floor, from the density at which the mixture reaches it. (Where the constants are such that pure vapour is
///             still above p_floor, the pressure stays at that of pure vapour instead.)
/// Sound speed is continuous too, but for the step from Tait's own value at p_sat (1538.2 m/s) to
/// `liquid_sound` (1538). On the floor the slope of the pressure is zero; the sound speed returned there is
/// still the mixture's, eq. 31 at the void fraction (1.3 m/s at one half, `vapour_sound` in pure vapour),
/// because time step, viscosity and impedance need a positive one. With the cut-off, the sound speed below it
/// is that of the liquid at the cut-off density: the bubbly medium is not modelled, and the time step does
/// not change when particles cross the cut-off back and forth.
///
/// The isentropic mixture begins with a void fraction, so at a density a little below the liquid's: between the two the
/// pressure stays at p_sat while the first vapour appears. p_sat and density_ratio are those of SchmidtMixture; its sound
/// speeds follow and are not asked for. p > 0 at every density, p_floor acts in near vacuum only.
class TaitWater {
 public:
  struct Parameters {
    double rho0 = 1000.0;  ///< [kg/m^3]
    double B = 3.31e8;     ///< [Pa]
    double N = 7.15;       ///< [-]
    double A = 1e5;        ///< pressure at rho0 [Pa]
    Cavitation cavitation = Cavitation::schmidt;
    SchmidtMixture mixture;
    double p_floor = 1e-5;       ///< [Pa], eq. 32's p_eps
    double vapour_gamma = 1.33;  ///< [-], of the isentropic mixture, as the next
    double initial_void = 1e-5;  ///< void fraction where the liquid begins to cavitate
  };
  static constexpr const char* name = "tait";
  static constexpr const char* summary = "p = B ((rho/rho0)^N - 1) + A, with cavitation; barotropic";
  static constexpr bool uses_energy = false, is_gas = false;

  TaitWater();  ///< the default parameters
  /// Throws std::invalid_argument where a parameter leaves its range (rho0, B > 0, N > 1, 0 < density_ratio <
  /// 1, p_floor < p_sat, both attainable by the liquid law; vapour_gamma > 1, 0 < initial_void < 1).
  explicit TaitWater(const Parameters& parameters);
  const Parameters& parameters() const { return p_; }

  /// Pressure and sound speed at rho [kg/m^3]; one pow in the liquid, one log in the mixture.
  PressureSound evaluate(double rho, double /*energy*/) const;
  /// Compression energy e [J/kg] with de/drho = p/rho^2 on every branch, continuous, zero at rho0.
  double barotropic_energy(double rho) const;
  /// Volume fraction of vapour in [0, 1]: 0 at and above the density at which the liquid reaches p_sat (or
  /// p_floor with the cut-off, where vapour has no mass), always 0 without cavitation.
  double void_fraction(double rho, double /*energy*/ = 0.0) const;
  /// Least pressure [Pa]: where it cavitates, else A - B, at which there is nothing left to pull at.
  double least_pressure() const { return p_.cavitation == Cavitation::none ? p_.A - p_.B : p_lowest_; }
  /// Density [kg/m^3] at `pressure` [Pa]; at the pressure of the floor, the largest one. Throws
  /// std::domain_error where the law does not reach the pressure.
  double density_at(double pressure, double /*energy*/ = 0.0) const;

  /// Density at which the liquid law gives way to the cavitation model [kg/m^3]; 0 without one.
  double liquid_limit() const { return rho_limit_; }
  /// Density at and below which the pressure stays at its floor [kg/m^3]; 0 without cavitation.
  double floor_density() const { return rho_floor_; }
  /// Sound speed [m/s] of the liquid where it gives way to the cavitation model; 0 without one.
  double liquid_sound() const { return liquid_sound_; }
  /// p_gl of eq. 33 [Pa]; 0 unless the cavitation model is Schmidt's.
  double pressure_scale() const { return p_gl_; }

 private:
  double liquid_density(double pressure) const;
  double liquid_energy(double rho) const;
  /// K_vapour - alpha (K_vapour - K_liquid), K = rho a^2 [Pa].
  double weighted_modulus(double alpha) const { return K_vapour_ + alpha * (K_liquid_ - K_vapour_); }
  double mixture_pressure(double rho, double alpha) const {
    return p_.mixture.p_sat + p_gl_ * std::log(K_vapour_ * rho / (rho_limit_ * weighted_modulus(alpha)));
  }
  double mixture_sound_squared(double rho, double alpha) const { return K_vapour_ * K_liquid_ / (rho * weighted_modulus(alpha)); }
  double mixture_energy(double rho) const;
  PressureSound isentropic_state(double rho) const;

  Parameters p_;
  double rho_limit_ = 0.0, rho_floor_ = 0.0;    // ends of the liquid and of the mixture
  double p_lowest_ = 0.0, liquid_sound_ = 0.0;  // pressure on the floor; liquid's sound speed at its limit
  double rho_vapour_ = 0.0, K_vapour_ = 0.0, K_liquid_ = 0.0, p_gl_ = 0.0;
  double energy_limit_ = 0.0, energy_floor_ = 0.0;  // compression energies at the two ends
  IsentropicMixture isentropic_;
  double rho_wet_ = 0.0, energy_wet_ = 0.0;  // where the isentropic mixture begins
};

template <class Visit>
void describe(TaitWater::Parameters& p, Visit&& visit) {
  visit(p.rho0, {.name = "rho0", .unit = "kg/m^3", .range = Range::positive(), .meaning = "reference density"});
  visit(p.B, {.name = "B", .unit = "Pa", .range = Range::positive(), .meaning = "stiffness"});
  visit(p.N, {.name = "N", .range = Range::above(1, 100), .meaning = "its exponent"});
  visit(p.A, {.name = "A", .unit = "Pa", .meaning = "pressure at `rho0`"});
  visit(p.cavitation,
        {.name = "cavitation", .meaning = "a mixture below `p_sat` (two models), a least pressure `p_floor`, or tension"});
  const bool schmidt = p.cavitation == Cavitation::schmidt, isentropic = p.cavitation == Cavitation::isentropic;
  visit(p.mixture.density_ratio,
        {.name = "density_ratio", .range = Range::above(0, 1), .used = schmidt || isentropic, .meaning = "vapour over liquid"});
  visit(p.mixture.vapour_sound, {.name = "vapour_sound",
                                 .unit = "m/s",
                                 .range = Range::positive(),
                                 .used = schmidt,
                                 .meaning = "\"schmidt\": sound speed of vapour"});
  visit(p.mixture.liquid_sound, {.name = "liquid_sound",
                                 .unit = "m/s",
                                 .range = Range::positive(),
                                 .used = schmidt,
                                 .meaning = "\"schmidt\": and of the liquid, in the mixture's law"});
  visit(p.mixture.p_sat, {.name = "p_sat",
                          .unit = "Pa",
                          .range = Range::positive(),
                          .used = schmidt || isentropic,
                          .meaning = "saturation pressure"});
  visit(p.p_floor, {.name = "p_floor",
                    .unit = "Pa",
                    .used = p.cavitation != Cavitation::none,
                    .meaning = "least pressure; above 0 with \"isentropic\""});
  visit(p.vapour_gamma, {.name = "vapour_gamma",
                         .range = Range::above(1, 100),
                         .used = isentropic,
                         .meaning = "\"isentropic\": exponent of the vapour's isentrope"});
  visit(p.initial_void, {.name = "initial_void",
                         .range = Range::above(0, 1),
                         .used = isentropic,
                         .meaning = "\"isentropic\": void fraction where cavitation begins"});
}

inline PressureSound TaitWater::evaluate(double rho, double) const {
  if (rho < rho_limit_) {
    if (p_.cavitation == Cavitation::cutoff) return {p_lowest_, liquid_sound_};
    if (p_.cavitation == Cavitation::isentropic) return isentropic_state(rho);
    const double alpha = void_fraction(rho);
    const double rho_mixture = std::max(rho, rho_vapour_);  // thinner than pure vapour: its state is kept
    const double pressure = rho > rho_floor_ ? mixture_pressure(rho, alpha) : p_lowest_;
    return {pressure, guarded_sound_speed(mixture_sound_squared(rho_mixture, alpha))};
  }
  const double power = p_.B * std::pow(rho / p_.rho0, p_.N);
  return {power - p_.B + p_.A, guarded_sound_speed(p_.N * power / rho)};
}

inline double TaitWater::void_fraction(double rho, double) const {
  if (rho >= rho_limit_) return 0.0;
  if (p_.cavitation == Cavitation::isentropic && rho < rho_wet_)
    return isentropic_.void_fraction(rho > rho_floor_ ? isentropic_.pressure(rho) : p_lowest_);
  return std::min((rho_limit_ - rho) / (rho_limit_ - rho_vapour_), 1.0);
}

}  // namespace undex::materials
