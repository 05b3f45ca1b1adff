// Riemann problem between any two fluid laws: two uniform states meet at x = 0 and t = 0, and the solution
// depends on x/t alone. Pressure and velocity are found where the wave curves of the two sides cross (the
// construction of E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, chapter 4, here with
// isentropes and shock states computed from the law). SI units.
//
// Barotropic laws have no energy equation: their shocks obey the conditions of mass and momentum only.
// Laws that cavitate have a floor pressure. Where the two sides would have to meet at less than one of these a cavity of that
// pressure opens between them, as a vacuum does between two gases. A law without a floor carries tension as far as its
// sound speed is real; what is pulled apart faster has no solution. Sides must be convex in the range of the solution (the speed
// u + c rises with compression along the isentrope, the speed of a shock with its strength): composite waves are not built.
#pragma once

#include <optional>

#include "exact/isentrope.hpp"

namespace undex::exact {

struct RiemannSide {
  materials::FluidLaw law;
  double density;       ///< [kg/m^3]
  double velocity;      ///< [m/s], positive to the right
  double energy = 0.0;  ///< specific [J/kg]; not used with barotropic laws
};

struct RiemannSample {
  double density;   ///< [kg/m^3], 0 in a cavity
  double velocity;  ///< [m/s]; in a cavity x/t
  double pressure;  ///< [Pa]
  double energy;    ///< specific [J/kg]; compression energy with barotropic laws
  int side;         ///< 0 left fluid, 1 right fluid, -1 cavity
};

class RiemannSolution {
 public:
  /// Throws std::invalid_argument unless densities are positive and velocities finite; std::domain_error, with the reason, where the
  /// laws have no such solution: a state without pressure or sound speed, a shock beyond the law's range, a tension beyond it, or a
  /// wave that is not convex.
  RiemannSolution(const RiemannSide& left, const RiemannSide& right);

  /// Pressure at the contact [Pa]; with a cavity that on its edges.
  double pressure() const { return pressure_; }
  /// Velocity of the contact [m/s]; with a cavity the mean of its edges.
  double velocity() const { return 0.5 * (star_[0].velocity + star_[1].velocity); }
  bool cavity() const { return cavity_; }
  /// State between the wave and the contact (side 0 left, 1 right).
  RiemannSample star(int side) const { return star_[side]; }
  bool shock(int side) const { return wave_[side].shock; }
  /// Velocity of the wave's outer edge (shock, or head of the fan) and inner edge (shock, or tail) [m/s].
  double head(int side) const { return wave_[side].head; }
  double tail(int side) const { return wave_[side].tail; }
  /// State at x/t = xi [m/s].
  RiemannSample sample(double xi) const;

 private:
  struct Wave {
    bool shock;
    double head, tail;
  };
  struct Reached {
    double velocity_change, density, energy;  // speed away from the other side that reaching p costs
  };
  Reached reach(int side, double pressure) const;
  template <class Rising>
  double crossing(const Rising& excess, double low) const;
  void expect_convex() const;

  RiemannSide side_[2];
  double start_pressure_[2], start_energy_[2];
  std::optional<Isentrope> isentrope_[2];
  double pressure_ = 0.0;
  bool cavity_ = false;
  RiemannSample star_[2]{};
  Wave wave_[2]{};
};

}  // namespace undex::exact
