// Solid shells: eight-node hexahedra for thin walls, one cell through the thickness, several quadrature points in it. Or rings,
// whose sections are four-node quadrangles of a meridian.
//
// Metric changes of a step are taken where they do not lock: transverse shear at the middles of the mid-surface's edges
// (Dvorkin, Bathe 1984, doi 10.1108/eb023562), thickness strain at its corners (Betsch, Stein 1995), and membrane and bending
// strain at the 2x2 points in the plane. One enhanced strain, along the normal and linear through the thickness, lets bending
// change the thickness as Poisson's ratio asks (Hauptmann, Schweizerhof 1998; all in docs/references.bib). Pressure: one per
// layer of points, from the layer's mean dilatation. The nodal force is the exact derivative of the power of these strains.
//
// A ring's mid-surface has a line for its section; its second coordinate is the angle, along which a field's derivative is its
// radial part, round the hoop. Shear is taken at the line's middle, thickness strain at its ends, the rest at two points.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fem_structure/element_set.hpp"
#include "fem_structure/settings.hpp"
#include "materials/stress_update.hpp"

namespace undex::fem {

/// Direction (0, 1 or 2) of a cell's unit coordinates that runs through the wall: radial in a tube, the thinnest extent of a
/// plate, the third of gmsh's shells; a disc's, a rod in a meridian, along the axis. Throws std::invalid_argument where a mesh
/// has none; `who` opens it.
int thickness_direction(const Mesh& mesh, bool axisymmetric, const std::string& who);

/// Layers of a cell at most.
inline constexpr int most_layers = 10;

/// State of all shell cells and the passes over them. Points of a cell: four in the plane (two of a ring), layer by layer from
/// the low end of the thickness direction, on Gauss points.
template <bool axisymmetric>
class SolidShells final : public ElementSet {
 public:
  /// `through`: the cells' direction across the wall; `layers`: Gauss points through the thickness, 2 to most_layers.
  SolidShells(const Grid& grid, const materials::Solid& material, double linear_viscosity, double quadratic_viscosity,
              int through, int layers);

  int points_per_cell() const override { return per_layer * layers_; }
  double mean_share(int q) const override { return 0.5 / per_layer * layer_weight_[q / per_layer]; }
  std::vector<double> shares_at(const std::array<double, 3>& unit) const override;
  Mat3 stress(std::size_t cell, int q) const override;
  double pressure(std::size_t cell) const override;
  double plastic_strain(std::size_t cell, int q) const override { return plastic_strain_[at(cell, q)]; }
  double temperature(std::size_t cell, int q) const override { return temperature_[at(cell, q)]; }
  double damage(std::size_t cell, int q) const override { return damage_.empty() ? 0.0 : damage_[at(cell, q)]; }
  std::size_t memory_bytes() const override;
  void visit_state(StateVisitor& state) override;

 private:
  static constexpr int per_layer = axisymmetric ? 2 : 4, layers_at_once = materials::points_at_once / per_layer;
  static constexpr int most_batches = (most_layers + layers_at_once - 1) / layers_at_once;
  static constexpr int corners = axisymmetric ? 2 : 4, edges = axisymmetric ? 1 : 4;  ///< of the mid-surface

  using Lanes = materials::EightPoints;  ///< the points of one layer, then those of the next
  struct Rule;
  struct Surface;
  struct Geometry;
  struct Work;

  long advance_cells(std::size_t cell, std::size_t, std::span<const Vec3> x, std::span<const Vec3> u, double dt) override {
    return advance_cell(cell, x, u, dt) ? -1 : static_cast<long>(cell);
  }
  /// False where the cell inverted or is not finite.
  bool advance_cell(std::size_t cell, std::span<const Vec3> x, std::span<const Vec3> u, double dt);
  void linear_cell_force(const CellVectors& x, const CellVectors& u, Moduli moduli, CellVectors& force) const override;
  Moduli moduli(std::size_t cell) const override;

  void turn_in(const CellVectors& cell, CellVectors& local) const;
  void turn_out(const CellVectors& local, CellVectors& cell) const;
  bool find_geometry(const Surface& x, Geometry& geometry) const;
  /// Assumed strain [6] of a small displacement at all points, without the enhanced one.
  void find_strain(const Surface& x, const Surface& u, const Geometry& geometry, Lanes (*strain)[6]) const;
  /// Amplitude of the enhanced strain that takes the elastic residual to zero: `residual` [J] before the strain.
  double enhance(const Geometry& geometry, Moduli moduli, double residual, Lanes (*strain)[6]) const;
  double residual_of(const Geometry& geometry, const Lanes (*stress)[6]) const;
  void spread(const Surface& x, const Geometry& geometry, const Lanes (*stress)[6], CellVectors& force) const;
  void find_gradient(int batch, const Surface& change, const Geometry& geometry, const Lanes (&strain)[6],
                     Lanes (&gradient)[3][3]) const;
  void advance_points(std::size_t cell, int batch, const Surface& change, const Geometry& geometry, const Geometry& end,
                      const Lanes (&strain)[6], double dt, Work& work, Lanes (&stress)[6]);
  bool advance_layers(std::size_t cell, double dt, double amplitude, const Work& work, const Geometry& end, const CellVectors& x,
                      Lanes (*stress)[6]);
  bool advance_pressure(std::size_t cell, int layer, double viscous, const Work& work, double& stored, double& bulk);
  std::size_t at(std::size_t cell, int q) const { return 8 * (batches_ * cell) + q; }
  std::size_t layer_at(std::size_t cell, int layer) const { return layers_at_once * batches_ * cell + layer; }

  int layers_, batches_;  ///< layers go through the law layers_at_once at a time; of the last batch some may be empty
  /// Local node (low face, then high face through the wall) -> node of the grid's cell.
  std::array<int, 2 * corners> order_;
  int through_;
  std::vector<double> layer_zeta_, layer_weight_;  ///< of all batches; the weight of an empty layer is zero

  // Points: 8 batches_ a cell. State, per layer, those of empty ones too. Energy per reference volume [J/m^3], volume over the
  // reference volume.
  std::vector<double> pressure_, energy_, dilatation_;
  // State, per cell. Residual of the enhanced strain [J], bulk modulus [Pa].
  std::vector<double> viscous_pressure_, residual_, bulk_;
};
extern template class SolidShells<false>;
extern template class SolidShells<true>;

using ShellElements = SolidShells<false>;
using RingShells = SolidShells<true>;

}  // namespace undex::fem
