// Bodies with steps of their own: what they exchange is conserved as with one step for all, and the answer is the same but for
// the step's error.
#include <algorithm>
#include <numbers>
#include <set>

#include "refused_step.hpp"

namespace undex::sph::testing {
namespace {

using Names = std::vector<std::string>;

/// A blob of water with a bubble of `finer` times smaller spacing in it; nothing outside.
Settings blob(SchemeName scheme, bool local, double spacing = 0.05, int finer = 4) {
  Settings s;
  s.dimension = 2;
  s.lattice.spacing = spacing;
  s.numerics.threads = 1;
  s.numerics.scheme = scheme;
  s.numerics.local_steps = local;
  const Sphere bubble{Vec3(0.02, 0.01, 0), 0.12};
  Body water = body("water", Shape{Sphere{Vec3::Zero(), 1.2}, {bubble}}, "water-tait"),
       gas = body("gas", Shape{bubble, {}}, "bubble-gas");
  water.pressure = 5e7;
  water.velocity = {20, -10, 0};
  gas.spacing = spacing / finer;
  gas.variable_h = true;
  s.bodies = {water, gas};
  return s;
}

class LocalSteps : public ::testing::TestWithParam<SchemeName> {};
INSTANTIATE_TEST_SUITE_P(Schemes, LocalSteps,
                         ::testing::Values(SchemeName::monaghan, SchemeName::monaghan_switch, SchemeName::riemann,
                                           SchemeName::riemann_corrected),
                         [](const auto& one) {
                           for (const auto& [name, scheme] : scheme_names)
                             if (scheme == one.param) return name;
                           return "";
                         });

TEST_P(LocalSteps, MassAndMomentumToRoundOffEnergyAsWithOneStep) {
  double error[2], kinetic[2];
  long steps[2], substeps[2];
  for (const bool local : {false, true}) {
    Fluid fluid(blob(GetParam(), local));
    const Ledger start = fluid.ledger();
    fluid.step_limit();
    EXPECT_EQ(fluid.fast_bodies(), local ? Names{"gas"} : Names{});
    while (fluid.time() < 1e-4 * (1 - 1e-12)) fluid.step(std::min(fluid.step_limit().step, 1e-4 - fluid.time()));
    const Ledger end = fluid.ledger();
    const std::vector<double> m = fluid.field("mass"), v = fluid.field("velocity");
    double speed_sum = 0;
    for (std::size_t i = 0; i < m.size(); ++i) speed_sum += m[i] * vector_of(v, i).norm();
    EXPECT_NEAR(end.mass, start.mass, 1e-14 * start.mass);
    EXPECT_LT((end.momentum - start.momentum).norm(), 1e-12 * speed_sum);
    error[local] = std::abs(total(end) - total(start)) / end.kinetic;
    kinetic[local] = end.kinetic;
    steps[local] = fluid.steps();
    substeps[local] = fluid.substeps();
  }
  RecordProperty("energy_error", std::to_string(error[0]) + " " + std::to_string(error[1]));
  EXPECT_EQ(substeps[0], 0);
  EXPECT_GT(substeps[1], steps[1]);
  EXPECT_LT(steps[1], 0.7 * steps[0]);
  EXPECT_LT(error[1], 3e-3);
  EXPECT_NEAR(kinetic[1] / kinetic[0], 1.0, 0.01);
}

/// Bodies whose steps differ by less than a factor of two share one, to the last digit.
TEST_P(LocalSteps, NoneWhereStepsAreAlike) {
  std::vector<double> velocity;
  for (const bool local : {false, true}) {
    Fluid fluid(blob(GetParam(), local, 0.05, 1));
    for (int k = 0; k < 20; ++k) {
      fluid.step(fluid.step_limit().step);
      EXPECT_TRUE(fluid.fast_bodies().empty());
    }
    if (!local) velocity = fluid.field("velocity");
    EXPECT_EQ(fluid.field("velocity"), velocity);
    EXPECT_EQ(fluid.substeps(), 0);
  }
}

TEST_P(LocalSteps, DoNotDependOnTheNumberOfThreads) {
  std::vector<double> velocity, energy;
  for (const int threads : {1, 2}) {
    Settings s = blob(GetParam(), true, 0.04);
    s.numerics.threads = threads;
    Fluid fluid(s);
    for (int k = 0; k < 4; ++k) fluid.step(fluid.step_limit().step);
    EXPECT_GT(fluid.substeps(), 4);
    if (threads == 1) {
      velocity = fluid.field("velocity");
      energy = fluid.field("density");
    }
    EXPECT_EQ(fluid.field("velocity"), velocity) << threads;
    EXPECT_EQ(fluid.field("density"), energy) << threads;
  }
}

/// Fine water, and coarse water behind it, run against a wall that moves: what they lose it receives, in substeps and steps.
TEST_P(LocalSteps, MovingWallReceivesAll) {
  Settings s;
  s.dimension = 2;
  s.lattice.spacing = 0.03;
  s.numerics.threads = 1;
  s.numerics.scheme = GetParam();
  s.numerics.local_steps = true;
  s.bodies = {body("coarse", box(Vec3(0, 0.06, -1), Vec3(0.12, 0.6, 1)), "water-tait"),
              body("side", box(Vec3(0.12, 0, -1), Vec3(0.6, 0.6, 1)), "water-tait"),
              body("fine", box(Vec3(0, 0, -1), Vec3(0.12, 0.06, 1)), "water-tait")};
  s.bodies[2].spacing = 0.01;
  for (Body& one : s.bodies) one.velocity = Vec3(5, -40, 0);
  Fluid fluid(s);
  LinedWall wall;
  for (int row = 0; row < 8; ++row)
    for (int k = -10; k < 70; ++k) wall.position.push_back(Vec3(0.01 * (k + 0.5), -0.01 * (row + 0.5), 0));
  wall.velocity.assign(wall.position.size(), Vec3(0, 10, 0));
  wall.normal.assign(wall.position.size(), Vec3(0, -1, 0));
  wall.volume.assign(wall.position.size(), 1e-4);
  const auto index = fluid.add_wall(wall);
  const Ledger start = fluid.ledger();
  while (fluid.time() < 2e-4) {
    const double dt = fluid.step_limit().step;
    EXPECT_EQ(fluid.fast_bodies(), Names{"fine"});
    for (Vec3& x : fluid.wall(index).position) x[1] += 10 * dt;
    const std::vector<Vec3> shown = fluid.wall(index).position;
    fluid.step(dt);
    EXPECT_EQ(fluid.wall(index).position, shown);
  }
  Vec3 received = Vec3::Zero(), force = Vec3::Zero();
  for (const Vec3& impulse : fluid.wall(index).impulse) received += impulse;
  for (const Vec3& one : fluid.wall_force(index)) force += one;
  const Ledger end = fluid.ledger();
  EXPECT_GT(fluid.substeps(), 2 * fluid.steps());
  EXPECT_LT(received[1], 0.1 * start.momentum[1]);  // it has been struck
  EXPECT_LT(force[1], 0.0);
  EXPECT_LT((end.momentum + received - start.momentum).norm(), 1e-12 * start.momentum.norm());
  EXPECT_NEAR(end.wall_work, 10.0 * received[1], 1e-9 * std::abs(end.wall_work));
  EXPECT_NEAR(total(end) / total(start), 1.0, 5e-3);
}

/// A step that goes wrong in a substep, or in the slow bodies, is not taken: everything is as it was before, to the last digit. A
/// coarse stream meets a fine slab faster than a run may be, or another coarse stream far from the slab.
TEST_P(LocalSteps, RefusedStepLeavesItsStart) {
  for (const bool among_slow : {false, true}) {
    Settings s;
    s.dimension = 1;
    s.lattice.spacing = 0.05;
    s.numerics.scheme = GetParam();
    s.numerics.beta = 2.0;
    s.numerics.threads = 1;
    s.numerics.local_steps = true;
    const double speed = 5.1e6;
    s.bodies = {body("left", box(Vec3(-1, 0, 0), Vec3(-0.2, 0, 0)), "water-tait")};
    if (among_slow) s.bodies.push_back(body("right", box(Vec3(0, 0, 0), Vec3(1, 0, 0)), "water-tait"));
    const double at = among_slow ? 1 : 0;
    s.bodies.push_back(body("slab", box(Vec3(at, 0, 0), Vec3(at + 0.05, 0, 0)), "water-tait"));
    s.bodies.back().spacing = 0.0125;
    for (Body& one : s.bodies) one.velocity = {one.name == "left" ? speed : -speed, 0, 0};
    std::set<bool> outcomes;
    for (double dt = 1e-11; dt < 1e-7; dt *= 1.5) {
      Fluid fluid(s);
      const auto wall = fluid.add_wall(layers_beyond(-1, -1, speed));
      fluid.step(1e-13);
      EXPECT_EQ(fluid.fast_bodies(), Names{"slab"});
      outcomes.insert(refuses(fluid, wall, dt));
    }
    EXPECT_EQ(outcomes, (std::set<bool>{false, true})) << among_slow;
  }
}

/// A sound wave passes from coarse to fine water, without dissipation: the error falls with the square of the step, at three
/// substeps a step throughout.
TEST(LocalStepsInTime, SecondOrder) {
  std::vector<std::vector<Vec3>> velocity;
  std::vector<double> energy;
  const double end = 4e-4, pi = std::numbers::pi;
  long steps = 0;
  for (const int k : {0, 1, 2, 3}) {
    Settings s;
    s.dimension = 1;
    s.lattice.spacing = 1.0 / 64;
    s.numerics.threads = 1;
    s.numerics.scheme = SchemeName::monaghan;
    s.numerics.alpha = s.numerics.beta = 0;
    s.numerics.local_steps = true;
    s.numerics.courant = 0.2 / (1 << k);
    for (const bool fine : {false, true}) {
      Body water =
          body(fine ? "fine" : "coarse", box(Vec3(fine ? 0.9375 : 0, -1, -1), Vec3(fine ? 1 : 0.9375, 1, 1)), "water-tait");
      if (fine) water.spacing = 1.0 / 192;
      const double low = fine ? 0.9375 : 0.0, high = fine ? 1.0 : 0.9375;
      StartField field;
      field.state = [=](const Vec3& x, double) { return StartState{1010.0, 0.0, Vec3(std::sin(pi * x[0]), 0, 0)}; };
      field.mass = 1010.0 * (high - low);
      field.kinetic_energy = 1010.0 / 4 * (high - low - (std::sin(2 * pi * high) - std::sin(2 * pi * low)) / (2 * pi));
      water.start = std::make_shared<StartField>(field);
      s.bodies.push_back(water);
    }
    s.walls = {box_wall(Vec3(0, -9, -9), Vec3(1, 9, 9))};
    Fluid fluid(s);
    const double start = total(fluid.ledger());
    if (k == 0) steps = long(std::ceil(end / (0.9 * fluid.step_limit().step)));
    for (long n = 0; n < steps << k; ++n) fluid.step(end / double(steps << k));
    EXPECT_EQ(fluid.fast_bodies(), Names{"fine"});
    EXPECT_EQ(fluid.substeps(), 3 * fluid.steps());
    velocity.push_back(by_id(fluid, "velocity"));
    energy.push_back(std::abs(total(fluid.ledger()) - start));
  }
  const auto distance = [](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / double(a.size()));
  };
  const double coarse = std::log2(distance(velocity[0], velocity[1]) / distance(velocity[1], velocity[2])),
               fine = std::log2(distance(velocity[1], velocity[2]) / distance(velocity[2], velocity[3]));
  RecordProperty("orders", std::to_string(coarse) + " " + std::to_string(fine));
  EXPECT_GT(coarse, 1.7);
  EXPECT_GT(fine, 1.9);
  EXPECT_GT(std::log2(energy[2] / energy[3]), 1.9);
}

}  // namespace
}  // namespace undex::sph::testing
