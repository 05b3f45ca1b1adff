// Fluid at rest under gravity: dp/ds = rho(p) g along the depth s, the specific energy being the same everywhere.
#pragma once

#include <vector>

#include "materials/equation_of_state.hpp"

namespace undex::materials {

/// The pressure in a column of one fluid. Integrated once by the classical Runge-Kutta method on a few hundred depths; between
/// them one more step of it.
class HydrostaticColumn {
 public:
  /// `pressure` [Pa] at depth zero, `gravity` [m/s^2] along increasing depth; covers the depths from `low` to `high` [m], either
  /// of which may be negative. Throws std::domain_error where the law has no density at a pressure of the column.
  HydrostaticColumn(const FluidLaw& law, double energy, double pressure, double gravity, double low, double high);

  double pressure(double depth) const;  ///< [Pa]
  double density(double depth) const;   ///< [kg/m^3]

 private:
  double advanced(double pressure, double step) const;

  FluidLaw law_;
  double energy_, gravity_, low_, step_;
  std::vector<double> pressure_;  // at low_ + k step_
};

}  // namespace undex::materials
