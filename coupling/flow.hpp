// The water and the rigid bodies that stand in it, in step: to the drivers both together are the water.
#pragma once

#include <string>
#include <vector>

#include "core/deformable_body.hpp"
#include "core/timers.hpp"
#include "coupling/contacts.hpp"
#include "coupling/obstacle.hpp"
#include "sph_fluid/water/fluid.hpp"

namespace undex::coupling {

class Flow {
 public:
  /// Shows the fluid, which must outlive this, the obstacles of its frame. Throws std::invalid_argument, which opens with
  /// "obstacles.<name>", where one cannot stand or move as it is given.
  explicit Flow(sph::Fluid& fluid, const std::vector<Obstacle>& obstacles = {});

  sph::Fluid& fluid() { return fluid_; }
  const sph::Fluid& fluid() const { return fluid_; }
  double time() const { return fluid_.time(); }

  /// What the water and the obstacles bear.
  sph::StepLimit step_limit();
  /// Water and obstacles advance by dt [s]. Throws NumericalStop as Fluid::step does, the obstacles being where they were then;
  /// and where an obstacle has met something.
  void step(double dt);

  /// Obstacles must keep clear of it.
  void watch(const DeformableBody& body) { contacts_.watch(body, obstacles_); }

  const std::vector<RigidObstacle>& obstacles() const { return obstacles_; }
  /// The surfaces of all obstacles now (of revolution: in the meridian): `displacement` [m] and `velocity` [m/s] of the nodes; of
  /// the faces the water's `pressure` beyond that of the surroundings [Pa] (0 before its rates are found) and `obstacle`, the
  /// number of the body in the scene.
  BodySnapshot snapshot() const;
  const PassTimers& timers() const { return timers_; }
  void visit_state(StateVisitor& state);

 private:
  sph::Fluid& fluid_;
  std::vector<RigidObstacle> obstacles_;
  std::vector<sph::MirrorIndex> walls_;
  Contacts contacts_;
  PassTimers timers_;
};

}  // namespace undex::coupling
