// Isentropic expansion of any fluid law, and states behind its shocks, from the law alone. SI units.
#pragma once

#include <vector>

#include "exact/ode.hpp"
#include "materials/equation_of_state.hpp"

namespace undex::exact {

/// A state on an isentrope.
struct IsentropeState {
  double density;   ///< [kg/m^3]
  double pressure;  ///< [Pa]
  double sound;     ///< [m/s]
  double energy;    ///< [J/kg]
  /// Speed gained in a simple wave [m/s]: integral of c/rho over rho from the start, negative in expansion.
  double riemann;
};

/// Expansion from (density, energy), integrated in ln rho by
///   de = p/rho dln(rho),  dw = c dln(rho).
/// It ends where the law's cavitation floor begins (from there on the true sound speed is zero and nothing
/// more is gained), where a gas has expanded until its sound speed is 1e-7 of the first, or where a law that carries tension has
/// no more of it to give: its sound speed is no longer real. Throws std::domain_error where the law gives no pressure or sound speed
/// at the start.
class Isentrope {
 public:
  Isentrope(const materials::FluidLaw& law, double density, double energy);
  IsentropeState start() const { return state(points_.front()); }
  IsentropeState end() const { return state(points_.back()); }
  /// Does it end on a cavitation floor (and not in a vacuum)?
  bool ends_on_floor() const { return on_floor_; }
  /// Does it end where the law does, before a void could open: at the most tension that it can carry?
  bool ends_before_a_void() const { return torn_; }
  /// Is it convex from the start to a density [kg/m^3]? Then u + c falls all along the fan, and the fan is the solution.
  bool is_convex_down_to(double density) const;
  /// The speed gained in the expansion to the very end [m/s], <= 0: for a gas the part beyond end() is that
  /// of the power law p ~ rho^G which the end follows, -2 c/(G - 1).
  double riemann_limit() const;
  /// State at a density [kg/m^3] between end and start (clamped to them).
  IsentropeState at_density(double density) const;
  /// State at a pressure [Pa] between those of end and start (clamped to them).
  IsentropeState at_pressure(double pressure) const;
  /// State at which a quantity that falls all along the expansion, `falling(state)`, takes a value (clamped).
  template <class Falling>
  IsentropeState find(const Falling& falling, double value) const;

 private:
  using Point = OdePoint<2>;  // s = ln(rho/rho_start), y = (w, e)
  OdeState<2> slope(double s, const OdeState<2>& y) const;
  IsentropeState state(const Point& point) const;
  IsentropeState state_after(const Point& from, double s) const;

  materials::FluidLaw law_;
  double density_, energy_;
  bool on_floor_ = false, torn_ = false;
  std::vector<Point> points_;
};

template <class Falling>
IsentropeState Isentrope::find(const Falling& falling, double value) const {
  if (falling(start()) <= value) return start();
  if (falling(end()) >= value) return end();
  std::size_t above = 0, below = points_.size() - 1;
  while (below - above > 1) {
    const std::size_t middle = (above + below) / 2;
    (falling(state(points_[middle])) > value ? above : below) = middle;
  }
  double high = points_[above].s, low = points_[below].s;
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (falling(state_after(points_[above], middle)) > value ? high : low) = middle;
  return state_after(points_[above], low);
}

/// The state which a shock of pressure `pressure` [Pa] (above that of the start) makes of (density, energy).
struct ShockState {
  double density, energy;  ///< [kg/m^3], [J/kg]
  double mass_flux;        ///< through the front [kg/(m^2 s)]
};
/// Mass and momentum: j^2 = (p - p0)/(1/rho0 - 1/rho); energy: e - e0 = (p + p0)/2 (1/rho0 - 1/rho), which
/// fixes rho with the law. For barotropic laws there is no energy condition: mass and momentum alone hold,
/// rho is that of the law at `pressure`, and the energy returned is the compression energy (the rest is taken
/// away as heat). Throws std::domain_error when the law reaches the pressure at no density below 1e3 times
/// the first.
ShockState shock_to(const materials::FluidLaw& law, double density, double energy, double pressure);

/// Pressure [Pa] and the sound speed [m/s] without the guard that keeps it above 1 mm/s, for gases in the
/// last of a vacuum.
materials::PressureSound true_pressure_sound(const materials::FluidLaw& law, double density, double energy);

}  // namespace undex::exact
