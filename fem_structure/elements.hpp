// Forces and stresses of eight-node hexahedra, and of rings whose sections are four-node quadrangles of a meridian, in an
// updated-Lagrangian description, with mean dilatation.
//
// Deviatoric part: full integration with 2x2x2 points, in a meridian 2x2, hypoelastic, stress rotated by the Hughes-Winget
// (Cayley) rotation of the step, radial return at each quadrature point. Volumetric part: one pressure per cell from the cell's
// mean density (Nagtegaal, Parks, Rice 1974), so that plastic flow does not lock. The nodal force of a cell is the exact
// derivative of its power: f_I = sum_q w_q S_q grad N_I - p sum_q w_q grad N_I. deal.II is not seen here.
//
// A ring has the hoop for its third direction, of unit coordinate the angle: the Jacobian there is r, the strain u_r / r, and a
// node's radial force has the hoop stress's part, N_I / r. So both kinds are one code; two rings fill a batch of eight points.
//
// Where the material can fail, each quadrature point does so by itself and loses its deviator. The cell's pressure is the
// mean over its points of what each carries of the one pressure: in tension the share of the points that have not failed.
// So a cell breaks by eighths, as its points do; "no tension after the first" would let one corner open the whole cell, "none
// after the last" would let seven broken eighths hang on one. Spall is a matter of the pressure, hence of the whole cell.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fem_structure/element_set.hpp"
#include "materials/stress_update.hpp"

namespace undex::fem {

/// State of all cells and the passes over them. Quadrature arrays run cell by cell, eight points each, of a ring four.
template <bool axisymmetric>
class VolumeElements final : public ElementSet {
 public:
  static constexpr int points = axisymmetric ? 4 : 8, at_once = materials::points_at_once / points;

  VolumeElements(const Grid& grid, const materials::Solid& material, double linear_viscosity, double quadratic_viscosity);

  int points_per_cell() const override { return points; }
  double mean_share(int) const override { return 1.0 / points; }
  std::vector<double> shares_at(const std::array<double, 3>& unit) const override;
  Mat3 stress(std::size_t cell, int q) const override;
  double pressure(std::size_t cell) const override { return pressure_[cell]; }
  double plastic_strain(std::size_t cell, int q) const override { return plastic_strain_[points * cell + q]; }
  double temperature(std::size_t cell, int q) const override { return temperature_[points * cell + q]; }
  double damage(std::size_t cell, int q) const override { return damage_.empty() ? 0.0 : damage_[points * cell + q]; }
  double volume(std::size_t cell) const { return volume_[cell]; }
  std::size_t memory_bytes() const override;
  void visit_state(StateVisitor& state) override;

 private:
  using Lanes = materials::EightPoints;  ///< one value per quadrature point
  struct Step;
  struct Work;

  long advance_cells(std::size_t first, std::size_t count, std::span<const Vec3> x, std::span<const Vec3> u, double dt) override;
  void linear_cell_force(const CellVectors& x, const CellVectors& u, Moduli moduli, CellVectors& force) const override;
  Moduli moduli(std::size_t cell) const override;
  /// Of `count` cells; idle lanes repeat the last of them.
  void advance_points(std::size_t first, std::size_t count, const Step& step, double dt, Work (&work)[at_once],
                      Lanes (&stress)[6]);
  void advance_volume(std::size_t cell, double volume, double dt, Work work, const CellVectors& x);

  ReferenceCell reference_;
  // State, per cell.
  std::vector<double> pressure_, viscous_pressure_, energy_, volume_;
};
extern template class VolumeElements<false>;
extern template class VolumeElements<true>;

using Elements = VolumeElements<false>;
using RingElements = VolumeElements<true>;

}  // namespace undex::fem
