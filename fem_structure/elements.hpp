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
#include <span>
#include <vector>

#include "core/vector.hpp"
#include "fem_structure/grid.hpp"
#include "materials/solid.hpp"
#include "materials/stress_update.hpp"

namespace undex::fem {

/// State of all cells and the passes over them. Quadrature arrays run cell by cell, eight points each.
class Elements {
 public:
  Elements(const Grid& grid, const materials::Solid& material, double linear_viscosity, double quadratic_viscosity);

  /// Takes the cells from positions x - u [m] to x over dt [s] and leaves at the nodes the internal force [N] (the one
  /// that resists: m a = external - force) at the new positions. Returns the index of the first cell that inverted or
  /// is not finite, or -1. The result does not depend on the number of threads.
  long advance(std::span<const Vec3> x, std::span<const Vec3> u, double dt, std::span<Vec3> force);

  /// Stable step [s] of central differences in each cell, 2/omega (sqrt(1 + xi^2) - xi), and the least of them. omega is
  /// the highest frequency of the free cell with its lumped mass, which bounds that of any assembly (Irons); it is kept
  /// by warm power iterations that restart when the cell has strained by a per cent.
  double critical_step() const;
  std::size_t critical_cell() const;

  std::size_t cell_count() const { return cells_.size(); }
  const std::vector<double>& nodal_mass() const { return nodal_mass_; }  ///< lumped [kg]

  double elastic_energy() const;  ///< [J]
  double plastic_work() const;    ///< [J]
  double viscous_work() const;    ///< [J]

  /// Cauchy stress [Pa] at a quadrature point, without bulk viscosity.
  Mat3 stress(std::size_t cell, int q) const;
  double pressure(std::size_t cell) const { return pressure_[cell]; }
  double plastic_strain(std::size_t cell, int q) const { return plastic_strain_[8 * cell + q]; }
  double temperature(std::size_t cell, int q) const { return temperature_[8 * cell + q]; }
  /// Share of the fracture strain spent, 1: failed; 0 where the material cannot fail.
  double damage(std::size_t cell, int q) const { return damage_.empty() ? 0.0 : damage_[8 * cell + q]; }
  double volume(std::size_t cell) const { return volume_[cell]; }
  std::size_t memory_bytes() const;

  /// Internal force of a small displacement u from positions x by the elastic law alone: the linear stiffness, for the
  /// highest frequency and for tests.
  void linear_force(std::span<const Vec3> x, std::span<const Vec3> u, std::span<Vec3> force) const;

 private:
  struct Moduli {
    double bulk, twice_shear;
  };
  using CellVectors = double[3][8];  ///< [component][node]

  bool advance_cell(std::size_t cell, std::span<const Vec3> x, std::span<const Vec3> u, double dt);
  void linear_cell_force(const CellVectors& x, const CellVectors& u, Moduli moduli, CellVectors& force) const;
  void find_frequency(std::size_t cell, const CellVectors& x, Moduli moduli, int most_iterations);
  void set_critical_step(std::size_t cell, double sound, double bulk);
  void gather(const std::vector<double>& corner_force, std::span<Vec3> force) const;

  materials::Solid material_;
  double linear_viscosity_, quadratic_viscosity_;
  ReferenceCell reference_;
  std::vector<std::array<int, 8>> cells_;
  std::vector<std::size_t> corners_begin_;  ///< per node, into corners_
  std::vector<std::size_t> corners_;        ///< 8 cell + corner of every cell at the node

  // State, per quadrature point.
  std::array<std::vector<double>, 6> deviator_;  ///< xx, yy, zz, yz, zx, xy [Pa]
  std::vector<double> plastic_strain_, temperature_, weight_;
  std::vector<double> damage_;  ///< empty where the material cannot fail
  // State, per cell.
  std::vector<double> pressure_, viscous_pressure_, energy_, volume_;
  std::vector<double> elastic_, plastic_, viscous_;
  std::vector<double> frequency_, frequency_bulk_, strain_since_, compression_rate_, critical_step_;
  std::vector<double> mode_;  ///< [24] per cell, the cell's highest mode
  // Fixed.
  std::vector<double> cell_mass_, corner_mass_, nodal_mass_;
  // Scratch: force of every cell on its corners, [24] per cell.
  std::vector<double> corner_force_;
};

}  // namespace undex::fem
