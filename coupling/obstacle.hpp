// One rigid body in the water: its surface as a mirror wall, its motion, and what crosses between it, the water and the world
// outside.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/surface.hpp"
#include "coupling/rigid_body.hpp"
#include "coupling/settings.hpp"
#include "sph_fluid/water/fluid.hpp"

namespace undex::coupling {

/// Of the kept part of the body, since the start.
struct ObstacleLedger {
  Vec3 received = Vec3::Zero();  ///< impulse from the water [N s]
  Vec3 turning = Vec3::Zero();   ///< its moment about the body's middle of mass [N m s]
  double exchanged = 0;          ///< sum of the magnitudes over nodes and steps [N s]
  Vec3 outside = Vec3::Zero();   ///< impulse from all else: gravity, `force`, what holds or leads it [N s]
  double work_received = 0;      ///< from the water [J]
  double external = 0;           ///< by `force` and what leads it [J]
  double gravity = 0;            ///< [J]
  double mass = 0;               ///< of one that is not led [kg]
  double kinetic = 0;            ///< [J]
  Vec3 momentum = Vec3::Zero();  ///< [N s]
};

/// What is written of the whole body: vectors of a free motion count what symmetry planes cut off.
struct ObstacleState {
  std::optional<double> mass;  ///< of a free body [kg]
  Vec3 displacement;           ///< of the middle of mass since the start [m]
  Vec3 position, velocity;     ///< of the middle of mass [m], [m/s]
  Vec3 rotation, spin;         ///< axis times angle [rad], [rad/s]
  Vec3 force, moment;          ///< by the water over the last step; about the middle of mass [N], [N m]
  Vec3 impulse;                ///< by the water since the start [N s]
};

class RigidObstacle {
 public:
  /// Shapes, places and vectors are those of the fluid's frame (of revolution: the meridian). Throws std::invalid_argument, which
  /// opens with "obstacles.<name>", where the body cannot stand there or move so.
  RigidObstacle(const Obstacle& given, const sph::Settings& fluid);

  /// Its surface where it is now, for the fluid to be mirrored in.
  sph::MirrorWall wall() const;
  /// The longest step [s] in which the water may act on it; endless for one that does not answer.
  double stable_step() const { return stable_step_; }
  const std::string& body_of_step() const { return liquid_; }

  /// The step from `time` over dt [s], while `force` [N] acts on the nodes at its beginning: half a kick, the drift, and `wall`
  /// put where the body is then, with the velocity that it will have if the force stays.
  void set_out(double time, double dt, std::span<const Vec3> force, sph::MirrorWall& wall);
  /// The rest of the step: takes the wall's impulse, sets it to zero, and shows the wall the velocity that has come of it.
  void arrive(double time, double dt, sph::MirrorWall& wall);

  const Obstacle& given() const { return given_; }
  const RigidBody& body() const { return body_; }
  const WetSurface& surface() const { return surface_; }
  bool moves() const { return given_.motion != Motion::fixed; }
  /// From a place in space [m] to the body's surface, negative inside.
  double signed_distance(const Vec3& x) const;
  /// Its nodes now [m].
  std::vector<Vec3> places() const;
  ObstacleLedger ledger() const;
  ObstacleState state() const;
  std::string description() const;

  void visit_state(StateVisitor& state);

 private:
  void find_stable_step(const sph::Settings& fluid);
  /// What the water, gravity and `force` at `time` give over dt [s].
  void kick(double time, double dt, const Vec3& impulse, const Vec3& moment);
  void lead(double time);
  void show(const RigidBody& body, sph::MirrorWall& wall) const;

  Obstacle given_;
  Vec3 gravity_;
  int dimension_;
  bool axisymmetric_;
  std::array<bool, 3> cut_;   // by the symmetry plane across an axis
  std::array<bool, 6> free_;  // motions along x, y, z and about them
  double share_;              // of the whole that symmetry planes leave
  WetSurface surface_;        // at the start
  RigidBody body_;
  double stable_step_ = std::numeric_limits<double>::infinity();
  std::string liquid_;
  std::vector<Vec3> first_half_;  // within a step: the impulse on the nodes in its first half [N s]
  Vec3 first_moment_ = Vec3::Zero();
  Vec3 start_momentum_ = Vec3::Zero();
  Vec3 last_force_ = Vec3::Zero(), last_moment_ = Vec3::Zero();  // of the kept part
  ObstacleLedger ledger_;
};

}  // namespace undex::coupling
