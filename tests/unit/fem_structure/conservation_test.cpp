// Momentum, angular momentum, energy, and the same bits from any number of threads.
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <omp.h>

#include <numbers>

#include "bodies.hpp"

namespace undex::fem::testing {
namespace {

std::vector<Vec3> kicks(std::size_t count, double size) {
  std::vector<Vec3> impulse(count);
  for (std::size_t i = 0; i < count; ++i)
    impulse[i] = size * Vec3(std::sin(1.0 + 3.0 * i), std::cos(2.0 * i), std::sin(5.0 * i) + 0.5);
  return impulse;
}

Vec3 total(const std::vector<Vec3>& impulse) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& part : impulse) sum += part;
  return sum;
}

/// A free block of a soft plastic metal that is hit so hard that it yields.
Settings free_block() {
  Settings settings = plate(Vec3(0.01, 0.02, -0.03), Vec3(0.05, 0.05, 0.0), {4, 3, 3}, hardening(2700, 71e9, 0.33, 50e6, 1e9));
  settings.wet_faces = {"z_low", "x_high"};
  settings.initial_velocity = Vec3(3, -20, 10);
  return settings;
}

TEST(Conservation, FreeBodyKeepsBothMomenta) {
  Structure body(free_block());
  const Vec3 start = body.ledger().momentum;
  const auto impulse = kicks(body.wet_surface().nodes.size(), 0.06);
  body.advance(2e-6, impulse);
  EXPECT_LT((body.ledger().momentum - start - total(impulse)).norm(), 1e-13 * total(impulse).norm() + 1e-14 * start.norm());
  const Vec3 linear = body.ledger().momentum, angular = body.ledger().angular_momentum;
  while (body.steps() < 500) body.advance(body.time() + body.stable_step(), {});
  EXPECT_GT(body.ledger().plastic, 0.1 * body.ledger().received) << "the blow must make it yield";
  EXPECT_LT((body.ledger().momentum - linear).norm(), 1e-12 * linear.norm());
  EXPECT_LT((body.ledger().angular_momentum - angular).norm(), 1e-12 * angular.norm());
}

TEST(Conservation, ImpulsesArriveWholeWindowByWindow) {
  Structure body(free_block());
  Vec3 expected = body.ledger().momentum;
  double time = 0.0;
  for (int window = 1; window <= 40; ++window) {
    const auto impulse = kicks(body.wet_surface().nodes.size(), 1e-4 * window);
    time += (0.3 + 0.1 * (window % 7)) * 2e-6;  // shorter and longer than the structure's own step
    body.advance(time, impulse);
    expected += total(impulse);
    EXPECT_EQ(body.time(), time);
  }
  EXPECT_LT((body.ledger().momentum - expected).norm(), 1e-13 * expected.norm());
}

TEST(Conservation, EnergyBalances) {
  for (bool viscous : {false, true}) {
    Settings settings = free_block();
    settings.initial_velocity.setZero();
    if (!viscous) settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
    Structure body(settings);
    double time = 0.0;
    for (int window = 1; window <= 60; ++window) {
      time += 0.4e-6;
      body.advance(time, kicks(body.wet_surface().nodes.size(), window < 30 ? 0.003 : 0.0));
    }
    const BodyLedger energies = body.ledger();
    RecordProperty(viscous ? "balance_viscous" : "balance", std::to_string(energies.balance() / energies.received));
    EXPECT_GT(energies.plastic, 0.05 * energies.received);
    EXPECT_EQ(energies.viscous > 0.0, viscous);
    EXPECT_NEAR(energies.balance(), 0.0, 1e-4 * energies.received);
  }
}

TEST(Conservation, ElasticEnergyBalancesTightly) {
  // No force that jumps: what is left is the error of the integrator and of the booking, over some hundred periods.
  Settings settings = free_block();
  settings.material = elastic(2700, 71e9, 0.33);
  settings.supports = {{"z_high", {true, true, true}}};
  settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
  Structure body(settings);
  const double start = body.ledger().balance();
  double most = 0.0, least_kinetic = start;
  for (int sample = 1; sample <= 200; ++sample) {
    body.advance(sample * 5e-6, {});
    most = std::max(most, std::abs(body.ledger().balance() / start - 1.0));
    least_kinetic = std::min(least_kinetic, body.ledger().kinetic);
  }
  RecordProperty("balance", std::to_string(1e6 * most) + "e-6");
  EXPECT_LT(most, 2e-4);
  EXPECT_LT(least_kinetic, 0.8 * start) << "energy must have gone to and fro";
}

