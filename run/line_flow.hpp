// A scene that needs one coordinate, on the one-dimensional Lagrangian mesh (exact/lagrangian_1d.hpp): its bodies and solids as
// layers, read as points in space. Cells are as fine as the scene says in the core (scene/line.hpp) and wider away from it. In
// fluids at rest the first wave's front is followed as a discontinuity. What it has left behind is merged, the more the farther
// behind, and what is ahead of it costs nothing: the cells at work grow with the logarithm of its way.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/largest.hpp"
#include "core/point_values.hpp"
#include "exact/lagrangian_1d.hpp"
#include "run/driver.hpp"
#include "scene/line.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// Energies [J] of the whole sphere; in a plane per area [m^2], of what is computed.
struct LineLedger {
  double kinetic = 0, internal = 0, dissipated = 0;    ///< of fluids; heat of shocks in barotropic ones
  double solid_kinetic = 0, elastic = 0, plastic = 0;  ///< of solids; what shocks left in them is in the elastic part
  double external = 0;                                 ///< work of pressure from outside
  double gravity = 0;                                  ///< work of gravity
  double radiated = 0;                                 ///< what has left through radiating ends
  double mass = 0, momentum = 0;                       ///< [kg], along x in a plane [kg m/s]
  long step = -1;                                      ///< after which it was drawn up
};

/// A layer of fluid, of the whole sphere; in a plane per area [m^2].
struct LayerTotals {
  double mass = 0, volume = 0;       ///< [kg], [m^3]
  double kinetic = 0, internal = 0;  ///< as in the ledger [J]
  double pressure_volume = 0;        ///< integral of the pressure over the volume [J]
  double cavitated = 0, voids = 0;   ///< volume of cells that have a void fraction, integral of that [m^3]
  double moment = 0;                 ///< integral of x over mass, in a plane [kg m]
};

class LineFlow {
 public:
  /// Throws SceneError where the mesh refuses the scene.
  explicit LineFlow(const scene::Scene& scene);

  double time() const { return mesh_.time(); }
  long steps() const { return mesh_.steps(); }
  Step advance(double end);  ///< one step, not beyond `end` [s]
  void visit_state(StateVisitor& state);
  const exact::Lagrangian1D& mesh() const { return mesh_; }
  const scene::Line& line() const { return line_; }
  bool is_plane() const { return !spherical_; }

  const LineLedger& ledger() const;  ///< of the present state; drawn up when somebody asks
  bool pushed_at_ends() const { return spherical_ || line_.closed[0] || line_.closed[1]; }
  /// Kinetic energy of small waves against the present pressure [J]: sum of V p^2/(2 rho c^2).
  double compression_energy() const;
  double maximum_pressure() const;
  std::vector<LayerTotals> totals() const;  ///< of the scene's bodies of fluid, in its order
  /// Pressure and speed of each layer, of solids also plastic strain, damage (of materials that can fail) and temperature.
  std::vector<LargestOf> largest() const;

  /// The fluid at a point of space; nothing (zeros) outside of it and in solids.
  FluidPoint at(const Vec3& x) const;
  /// The fluid at the end or the solid's surface nearest to a place of the start, whenever asked.
  std::function<FluidPoint()> at_surface(const Vec3& start) const;
  /// The material point of a solid at a place of the start, whenever asked.
  std::function<MaterialPoint()> in_solid(const Vec3& start) const;
  /// A field of all cells by the name that particles have for it (docs/reference/outputs.md); places are (r, 0, 0) from the
  /// middle, or x.
  std::vector<double> field(const std::string& name) const;

  /// What a reader must know of the run: when the wave reached the outer end. Empty: nothing.
  std::string remark() const;

  std::size_t cells() const { return static_cast<std::size_t>(mesh_.cells()); }
  std::vector<std::size_t> cells_by_layer() const;
  std::size_t memory_bytes() const;

 private:
  double step_to_probe() const;
  void merge_behind_front();
  void look_for_front();
  void merge(double growth, double width);
  double place_of(const Vec3& x) const;
  Vec3 outward(const Vec3& x) const;
  Vec3 point_at(double place) const;
  bool is_solid(int cell) const { return line_.layers[mesh_.cell_layer()[cell]].is_solid; }
  /// Cell state as fluid, with velocity along `along` [m/s].
  FluidPoint fluid_point(double density, double energy, double pressure, int layer, double velocity, const Vec3& along) const;

  bool spherical_;
  scene::Line line_;
  double spacing_;
  double around_;                   // the surroundings' pressure, under which solids are without stress [Pa]
  std::vector<double> material_;    // number of each layer's body; solids count on after the bodies
  std::vector<std::string> names_;  // of each layer's body or solid
  exact::Lagrangian1D mesh_;
  // Of the first wave's front: when it is looked for [s], and how far from the core it was at the last look and the last merge
  // [m].
  double next_look_ = 0, last_look_ = 0, front_ = 0, merged_at_ = 0;
  double reached_end_ = -1;     // when something has reached the outer end [s]
  std::vector<double> probes_;  // places of fluid probes, rising [m]
  mutable std::optional<LineLedger> ledger_;
};

class OnALine : public Driver {
 public:
  explicit OnALine(LineFlow& flow) : flow_(flow) {}
  Step advance(double end) override { return flow_.advance(end); }

 private:
  LineFlow& flow_;
};

}  // namespace undex::run
