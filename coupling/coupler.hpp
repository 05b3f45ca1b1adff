// Water and structure advanced together, window by window:
//   predict the wall -> the water sees it as a moving wall -> the water advances and keeps the impulse that the wall
//   received -> the structure receives exactly that impulse over its own steps -> the ledger books the exchange.
// A window is one fluid step over several structure steps, or several fluid steps over one of the structure's, whichever
// their stable steps ask. The coupler owns the step; each solver only says how long a step it can take, and neither knows
// of the other's mass: a window is not longer than added_mass_limit() either.
#pragma once

#include <string>
#include <variant>

#include "core/deformable_body.hpp"
#include "coupling/face_impulses.hpp"
#include "coupling/flow.hpp"
#include "coupling/interface_ledger.hpp"
#include "coupling/settings.hpp"
#include "coupling/wet_wall.hpp"

namespace undex::coupling {

/// The longest window [s] in which the water may act on a wall that it has seen move at the window's start: the least over
/// the wet nodes of share sqrt(m dx/rho)/c, m being the wall's mass per area, rho, c and dx density and sound speed at the
/// start and spacing of the nearest liquid (gases and products are soft by the time they fill the place before a wall).
/// Wall and first layer of particles oscillate against each other; where the wall is the lighter one, by its mass on the layer's
/// stiffness, rho c^2/dx per area: omega = c sqrt(rho/(m dx)), within a factor of order one, and `share` is omega times the
/// window. `criterion` is "added mass", `position` the node's; the step is infinite where there is no liquid.
sph::StepLimit added_mass_limit(const sph::Settings& fluid, const WetBody& structure);

class Coupler {
 public:
  /// Shows the fluid the structure's wet surface, each of its walls by itself: a mirror where the fluid slips along it and its
  /// scheme mirrors, else lined with dummy particles. Both must outlive the coupler.
  Coupler(Flow& flow, WetBody& structure, const Settings& settings);

  struct Window {
    double step = 0;                 ///< last fluid step [s]
    sph::StepLimit limit;            ///< what the fluid allowed, or the wall's mass where that is less
    bool held_by_structure = false;  ///< the window was cut to the structure's step
    long fluid_steps = 0, structure_steps = 0;
  };
  /// One window, not beyond time `end` [s].
  Window advance(double end);

  void visit_state(StateVisitor& state);

  InterfaceLedger ledger() const;
  const FaceImpulses& on_faces() const { return on_faces_; }
  const WetWall& wall() const { return walls_.front().wall; }
  const PassTimers& timers() const { return timers_; }

 private:
  /// A wall of the structure: its nodes, and what they have received.
  struct Part {
    std::size_t first, count;
    WetWall wall;
    WallIndex index;
    std::vector<Vec3> impulse;  ///< [N s]
  };
  void show_wall(double ahead);
  /// Books what the walls have received and gives it to the nodes.
  void collect_impulse();
  sph::StepLimit step_limit();

  Flow& flow_;
  sph::Fluid& fluid_;
  WetBody& structure_;
  Settings settings_;
  std::vector<Part> walls_;
  sph::StepLimit added_mass_;
  PassTimers timers_;
  InterfaceLedger ledger_;
  FaceImpulses on_faces_;
  std::vector<Vec3> predicted_position_, predicted_velocity_, nodal_impulse_;
};

}  // namespace undex::coupling
