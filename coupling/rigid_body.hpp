// A rigid body in space: Newton's and Euler's equations as kicks (impulses at one moment) and drifts (free motion between them).
//   dx/dt = v,  m dv/dt = F;   dq/dt = 1/2 (0, w) q,  dL/dt = M,  L = R I R^T w
// q is a unit quaternion, R its rotation, I the inertia in the body's frame about the middle of mass. While it drifts L is
// constant, to the last digit, and q is integrated by Runge and Kutta's fourth order in turns of at most 0.02 rad: the energy of
// a body without torque drifts by some 1e-12 a turn. Motions along and about the coordinate axes may be held: with P the
// projection on the free ones L is P R I R^T P w, whose rate still is P M, for what holds the body does no work on w.
#pragma once

#include <array>

#include <Eigen/Geometry>

#include "core/state.hpp"
#include "core/vector.hpp"

namespace undex::coupling {

class RigidBody {
 public:
  /// At rest. `inertia` [kg m^2] about `center` [m], in the axes of space at the start. `free`: x, y, z, then about x, y, z.
  RigidBody(double mass, const Mat3& inertia, const Vec3& center, const std::array<bool, 6>& free);

  void set_motion(const Vec3& velocity, const Vec3& spin);
  /// An impulse [N s] and its moment about the middle of mass [N m s].
  void kick(const Vec3& impulse, const Vec3& moment);
  /// Free motion over dt [s].
  void drift(double dt);
  /// Somebody else says where it is, and how fast.
  void lead(const Vec3& center, const Vec3& velocity);

  double mass() const { return mass_; }
  const Mat3& inertia() const { return inertia_; }  ///< as given
  const Vec3& start() const { return start_; }      ///< where its middle of mass was first [m]
  const Vec3& center() const { return center_; }
  const Vec3& velocity() const { return velocity_; }
  Vec3 spin() const;                                          ///< [rad/s]
  const Vec3& angular_momentum() const { return momentum_; }  ///< about the middle of mass, along the free axes [kg m^2/s]
  double kinetic_energy() const;                              ///< [J]
  /// Axis times angle of the turn since the start, at most pi [rad].
  Vec3 rotation() const;

  /// Where a point is that lay at `x` [m] before the body moved, and how fast it moves there.
  Vec3 place(const Vec3& x) const { return center_ + attitude_ * (x - start_); }
  Vec3 velocity_at(const Vec3& place) const { return velocity_ + spin().cross(place - center_); }
  /// Where a place in space lay, seen from the body, before it moved.
  Vec3 place_at_start(const Vec3& place) const { return start_ + attitude_.conjugate() * (place - center_); }

  void visit_state(StateVisitor& state);

 private:
  Vec3 spin_of(const Eigen::Quaterniond& attitude) const;

  double mass_;
  Mat3 inertia_;
  Vec3 start_;
  Eigen::Array3d moves_, turns_;  // 1 where free, else 0
  Vec3 center_, velocity_ = Vec3::Zero(), momentum_ = Vec3::Zero();
  Eigen::Quaterniond attitude_ = Eigen::Quaterniond::Identity();
};

}  // namespace undex::coupling
