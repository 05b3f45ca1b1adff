// What follows a detonation that runs at Chapman-Jouguet speed D through an explosive at rest, from a wall
// (planar), an axis or a point: the products' state depends on x = r/t alone (G. I. Taylor, Proc. R. Soc. A
// 200, 1950). SI units.
//
// All products lie on the isentrope of the Chapman-Jouguet state. Planar: the simple wave r/t = u + c with
// du = c dln(rho), down to u = 0. With divergence (d = 2, 3) the equations of mass and momentum give, with
// the velocity as independent variable, which is regular at the front where du/dx is infinite,
//   dx/du = x ((x - u)^2/c^2 - 1)/((d - 1) u),   d ln(rho)/du = (x - u)/c^2.
// The core, where r/t is less than its sound speed, is at rest and uniform.
#pragma once

#include "exact/isentrope.hpp"
#include "materials/burn.hpp"

namespace undex::exact {

class TaylorWave {
 public:
  /// dimension: 1 planar with a rigid wall at r = 0, 2 cylindrical, 3 spherical. Throws std::invalid_argument
  /// on others, std::domain_error where the products have no Chapman-Jouguet state.
  TaylorWave(const materials::Jwl& products, int dimension);
  const materials::ChapmanJouguet& front() const { return front_; }
  /// State of the core at rest.
  const IsentropeState& core() const { return core_; }
  /// Edge of the core over that of the front [-].
  double core_share() const { return core_.sound / front_.detonation_speed; }

  struct Sample {
    double density, velocity, pressure, energy;  ///< [kg/m^3], [m/s], [Pa], [J/kg]
    bool burned;                                 ///< false ahead of the front: explosive at rest, zero pressure, E0
  };
  /// State at radius r [m] and time t [s] since initiation at r = 0.
  Sample sample(double r, double t) const;

 private:
  materials::Jwl products_;
  int dimension_;
  materials::ChapmanJouguet front_;
  Isentrope isentrope_;
  IsentropeState core_;
  // Divergent flow, from the front to the core: s = u, y = (x, ln rho).
  std::vector<OdePoint<2>> points_;
  OdeState<2> slope(double u, const OdeState<2>& y) const;
};

}  // namespace undex::exact
