#include "coupling/rigid_body.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace undex::coupling {

RigidBody::RigidBody(double mass, const Mat3& inertia, const Vec3& center, const std::array<bool, 6>& free)
    : mass_(mass), inertia_(inertia), start_(center), center_(center) {
  for (int a = 0; a < 3; ++a) moves_[a] = free[std::size_t(a)], turns_[a] = free[std::size_t(a) + 3];
}

void RigidBody::set_motion(const Vec3& velocity, const Vec3& spin) {
  velocity_ = moves_ * velocity.array();
  const Mat3 turned = attitude_.toRotationMatrix();
  const Vec3 kept = turns_ * spin.array();
  momentum_ = turns_ * (turned * inertia_ * turned.transpose() * kept).array();
}

void RigidBody::kick(const Vec3& impulse, const Vec3& moment) {
  velocity_.array() += moves_ * impulse.array() / mass_;
  momentum_.array() += turns_ * moment.array();
}

/// w of L = P R I R^T P w; held components are zero.
Vec3 RigidBody::spin_of(const Eigen::Quaterniond& attitude) const {
  if ((momentum_.array() == 0.0).all()) return Vec3::Zero();
  const Mat3 turned = attitude.toRotationMatrix();
  Mat3 system = turned * inertia_ * turned.transpose();
  for (int a = 0; a < 3; ++a)
    if (turns_[a] == 0.0) {
      system.row(a).setZero();
      system.col(a).setZero();
      system(a, a) = 1.0;
    }
  return system.inverse() * momentum_;
}

Vec3 RigidBody::spin() const { return spin_of(attitude_); }

double RigidBody::kinetic_energy() const { return 0.5 * mass_ * velocity_.squaredNorm() + 0.5 * spin().dot(momentum_); }

Vec3 RigidBody::rotation() const {
  const Eigen::AngleAxisd turn(attitude_);
  return turn.angle() * turn.axis();
}

void RigidBody::drift(double dt) {
  center_ += dt * velocity_;
  const Vec3 now = spin();
  if (now.isZero(0.0)) return;
  constexpr double largest_turn = 0.02;  // [rad]
  const int turns = int(std::ceil(std::max(1.0, now.norm() * std::abs(dt) / largest_turn)));
  const double h = dt / turns;
  using Coefficients = Eigen::Vector4d;  // x, y, z, w
  const auto rate = [&](const Coefficients& q) {
    const Eigen::Quaterniond attitude(q);
    const Vec3 w = spin_of(attitude.normalized());
    return Coefficients(0.5 * (Eigen::Quaterniond(0.0, w[0], w[1], w[2]) * attitude).coeffs());
  };
  for (int k = 0; k < turns; ++k) {
    const Coefficients q = attitude_.coeffs(), a = rate(q), b = rate(q + 0.5 * h * a), c = rate(q + 0.5 * h * b),
                       d = rate(q + h * c);
    attitude_.coeffs() = q + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    attitude_.normalize();
  }
}

void RigidBody::lead(const Vec3& center, const Vec3& velocity) {
  center_ = center;
  velocity_ = velocity;
}

void RigidBody::visit_state(StateVisitor& state) {
  Vec3 axis = attitude_.vec();
  double real = attitude_.w();
  state("center", center_);
  state("velocity", velocity_);
  state("angular momentum", momentum_);
  state("attitude axis", axis);
  state("attitude", real);
  attitude_.vec() = axis;
  attitude_.w() = real;
}

}  // namespace undex::coupling