TEST(Conservation, WorkOfAWindowIsImpulseTimesMeanVelocity) {
  Structure body(free_block());
  const auto impulse = kicks(body.wet_surface().nodes.size(), 1e-3);
  const std::vector<Vec3> before(body.wet_positions().begin(), body.wet_positions().end());
  const double interval = 5e-6;
  body.advance(interval, impulse);
  double work = 0.0;
  for (std::size_t i = 0; i < impulse.size(); ++i) work += impulse[i].dot(body.wet_positions()[i] - before[i]) / interval;
  EXPECT_NEAR(body.ledger().received, work, 1e-12 * std::abs(work));
}

TEST(Conservation, ThreadsDoNotChangeABit) {
  Settings settings = plate(Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.02), {12, 12, 4}, hardening(2700, 71e9, 0.33, 50e6, 1e9));
  settings.wet_faces = {"z_low"};
  const int threads = omp_get_max_threads();
  std::vector<Vec3> positions[2];
  BodyLedger energies[2];
  for (int run = 0; run < 2; ++run) {
    omp_set_num_threads(run ? 3 : 1);
    Structure body(settings);
    body.advance(3e-6, kicks(body.wet_surface().nodes.size(), 0.02));
    body.advance(3e-5, {});
    positions[run].assign(body.positions().begin(), body.positions().end());
    energies[run] = body.ledger();
  }
  omp_set_num_threads(threads);
  ASSERT_EQ(positions[0].size(), positions[1].size());
  for (std::size_t i = 0; i < positions[0].size(); ++i) EXPECT_EQ(positions[0][i], positions[1][i]);
  EXPECT_EQ(energies[0].plastic, energies[1].plastic);
  EXPECT_GT(energies[0].plastic, 0.0);
}

TEST(Conservation, PressureIsAFollowerAndBalances) {
  // Uniform pressure all round a body that turns has no resultant.
  Settings settings = plate(Vec3(0, 0, 0), Vec3(0.04, 0.03, 0.03), {4, 3, 3}, elastic(2700, 71e9, 0.33));
  for (const char* face : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"})
    settings.loads.push_back({face, {0.0, 2e-5}, {0.0, 1e8}});
  settings.wet_faces = {"x_low"};
  Structure body(settings);
  for (int window = 1; window <= 20; ++window) {  // a smooth push sideways at one end
    const double rise = std::sin(std::numbers::pi * window / 20);
    const std::vector<Vec3> turn(body.wet_surface().nodes.size(), 2e-3 * rise * rise * Vec3(0, 2, 1));
    body.advance(window * 1e-6, turn);
  }
  const Vec3 linear = body.ledger().momentum;
  body.advance(2e-4, {});
  EXPECT_LT((body.ledger().momentum - linear).norm(), 1e-12 * linear.norm());
  const BodyLedger energies = body.ledger();
  RecordProperty("balance", std::to_string(energies.balance() / energies.kinetic));
  EXPECT_NEAR(energies.balance(), 0.0, 2e-4 * energies.kinetic);
  EXPECT_LT(std::abs(energies.integrator), 0.05 * energies.kinetic);

  Settings pushed = plate(Vec3(0, 0, 0), Vec3(0.04, 0.03, 0.03), {4, 3, 3}, elastic(2700, 71e9, 0.33));
  pushed.loads = {{"x_low", {0.0, 1e-5}, {1e7, 0.0}}};
  Structure block(pushed);
  block.advance(1e-4, {});
  EXPECT_NEAR(block.ledger().momentum[0], 0.5 * 1e7 * 1e-5 * 0.03 * 0.03, 0.01 * 0.045) << "pushes into the body";
}

}  // namespace
}  // namespace undex::fem::testing
