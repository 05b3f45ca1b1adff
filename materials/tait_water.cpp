// Tait water: constants of the branches, compression energy and inverse (Chen et al. 2019, eqs 28-33).
#include "materials/tait_water.hpp"

#include <sstream>
#include <stdexcept>

namespace undex::materials {

namespace {

void require_tait(bool holds, const char* what, double value) {
  if (holds) return;
  std::ostringstream text;
  text << "TaitWater: " << what << ", got " << value;
  throw std::invalid_argument(text.str());
}

}  // namespace

double schmidt_pressure_scale(const SchmidtMixture& mixture, double rho_liquid) {
  const double rho_vapour = mixture.density_ratio * rho_liquid;
  const double K_vapour = rho_vapour * mixture.vapour_sound * mixture.vapour_sound;
  const double K_liquid = rho_liquid * mixture.liquid_sound * mixture.liquid_sound;
  return K_vapour * K_liquid * (rho_liquid - rho_vapour) / (rho_liquid * K_liquid - rho_vapour * K_vapour);
}

TaitWater::TaitWater() : TaitWater(Parameters{}) {}

TaitWater::TaitWater(const Parameters& parameters) : p_(parameters) {
  require_tait(p_.rho0 > 0, "rho0 [kg/m^3] must be positive", p_.rho0);
  require_tait(p_.B > 0, "B [Pa] must be positive", p_.B);
  require_tait(p_.N > 1, "N must exceed 1", p_.N);
  if (p_.cavitation == Cavitation::none) return;
  require_tait(p_.p_floor > p_.A - p_.B, "p_floor [Pa] must exceed A - B", p_.p_floor);

  if (p_.cavitation == Cavitation::cutoff) {
    rho_limit_ = rho_floor_ = liquid_density(p_.p_floor);
    p_lowest_ = p_.p_floor;
    liquid_sound_ = guarded_sound_speed(p_.N * (p_.p_floor - p_.A + p_.B) / rho_limit_);
    energy_limit_ = energy_floor_ = liquid_energy(rho_limit_);
    return;
  }

  const SchmidtMixture& mixture = p_.mixture;
  require_tait(mixture.density_ratio > 0 && mixture.density_ratio < 1, "density_ratio must lie between 0 and 1",
               mixture.density_ratio);
  require_tait(mixture.p_sat > p_.p_floor, "p_sat [Pa] must exceed p_floor", mixture.p_sat);
  if (p_.cavitation == Cavitation::isentropic) {
    require_tait(p_.p_floor > 0, "p_floor [Pa] must be positive with the isentropic mixture", p_.p_floor);
    require_tait(p_.vapour_gamma > 1, "vapour_gamma must exceed 1", p_.vapour_gamma);
    require_tait(p_.initial_void > 0 && p_.initial_void < 1, "initial_void must lie between 0 and 1", p_.initial_void);
    rho_limit_ = liquid_density(mixture.p_sat);
    liquid_sound_ = guarded_sound_speed(p_.N * (mixture.p_sat - p_.A + p_.B) / rho_limit_);
    rho_vapour_ = mixture.density_ratio * rho_limit_;
    isentropic_ = IsentropicMixture({.p_sat = mixture.p_sat,
                                     .liquid_density = rho_limit_,
                                     .N = p_.N,
                                     .stiffness = p_.B - p_.A,
                                     .vapour_density = rho_vapour_,
                                     .gamma = p_.vapour_gamma,
                                     .initial_void = p_.initial_void});
    p_lowest_ = p_.p_floor;
    rho_wet_ = isentropic_.density(mixture.p_sat);
    rho_floor_ = isentropic_.density(p_lowest_);
    energy_limit_ = liquid_energy(rho_limit_);
    energy_wet_ = energy_limit_ + mixture.p_sat * (1.0 / rho_limit_ - 1.0 / rho_wet_);
    energy_floor_ = energy_wet_ + isentropic_.energy(p_lowest_);
    return;
  }
  require_tait(mixture.vapour_sound > 0, "vapour_sound [m/s] must be positive", mixture.vapour_sound);
  require_tait(mixture.liquid_sound > 0, "liquid_sound [m/s] must be positive", mixture.liquid_sound);
  rho_limit_ = liquid_density(mixture.p_sat);
  liquid_sound_ = guarded_sound_speed(p_.N * (mixture.p_sat - p_.A + p_.B) / rho_limit_);
  rho_vapour_ = mixture.density_ratio * rho_limit_;
  K_vapour_ = rho_vapour_ * mixture.vapour_sound * mixture.vapour_sound;
  K_liquid_ = rho_limit_ * mixture.liquid_sound * mixture.liquid_sound;
  require_tait(K_liquid_ > K_vapour_, "the liquid must be stiffer than the vapour, rho a^2 [Pa] of the liquid", K_liquid_);
  p_gl_ = schmidt_pressure_scale(mixture, rho_limit_);
  const double p_vapour = mixture_pressure(rho_vapour_, 1.0);
  p_lowest_ = std::max(p_.p_floor, p_vapour);
  rho_floor_ = p_vapour > p_.p_floor ? rho_vapour_ : density_at(p_.p_floor);
  energy_limit_ = liquid_energy(rho_limit_);
  energy_floor_ = mixture_energy(rho_floor_);
}

PressureSound TaitWater::isentropic_state(double rho) const {
  const double pressure = rho > rho_floor_ ? isentropic_.pressure(std::min(rho, rho_wet_)) : p_lowest_;
  return {pressure, guarded_sound_speed(isentropic_.sound_squared(pressure))};
}

double TaitWater::liquid_density(double pressure) const { return p_.rho0 * std::pow(1.0 + (pressure - p_.A) / p_.B, 1.0 / p_.N); }

double TaitWater::density_at(double pressure, double) const {
  const double lowest = p_.cavitation == Cavitation::none ? p_.A - p_.B : p_lowest_;
  // Without cavitation the lower end is zero density, which is no state.
  if (!(pressure > lowest || (pressure == lowest && p_.cavitation != Cavitation::none))) {
    std::ostringstream text;
    text << "Tait water has no density at " << pressure << " Pa: its pressures begin at " << lowest << " Pa";
    throw std::domain_error(text.str());
  }
  if (p_.cavitation == Cavitation::isentropic && pressure < p_.mixture.p_sat) return isentropic_.density(pressure);
  if (p_.cavitation != Cavitation::schmidt || pressure >= p_.mixture.p_sat) {
    if (pressure == p_lowest_ && p_.cavitation == Cavitation::cutoff) return rho_limit_;
    return liquid_density(pressure);
  }
  // Eq. 32 solved for the void fraction.
  const double ratio = std::exp((pressure - p_.mixture.p_sat) / p_gl_);
  const double alpha = rho_limit_ * K_vapour_ * (1.0 - ratio) /
                       (K_vapour_ * (rho_limit_ - rho_vapour_) + ratio * rho_limit_ * (K_liquid_ - K_vapour_));
  return rho_limit_ - alpha * (rho_limit_ - rho_vapour_);
}

double TaitWater::liquid_energy(double rho) const {
  const double strain = rho / p_.rho0;
  return p_.B / (p_.rho0 * (p_.N - 1.0)) * (std::pow(strain, p_.N - 1.0) - 1.0) + (p_.A - p_.B) * (1.0 / p_.rho0 - 1.0 / rho);
}

double TaitWater::mixture_energy(double rho) const {
  // With alpha linear in rho the modulus in eq. 32 is a + b rho, so the integral of ln(k rho/(a + b
  // rho))/rho^2 is
  // -(f + 1)/rho - (b/a) f, where f is the logarithm; f = 0 at the liquid's limit.
  const double b = -(K_liquid_ - K_vapour_) / (rho_limit_ - rho_vapour_);
  const double a = K_vapour_ - b * rho_limit_;
  const double f = std::log(K_vapour_ * rho / (rho_limit_ * (a + b * rho)));
  const double volume_change = 1.0 / rho_limit_ - 1.0 / rho;
  return energy_limit_ + p_.mixture.p_sat * volume_change + p_gl_ * (volume_change - f / rho - b / a * f);
}

double TaitWater::barotropic_energy(double rho) const {
  if (rho >= rho_limit_) return liquid_energy(rho);
  if (p_.cavitation == Cavitation::isentropic && rho > rho_floor_)
    return rho < rho_wet_ ? energy_wet_ + isentropic_.energy(isentropic_.pressure(rho))
                          : energy_limit_ + p_.mixture.p_sat * (1.0 / rho_limit_ - 1.0 / rho);
  if (rho > rho_floor_) return mixture_energy(rho);
  return energy_floor_ + p_lowest_ * (1.0 / rho_floor_ - 1.0 / rho);
}

}  // namespace undex::materials
