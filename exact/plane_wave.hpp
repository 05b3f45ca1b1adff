// A plane simple wave of finite amplitude with an exponential profile, running into a fluid at rest: the incident
// wave of an explosion far away. SI units.
//
// In a simple wave all states lie on the isentrope of the fluid at rest, and the velocity follows from the pressure
// alone (Riemann's invariant; R. Courant, K. O. Friedrichs, Supersonic Flow and Shock Waves, chapter III):
//   du = dp/(rho c),   d rho = dp/c^2,   de = p dp/(rho c)^2.
// At the start the pressure falls off behind the front at x = 0 as
//   p = p_rest + peak exp(-s/(c_rest decay)),   s = distance behind the front,
// which for small peaks is the wave peak exp(-t/decay) at a fixed place. The front is a jump on the isentrope; a shock
// of the same pressure differs from it by terms of third order in the peak.
#pragma once

#include <vector>

#include "exact/ode.hpp"
#include "materials/equation_of_state.hpp"

namespace undex::exact {

struct PlaneWaveState {
  double density;   ///< [kg/m^3]
  double velocity;  ///< along the wave's way [m/s]
  double energy;    ///< specific [J/kg]; the given one with barotropic laws
  double pressure;  ///< [Pa]
};

class PlaneWave {
 public:
  /// Fluid at rest with `density` [kg/m^3] and specific `energy` [J/kg]; `peak` [Pa] above its pressure, `decay` [s].
  /// Throws std::invalid_argument unless density, peak and decay are positive and the fluid at rest has no voids.
  PlaneWave(const materials::FluidLaw& law, double density, double energy, double peak, double decay);

  double rest_sound() const { return sound_; }                 ///< [m/s]
  double impedance() const { return rest_.density * sound_; }  ///< of the fluid at rest [kg/(m^2 s)]
  double length() const { return length_; }                    ///< over which the wave falls by e [m]
  const PlaneWaveState& rest() const { return rest_; }
  /// State just behind the front.
  PlaneWaveState front() const { return at(0.0); }
  /// State at a distance behind the front [m]; ahead of it (negative) the fluid at rest.
  PlaneWaveState at(double behind) const;
  /// The state that gives a cell which reaches from `from` to `to` [m] behind the front (from < to) its mass, momentum and
  /// energy.
  PlaneWaveState mean(double from, double to) const;

 private:
  OdeState<3> slope(double p, const OdeState<3>& y) const;

  materials::FluidLaw law_;
  PlaneWaveState rest_;
  double peak_, sound_, length_;
  bool with_energy_;
  std::vector<OdePoint<3>> points_;  // over pressure, rising: density, velocity, energy
};

}  // namespace undex::exact
