// The motion of a rigid body by itself: what is conserved, and Euler's solutions.
#include "coupling/rigid_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace undex::coupling::testing {
namespace {

constexpr std::array<bool, 6> all_free{true, true, true, true, true, true};

TEST(RigidBody, ATorqueFreeTopKeepsMomentumAndEnergy) {
  RigidBody body(2.0, Vec3(1, 2, 3.5).asDiagonal(), Vec3(1, 2, 3), all_free);
  body.set_motion(Vec3(0.1, -0.2, 0.3), Vec3(0.01, 1.0, 0.01));  // about the middle axis: it tumbles
  const Vec3 momentum = body.angular_momentum();
  const double energy = body.kinetic_energy();
  double tumbled = 1;
  for (int k = 0; k < 2000; ++k) {
    body.drift(0.05);
    tumbled = std::min(tumbled, (body.place(Vec3(1, 3, 3)) - body.center())[1]);
  }
  EXPECT_LT(tumbled, -0.9);
  EXPECT_EQ(body.angular_momentum(), momentum);
  EXPECT_NEAR(body.kinetic_energy(), energy, 1e-9 * energy);
  EXPECT_LT((body.center() - Vec3(11, -18, 33)).norm(), 1e-10);
}

TEST(RigidBody, ASymmetricTopPrecessesAsEulerSays) {
  const double across = 2.0, about = 3.0;
  RigidBody body(1.0, Vec3(across, across, about).asDiagonal(), Vec3::Zero(), all_free);
  body.set_motion(Vec3::Zero(), Vec3(0.7, 0.0, 1.3));
  const Vec3 momentum = body.angular_momentum(), axis = momentum.normalized();
  const double time = 20.0, rate = momentum.norm() / across;
  for (int k = 0; k < 40; ++k) body.drift(time / 40);
  // The figure axis goes round the angular momentum at |L| over the moment across.
  const Vec3 exact = Eigen::AngleAxisd(rate * time, axis) * Vec3::UnitZ();
  EXPECT_LT((body.place(Vec3::UnitZ()) - exact).norm(), 1e-6);
}

TEST(RigidBody, AKicksEnergyIsItsImpulseByTheMeanVelocity) {
  Mat3 inertia;
  inertia << 2, 0.3, 0.1, 0.3, 3, -0.2, 0.1, -0.2, 4;
  RigidBody body(1.5, inertia, Vec3(1, 0, 0), all_free);
  body.set_motion(Vec3(1, 2, 3), Vec3(0.5, -0.4, 0.3));
  body.drift(0.7);
  const Vec3 impulse(0.3, 0.2, -0.5), moment(0.1, -0.6, 0.2), v = body.velocity(), w = body.spin();
  const double before = body.kinetic_energy();
  body.kick(impulse, moment);
  const double work = 0.5 * impulse.dot(v + body.velocity()) + 0.5 * moment.dot(w + body.spin());
  EXPECT_NEAR(body.kinetic_energy() - before, work, 1e-12);
}

TEST(RigidBody, HeldMotionsStayHeldAndDoNoWork) {
  Mat3 inertia;
  inertia << 2, 0.3, 0.1, 0.3, 3, -0.2, 0.1, -0.2, 4;
  RigidBody body(1.0, inertia, Vec3::Zero(), {true, false, true, false, true, true});  // y, and turning about x
  body.set_motion(Vec3(1, 1, 1), Vec3(1, 1, 1));
  EXPECT_EQ(body.velocity(), Vec3(1, 0, 1));
  const double energy = body.kinetic_energy();
  for (int k = 0; k < 200; ++k) body.drift(0.05);
  EXPECT_EQ(body.spin()[0], 0.0);
  EXPECT_NEAR(body.kinetic_energy(), energy, 1e-9 * energy);
  body.kick(Vec3(1, 1, 0), Vec3(1, 0, 0));
  EXPECT_EQ(body.velocity(), Vec3(2, 0, 1));
  EXPECT_EQ(body.spin()[0], 0.0);
}

TEST(RigidBody, PointsMoveWithIt) {
  RigidBody body(1.0, Mat3::Identity(), Vec3(1, 0, 0), all_free);
  body.set_motion(Vec3(0, 0, 2), Vec3(0, 0, 3));
  const Vec3 point(1.5, 0, 0);
  EXPECT_LT((body.velocity_at(point) - Vec3(0, 1.5, 2)).norm(), 1e-14);
  for (int k = 0; k < 100; ++k) body.drift(0.005);
  EXPECT_LT((body.place(point) - Vec3(1 + 0.5 * std::cos(1.5), 0.5 * std::sin(1.5), 1.0)).norm(), 1e-9);
  EXPECT_LT((body.place_at_start(body.place(point)) - point).norm(), 1e-14);
  EXPECT_LT((body.rotation() - Vec3(0, 0, 1.5)).norm(), 1e-9);
}

}  // namespace
}  // namespace undex::coupling::testing
