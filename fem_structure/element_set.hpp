// What every kind of element shares: cells and their lumped masses, energies, stable steps, and the sum of the cells'
// forces at the nodes. A kind of element adds its strains and stresses.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/state.hpp"
#include "core/vector.hpp"
#include "fem_structure/grid.hpp"
#include "materials/solid.hpp"

namespace undex::fem {

/// All cells of a structure, of one kind of element, with their state.
class ElementSet {
 public:
  virtual ~ElementSet() = default;

  /// Takes the cells from positions x - u [m] to x over dt [s] and leaves at the nodes the internal force [N] (the one
  /// that resists: m a = external - force) at the new positions. Returns the index of the first cell that inverted or
  /// is not finite, or -1. The result does not depend on the number of threads.
  long advance(std::span<const Vec3> x, std::span<const Vec3> u, double dt, std::span<Vec3> force);

  /// Stable step [s] of central differences in each cell, 2/omega (sqrt(1 + xi^2) - xi), and the least of them. omega is
  /// the highest frequency of the free cell with its lumped mass, which bounds that of any assembly (Irons); it is kept
  /// by warm power iterations that restart when the cell has strained by a per cent.
  double critical_step() const;
  std::size_t critical_cell() const;
  /// The least of them [s] once the cells close as nodes at x [m] with velocities v [m/s] make them: bulk viscosity shortens the
  /// step in which it begins to act, which critical_step() cannot know. And none in which a cell closes by more than a tenth.
  double coming_step(std::span<const Vec3> x, std::span<const Vec3> v) const;

  std::size_t cell_count() const { return cells_.size(); }
  const std::vector<double>& nodal_mass() const { return nodal_mass_; }  ///< lumped [kg]

  double elastic_energy() const;  ///< [J]
  double plastic_work() const;    ///< [J]
  double viscous_work() const;    ///< [J]

  virtual int points_per_cell() const = 0;
  /// Share of a cell's volume that a quadrature point stands for, in the reference cell; they sum to one.
  virtual double mean_share(int q) const = 0;
  /// Weights of the quadrature points at unit coordinates of the grid's cell: their values are interpolated between the
  /// points and held constant outside them, for extrapolated ones overshoot.
  virtual std::vector<double> shares_at(const std::array<double, 3>& unit) const = 0;
  /// Cauchy stress [Pa] at a quadrature point, without bulk viscosity.
  virtual Mat3 stress(std::size_t cell, int q) const = 0;
  virtual double pressure(std::size_t cell) const = 0;  ///< mean over the cell [Pa]
  virtual double plastic_strain(std::size_t cell, int q) const = 0;
  virtual double temperature(std::size_t cell, int q) const = 0;  ///< [K]
  /// Share of the fracture strain spent, 1: failed; 0 where the material cannot fail.
  virtual double damage(std::size_t cell, int q) const = 0;
  /// Of all points, cell by cell in equal strides, of which the first points_per_cell() count; no damages where the material
  /// cannot fail.
  std::span<const double> plastic_strains() const { return plastic_strain_; }
  std::span<const double> temperatures() const { return temperature_; }
  std::span<const double> damages() const { return damage_; }
  virtual std::size_t memory_bytes() const = 0;
  virtual void visit_state(StateVisitor& state);

  /// Internal force [N] of a small displacement u [m] from positions x by the elastic law alone: the linear stiffness,
  /// for the highest frequency and for tests.
  void linear_force(std::span<const Vec3> x, std::span<const Vec3> u, std::span<Vec3> force) const;

 protected:
  struct Moduli {
    double bulk, twice_shear;  ///< [Pa]
  };
  /// [component][node]; a quadrangle has the first four nodes, and (r, axial, hoop) for components.
  using CellVectors = double[3][8];

  /// `at_once`: cells that `advance_cells` takes.
  ElementSet(const Grid& grid, const materials::Solid& material, double linear_viscosity, double quadratic_viscosity,
             std::size_t at_once = 1);
  /// For the constructors of the kinds, when their state is that of the start.
  void find_first_steps(const Grid& grid);

  /// `count` cells of `advance` from `first` on, as many as go through the law at once (fewer at the end): leaves their forces
  /// in corner_force_. Returns the first that inverted or is not finite, or -1.
  virtual long advance_cells(std::size_t first, std::size_t count, std::span<const Vec3> x, std::span<const Vec3> u,
                             double dt) = 0;
  virtual void linear_cell_force(const CellVectors& x, const CellVectors& u, Moduli moduli, CellVectors& force) const = 0;
  virtual Moduli moduli(std::size_t cell) const = 0;  ///< elastic, in the cell's present state

  /// Bulk viscosity's pressure [Pa] at a rate of volume change [1/s] (kept for the stable step).
  double viscous_pressure(std::size_t cell, double rate, double density, double sound);
  /// Stable step after a step of strain `most_strain`: the highest frequency is found anew when the cell has changed,
  /// otherwise enlarged by what the strain since may have done.
  void follow_frequency(std::size_t cell, const CellVectors& x, double most_strain, double bulk);
  /// False where a force is not finite.
  bool put_forces(std::size_t cell, const CellVectors& force);
  std::size_t shared_memory_bytes() const;

  materials::Solid material_;
  double linear_viscosity_, quadratic_viscosity_;
  std::vector<std::array<int, 8>> cells_;  ///< as the grid has them
  // State of the points that go through the stress update, eight at a time.
  std::array<std::vector<double>, 6> deviator_;  ///< xx, yy, zz, yz, zx, xy [Pa]
  std::vector<double> plastic_strain_, temperature_, weight_;
  std::vector<double> damage_;                                ///< empty where the material cannot fail
  std::vector<double> elastic_, plastic_, viscous_;           ///< energies per cell [J]
  std::vector<double> cell_mass_, corner_mass_, nodal_mass_;  ///< [kg]

 private:
  void find_frequency(std::size_t cell, const CellVectors& x, Moduli moduli, int most_iterations);
  void set_critical_step(std::size_t cell, double bulk);
  /// Share that bulk viscosity leaves of the undamped stable step, at a rate of compression [1/s]: sqrt(1 + xi^2) - xi.
  double damped_share(std::size_t cell, double compression_rate) const;
  void gather(const std::vector<double>& corner_force, std::span<Vec3> force) const;

  bool axisymmetric_;
  std::size_t nodes_per_cell_, at_once_;
  std::vector<std::size_t> corners_begin_;  ///< per node, into corners_
  std::vector<std::size_t> corners_;        ///< nodes_per_cell_ cell + corner of every cell at the node
  std::vector<double> frequency_, frequency_bulk_, strain_since_, compression_rate_, critical_step_;  ///< per cell
  std::vector<double> mode_;  ///< [3 nodes_per_cell_] per cell, the cell's highest mode
  // Scratch: force of every cell on its corners, as many.
  std::vector<double> corner_force_;
};

/// The values of a cell's nodes, in the cell's order.
inline void collect(std::span<const Vec3> from, const std::array<int, 8>& cell, double (&to)[3][8]) {
  for (int node = 0; node < 8; ++node) {
    const Vec3& value = from[cell[node]];
    for (int i = 0; i < 3; ++i) to[i][node] = value[i];
  }
}

}  // namespace undex::fem
