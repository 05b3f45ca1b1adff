// Forces and stresses of eight-node hexahedra in an updated-Lagrangian description, with mean dilatation.
//
// Deviatoric part: full 2x2x2 integration, hypoelastic, stress rotated by the Hughes-Winget (Cayley) rotation of the
// step, radial return at each quadrature point. Volumetric part: one pressure per cell from the cell's mean density
// (Nagtegaal, Parks, Rice 1974), so that plastic flow does not lock. The nodal force of a cell is the exact derivative
// of its power: f_I = sum_q w_q S_q grad N_I - p sum_q w_q grad N_I. deal.II is not seen here.
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

/// State of all cells and the passes over them. Quadrature arrays run cell by cell, eight points each.
class Elements final : public ElementSet {
 public:
  Elements(const Grid& grid, const materials::Solid& material, double linear_viscosity, double quadratic_viscosity);

  int points_per_cell() const override { return 8; }
  double mean_share(int) const override { return 0.125; }
  std::vector<double> shares_at(const std::array<double, 3>& unit) const override;
  Mat3 stress(std::size_t cell, int q) const override;
  double pressure(std::size_t cell) const override { return pressure_[cell]; }
  double plastic_strain(std::size_t cell, int q) const override { return plastic_strain_[8 * cell + q]; }
  double temperature(std::size_t cell, int q) const override { return temperature_[8 * cell + q]; }
  double damage(std::size_t cell, int q) const override { return damage_.empty() ? 0.0 : damage_[8 * cell + q]; }
  double volume(std::size_t cell) const { return volume_[cell]; }
  std::size_t memory_bytes() const override;
  void visit_state(StateVisitor& state) override;

 private:
  using Lanes = materials::EightPoints;  ///< one value per quadrature point
  struct Step;
  struct Work;

  bool advance_cell(std::size_t cell, std::span<const Vec3> x, std::span<const Vec3> u, double dt) override;
  void linear_cell_force(const CellVectors& x, const CellVectors& u, Moduli moduli, CellVectors& force) const override;
  Moduli moduli(std::size_t cell) const override;
  Work advance_points(std::size_t cell, const Step& step, double dt, Lanes (&stress)[6]);
  void advance_volume(std::size_t cell, double volume, double dt, Work work, const CellVectors& x);

  ReferenceCell reference_;
  // State, per cell; its points are the eight quadrature points.
  std::vector<double> pressure_, viscous_pressure_, energy_, volume_;
};

}  // namespace undex::fem
