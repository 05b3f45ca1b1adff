// Burn of an explosive charge, and the Chapman-Jouguet state of its products.
// Programmed burn: the detonation front is prescribed, a sphere that grows from the initiation point at the
// detonation speed (a common hydrocode technique; Chen et al. 2019, doi 10.1007/s40571-019-00230-7,
// section 3.3 is its test). SI units.
#pragma once

#include <algorithm>

#include "core/record.hpp"
#include "core/vector.hpp"
#include "materials/jwl.hpp"

namespace undex::materials {

/// Share of a zone's explosive that has burned. From the lighting time on it rises linearly, while the front
/// crosses `width`. A zone that is squeezed before the front arrives burns by its compression: otherwise it
/// would sit at zero pressure in front of the products, offer no resistance, and fine spacings would pile
/// zones up ahead of the front to many times the detonation pressure.
struct ProgrammedBurn {
  Vec3 origin = Vec3::Zero();   ///< initiation point [m]
  double D = 0.0;               ///< detonation speed [m/s], > 0 unless instantaneous
  double width = 0.0;           ///< distance over which the burn fraction rises [m]; 0: at once. Some spacings
  double cj_compression = 0.0;  ///< rho_CJ/rho0 [-]: burn by compression is complete there; <= 1 switches it off
  bool instantaneous = false;   ///< everything has burned from the start (constant-volume burn), wherever it is

  /// Time [s] at which the front reaches x [m]; 0 when instantaneous.
  double lighting_time(const Vec3& x) const { return instantaneous ? 0.0 : (x - origin).norm() / D; }

  /// Burn fraction in [0, 1] at position x [m] and time t [s] since initiation, of a zone of `compression`
  /// rho/rho0
  /// [-] (not rho0/rho, and not a strain). x is the zone's INITIAL position for a front that does not see the
  /// motion of the charge. The timed part never falls with time; the part by compression does when the zone
  /// expands, so a caller who wants irreversible burn keeps the largest value met.
  double fraction(const Vec3& x, double t, double compression) const;
};

template <class Visit>
void describe(ProgrammedBurn& burn, Visit&& visit) {
  visit(ByHand{}, {.name = "model",
                   .rule = "\"programmed\"",
                   .values = "\"programmed\", \"instantaneous\"",
                   .meaning = "a front that runs at given speed, or products at full energy from the start"});
  visit(burn.origin, {.name = "initiation",
                      .unit = "m",
                      .range = Range::position(),
                      .rule = "middle of the shape",
                      .meaning = "where the front starts"});
  visit(burn.D,
        {.name = "speed", .unit = "m/s", .range = Range::positive(), .rule = "`D` of the material", .meaning = "of the front"});
  visit(burn.width, {.name = "width",
                     .unit = "m",
                     .range = Range::between(0, Range::farthest),
                     .rule = "1.5 to 6 spacings, at most 1/12 of the way that the front runs",
                     .meaning = "over which the burn rises, the front in its middle; 0: at once"});
  visit(burn.cj_compression, {.name = "cj_compression",
                              .range = Range::between(0, 5),
                              .rule = "from the material",
                              .meaning = "density over `rho0` at which explosive burns before the front; 0 or 1: off"});
}

/// Burn of the explosive `products` from `origin` [m] with a front `width` [m] wide, at the published
/// detonation speed of the set; burn by compression is on, and complete at the Chapman-Jouguet density of the
/// set.
ProgrammedBurn programmed_burn(const Jwl& products, const Vec3& origin, double width);

/// Pressure and sound speed of a zone of which `fraction` has burned: pressure is fraction times that of the
/// products. The sound speed is that of the products at the zone's own density and energy, NOT scaled with
/// the fraction, and at least D/2. An unburned zone already carries its detonation energy, so the value does
/// not jump when the zone is lit, and time step and viscosity are those of the front before it arrives;
/// scaled with the fraction it would vanish in the unburned charge. (PETN at rest: 4798 m/s; 6020 m/s behind
/// the front.)
inline PressureSound burning(const Jwl& products, double rho, double energy, double fraction) {
  const PressureSound burned = products.evaluate(rho, energy);
  return {fraction * burned.pressure, std::max(burned.sound_speed, 0.5 * products.parameters().D)};
}

/// State behind a steady detonation front that runs at sound speed relative to the products.
struct ChapmanJouguet {
  double detonation_speed;  ///< [m/s]
  double pressure;          ///< [Pa]
  double density;           ///< [kg/m^3]
  double particle_speed;    ///< [m/s]
  double sound_speed;       ///< [m/s]
  double energy;            ///< [J/kg]
};
/// From the Hugoniot of the products, started at rest, zero pressure, rho0 and E0: the state whose Rayleigh
/// line touches it, rho c = rho0 D. The published D and p_cj of the set are not used, so they can be checked.
/// Throws std::domain_error where the Hugoniot has no such state below 5 rho0.
ChapmanJouguet chapman_jouguet(const Jwl& products);

}  // namespace undex::materials
