// Fluid at rest beside walls, moving walls, and symmetry planes.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "scenes.hpp"

namespace undex::sph::testing {
namespace {

/// Largest acceleration in the first instant, in units of p/(rho dx), of the particles that `chosen` picks.
double restlessness(const Settings& settings, double pressure, const std::function<bool(const Vec3&)>& chosen) {
  Fluid fluid(settings);
  const double dt = 1e-4 * fluid.step_limit().step;
  const std::vector<Vec3> start = by_id(fluid, "position");
  fluid.step(dt);
  const std::vector<Vec3> v = by_id(fluid, "velocity");
  double largest = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (chosen(start[i])) largest = std::max(largest, v[i].norm() / dt);
  return largest / (pressure / 1000.0 / settings.lattice.spacing);
}

Settings pressurised(int dimension, const Shape& shape, const Wall& wall) {
  Settings settings;
  settings.dimension = dimension;
  settings.lattice.spacing = 0.05;
  settings.bodies = {body("water", shape, "water-tait")};
  settings.bodies[0].pressure = 1e8;
  settings.walls = {wall};
  settings.numerics.threads = 1;
  return settings;
}

/// Water under uniform pressure fills a box: walls continue the lattice, in edges and corners too, so nothing moves.
TEST(Walls, PressurisedBoxIsAtRest) {
  for (const SchemeName scheme : {SchemeName::monaghan, SchemeName::riemann})
    for (int d = 1; d <= 3; ++d)
      for (const FaceCondition condition : {FaceCondition::free_slip, FaceCondition::no_slip}) {
        const Vec3 low(-0.25, -0.3, -0.4), high(0.25, 0.3, 0.4);
        Settings settings = pressurised(d, box(low, high), box_wall(low, high, condition));
        settings.numerics.scheme = scheme;
        EXPECT_LT(restlessness(settings, 1e8, [&](const Vec3&) { return true; }), 1e-7) << d << "D";
      }
}

/// In the plane a cylinder along an axis of it is a strip, with plane sides and ends.
TEST(Walls, PressurisedStripIsAtRest) {
  for (const FaceCondition condition : {FaceCondition::free_slip, FaceCondition::no_slip}) {
    const Cylinder strip{.axis = 0, .center = Vec3::Zero(), .radius = 0.3, .low = -0.25, .high = 0.25};
    Wall wall;
    wall.name = "strip";
    wall.container = strip;
    wall.faces = {{"side", condition}, {"low", condition}, {"high", condition}};
    EXPECT_LT(restlessness(pressurised(2, Shape{strip, {}}, wall), 1e8, [](const Vec3&) { return true; }), 1e-7);
  }
}

/// In a cylinder: rings at the wall are quiet, a Cartesian lattice cut by the wall is not.
TEST(Walls, PressurisedCylinder) {
  const Cylinder cylinder{2, Vec3::Zero(), 0.5, -9, 9};
  Wall wall;
  wall.name = "side";
  wall.container = cylinder;
  wall.faces = {{"side", FaceCondition::free_slip}};
  Settings settings = pressurised(2, Shape{cylinder, {}}, wall);
  settings.lattice.fit = "water";
  settings.lattice.type = LatticeType::rings;
  const double quiet = restlessness(settings, 1e8, [](const Vec3&) { return true; });
  settings.lattice.type = LatticeType::cartesian;
  const double rough = restlessness(settings, 1e8, [](const Vec3&) { return true; });
  RecordProperty("rings", std::to_string(quiet));
  RecordProperty("cartesian", std::to_string(rough));
  EXPECT_LT(quiet, 0.15);
  EXPECT_LT(quiet, rough);
}

TEST(Walls, OpenFaceLetsGo) {
  const Vec3 low(0, -9, -9), high(1, 9, 9);
  Settings settings = pressurised(1, box(low, high), box_wall(low, high));
  settings.walls[0].faces["x_high"] = FaceCondition::open;
  settings.lattice.spacing = 0.02;
  Fluid fluid(settings);
  while (fluid.time() < 2e-4) fluid.step(fluid.step_limit().step);
  const std::vector<Vec3> v = by_id(fluid, "velocity");
  EXPECT_NEAR(v.front()[0], 0.0, 2.0);
  // Rarefied to nothing, water at 1e8 Pa leaves at about p/(rho c) for each of incoming and outgoing wave.
  EXPECT_GT(v.back()[0], 60.0);
  EXPECT_LT(v.back()[0], 200.0);
}

/// A piston into water: the wall takes the impulse that the fluid loses, and its work is the energy that the fluid gets.
TEST(Walls, PistonBooksImpulseAndWork) {
  for (const SchemeName scheme : {SchemeName::monaghan, SchemeName::riemann})
    for (const bool slip : {true, false}) {
      Settings settings;
      settings.dimension = 2;
      settings.numerics.scheme = scheme;
      settings.lattice.spacing = 0.05;
      settings.bodies = {body("water", box(Vec3(0, 0, 0), Vec3(1, 0.4, 1)), "water-tait")};
      settings.numerics.threads = 1;
      Fluid fluid(settings);
      LinedWall piston;
      piston.free_slip = slip;
      for (int i = 0; i < 3; ++i)
        for (int j = -3; j < 11; ++j) {
          piston.position.push_back({-0.05 * (i + 0.5), 0.05 * (j + 0.5), 0});
          piston.velocity.push_back({10, slip ? 0.0 : 3.0, 0});
          piston.normal.push_back({-1, 0, 0});
          piston.volume.push_back(0.05 * 0.05);
        }
      const auto index = fluid.add_wall(piston);
      const Ledger start = fluid.ledger();
      for (int k = 0; k < 40; ++k) {
        const double dt = fluid.step_limit().step;
        for (std::size_t q = 0; q < piston.position.size(); ++q) fluid.wall(index).position[q] += dt * piston.velocity[q];
        fluid.step(dt);
      }
      const Ledger end = fluid.ledger();
      Vec3 impulse = Vec3::Zero();
      for (const Vec3& one : fluid.wall(index).impulse) impulse += one;
      const Vec3 gained = end.momentum - start.momentum;
      EXPECT_LT((impulse + gained).norm(), 1e-12 * gained.norm());
      EXPECT_GT(gained[0], 0.0);
      // A wall of one velocity: its work is impulse times velocity.
      EXPECT_NEAR(end.wall_work, impulse.dot(piston.velocity[0]), 1e-12 * std::abs(end.wall_work));
      const double before = start.kinetic + start.internal + start.dissipated;
      const double after = end.kinetic + end.internal + end.dissipated + end.wall_work;
      // The integrator's error: measured 5e-3 of the work at the default Courant number, a jump in velocity at the start.
      EXPECT_LT(std::abs(after - before), 1e-2 * std::abs(end.wall_work)) << "slip " << slip;
    }
}

/// The wall's slip decides whether it drags the fluid along.
TEST(Walls, OnlyNoSlipDrags) {
  for (const bool slip : {true, false}) {
    Settings settings;
    settings.dimension = 2;
    settings.numerics.scheme = SchemeName::monaghan;
    settings.lattice.spacing = 0.1;
    settings.bodies = {body("water", box(Vec3(0, 0, 0), Vec3(1, 0.6, 1)), "water-tait")};
    settings.bodies[0].pressure = 1e8;
    settings.numerics.threads = 1;
    Fluid fluid(settings);
    LinedWall belt;
    belt.free_slip = slip;
    for (int i = -4; i < 14; ++i)
      for (int j = 0; j < 3; ++j) {
        belt.position.push_back({0.1 * (i + 0.5), -0.1 * (j + 0.5), 0});
        belt.velocity.push_back({50, 0, 0});
        belt.normal.push_back({0, -1, 0});
        belt.volume.push_back(0.01);
      }
    const auto index = fluid.add_wall(belt);
    fluid.step(0.2 * fluid.step_limit().step);
    Vec3 impulse = Vec3::Zero();
    for (const Vec3& one : fluid.wall(index).impulse) impulse += one;
    EXPECT_LT(impulse[1], 0.0);
    if (slip) {
      EXPECT_EQ(impulse[0], 0.0);
    } else {
      EXPECT_LT(impulse[0], 0.0);
    }
  }
}

// ---- Symmetry ------------------------------------------------------------------------------------------------------

Settings ball_in_box(bool octant, SchemeName scheme) {
  Settings settings;
  settings.lattice.spacing = 0.05;
  const Sphere ball{Vec3::Zero(), 0.14};
  const Vec3 low(-0.3, -0.3, -0.3), high(0.3, 0.3, 0.3);
  settings.bodies = {body("water", Shape{Box{low, high}, {ball}}, "water-tait"), body("bubble", Shape{ball, {}}, "bubble-gas")};
  settings.bodies[1].variable_h = true;
  settings.bodies[1].split = 64;
  settings.walls = {box_wall(low, high)};
  settings.walls[0].faces["z_low"] = settings.walls[0].faces["z_high"] = FaceCondition::open;
  settings.symmetry.axis = {octant, octant, octant};
  settings.numerics.scheme = scheme;
  settings.numerics.threads = 2;
  return settings;
}

/// An octant is the same computation as the whole, particle for particle.
TEST(Symmetry, OctantIsTheFullRun) {
  for (const SchemeName scheme : {SchemeName::monaghan, SchemeName::riemann}) {
    const bool rounds = scheme == SchemeName::riemann;  // its gradients are single precision, and round differently in the mirror
    Fluid octant(ball_in_box(true, scheme)), full(ball_in_box(false, scheme));
    ASSERT_EQ(8 * octant.particle_count(), full.particle_count());
    for (int k = 0; k < 15; ++k) {
      const double dt = octant.step_limit().step;
      EXPECT_NEAR(full.step_limit().step, dt, (rounds ? 1e-8 : 1e-9) * dt);  // shorter by the closing speeds
      octant.step(dt);
      full.step(dt);
    }
    const std::vector<Vec3> x = by_id(octant, "position"), v = by_id(octant, "velocity");
    const std::vector<Vec3> X = by_id(full, "position"), V = by_id(full, "velocity");
    const double fastest = octant.maximum_speed();
    ASSERT_GT(fastest, 50.0);
    ASSERT_EQ(8 * x.size(), X.size());
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto partner = std::min_element(
          X.begin(), X.end(), [&](const Vec3& a, const Vec3& b) { return (a - x[i]).squaredNorm() < (b - x[i]).squaredNorm(); });
      EXPECT_LT((x[i] - *partner).norm(), 1e-10);
      worst = std::max(worst, (v[i] - V[partner - X.begin()]).norm() / fastest);
    }
    EXPECT_LT(worst, rounds ? 1e-6 : 1e-9);
    const Ledger a = octant.ledger(), b = full.ledger();
    EXPECT_NEAR(8 * a.kinetic, b.kinetic, 1e-6 * b.kinetic);
    EXPECT_NEAR(8 * a.mass, b.mass, 2e-5 * b.mass);
  }
}

/// A body thrown at a symmetry plane is one of two that collide.
TEST(Symmetry, PlaneIsACollision) {
  const auto scene = [](bool plane) {
    Settings settings;
    settings.dimension = 1;
    settings.lattice.spacing = 0.01;
    settings.bodies = {body("right", box(Vec3(0, 0, 0), Vec3(1, 1, 1)), "water-tait")};
    settings.bodies[0].velocity = {-40, 0, 0};
    if (!plane) {
      settings.bodies.push_back(body("left", box(Vec3(-1, 0, 0), Vec3(0, 1, 1)), "water-tait"));
      settings.bodies[1].velocity = {40, 0, 0};
    }
    settings.symmetry.axis[0] = plane;
    settings.numerics.threads = 1;
    return settings;
  };
  Fluid half(scene(true)), both(scene(false));
  ASSERT_EQ(2 * half.particle_count(), both.particle_count());
  for (int k = 0; k < 200; ++k) {
    half.step(1e-6);
    both.step(1e-6);
  }
  const std::vector<Vec3> x = by_id(half, "position"), X = by_id(both, "position");
  const std::vector<Vec3> v = by_id(half, "velocity"), V = by_id(both, "velocity");
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(x[i][0], X[i][0], 1e-11);
    EXPECT_NEAR(v[i][0], V[i][0], 1e-8);
    EXPECT_NEAR(X[i][0], -X[2 * n - 1 - i][0], 1e-11);
  }
  // Water hammer: rho c v, with Tait's stiffening a little more.
  EXPECT_NEAR(half.maximum_pressure(), 1000 * 1538.4 * 40, 0.25 * 1000 * 1538.4 * 40);
}

}  // namespace
}  // namespace undex::sph::testing
