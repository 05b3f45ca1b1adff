// Rigid bodies in water: what crosses between both, exact flows, and what is refused.
#include "coupling/flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/errors.hpp"
#include "core/mass_properties.hpp"

namespace undex::coupling::testing {
namespace {

using std::numbers::pi;

sph::Settings water(int dimension, double spacing, const Primitive& extent, const std::vector<Obstacle>& obstacles) {
  sph::Settings s;
  s.dimension = dimension;
  s.lattice.spacing = spacing;
  sph::Body& body = s.bodies.emplace_back();
  body.name = "water";
  body.shape.base = extent;
  for (const Obstacle& obstacle : obstacles) body.shape.removed.push_back(obstacle.shape);
  body.material = materials::find_fluid("water-tait").value();
  s.numerics.threads = 1;
  return s;
}

sph::Wall wall_of(const Primitive& container, const std::vector<std::string>& faces) {
  sph::Wall wall{.name = "tank", .container = container, .faces = {}};
  for (const std::string& face : faces) wall.faces[face] = sph::FaceCondition::free_slip;
  return wall;
}

Obstacle obstacle_of(const Primitive& shape, Motion motion, double density = 1000) {
  Obstacle one;
  one.name = "body";
  one.shape = shape;
  one.motion = motion;
  if (motion == Motion::free) one.density = density;
  return one;
}

struct Scene {
  sph::Fluid fluid;
  Flow flow;
  Scene(const sph::Settings& settings, const std::vector<Obstacle>& obstacles) : fluid(settings), flow(fluid, obstacles) {}

  void run(double end, double largest = 1.0) {
    while (flow.time() < end * (1 - 1e-12)) flow.step(std::min({flow.step_limit().step, end - flow.time(), largest}));
  }
  const RigidObstacle& body() const { return flow.obstacles()[0]; }
  Vec3 momentum() const { return fluid.ledger().momentum + body().ledger().momentum; }
  double energy() const {
    const sph::Ledger l = fluid.ledger();
    const ObstacleLedger o = body().ledger();
    return l.kinetic + l.internal + l.dissipated + o.kinetic - o.external - o.gravity - l.gravity;
  }
};

/// Velocity behind a shock of pressure p into water of Tait's law at rest (p_0 + B (rho/rho0)^N): the jump conditions.
double speed_behind_shock(const materials::FluidLaw& law, double rho0, double p) {
  const double rho = materials::density_at(law, p, 0.0);
  return std::sqrt(p * (1 / rho0 - 1 / rho));
}

TEST(Obstacles, APistonDrivesTheExactShockInOneDimension) {
  for (const double pressure : {10e6, 1e9}) {
    Obstacle piston = obstacle_of(Box{{-0.5, 0, 0}, {0, 1, 1}}, Motion::prescribed);
    sph::Settings s = water(1, 0.005, Box{{0, 0, 0}, {1, 1, 1}}, {});
    const materials::Fluid& law = s.bodies[0].material;
    piston.time = {0.0};
    piston.speed = {speed_behind_shock(law.law, law.rho0, pressure)};
    piston.direction = Vec3::UnitX();
    Scene scene(s, {piston});
    const double start = scene.energy();
    scene.run(3e-4);
    const double x = scene.body().body().center()[0] + 0.25;
    EXPECT_NEAR(x, 3e-4 * piston.speed[0], 1e-12);
    EXPECT_NEAR(scene.fluid.at(Vec3(x + 0.1, 0, 0)).pressure, pressure, 0.005 * pressure);
    EXPECT_NEAR(scene.body().state().force[0], -pressure, 0.005 * pressure);
    EXPECT_LT(std::abs(scene.energy() - start), 0.005 * scene.body().ledger().external);
    EXPECT_GT(scene.body().ledger().external, 0.0);
  }
}

TEST(Obstacles, WaterAndAFreeBodyKeepMomentumAndEnergy) {
  Obstacle ball = obstacle_of(Sphere{{0, 0, 0}, 0.1}, Motion::free, 500);
  ball.velocity = Vec3(3, 1, -2);
  sph::Settings s = water(3, 0.025, Box{{-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25}}, {ball});
  Scene scene(s, {ball});
  const Vec3 start = scene.momentum();
  const double energy = scene.energy(), given = scene.body().ledger().kinetic;
  scene.run(1e-4);
  EXPECT_LT((scene.momentum() - start).norm(), 1e-12 * start.norm());
  EXPECT_LT(std::abs(scene.energy() - energy), 0.02 * given);
  // Slip gives a ball no moment.
  EXPECT_LT(scene.body().ledger().turning.norm(), 1e-3 * scene.body().ledger().exchanged * 0.1);
  EXPECT_LT(scene.body().body().velocity().norm(), 3.5);
}

TEST(Obstacles, RestUnderPressureIsRest) {
  const Primitive shapes[] = {Sphere{{0, 0, 0}, 0.1}, Cylinder{2, {0, 0, 0}, 0.1, -0.1, 0.1},
                              Box{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}};
  for (const Primitive& shape : shapes) {
    const Obstacle fixed = obstacle_of(shape, Motion::fixed);
    const Box tank{{0, 0, 0}, {0.25, 0.25, 0.25}};
    sph::Settings s = water(3, 0.0125, tank, {fixed});
    s.bodies[0].pressure = 10e6;
    s.symmetry.axis = {true, true, true};
    s.walls = {wall_of(tank, {"x_high", "y_high", "z_high"})};
    Scene scene(s, {fixed});
    scene.run(5e-5);
    const auto p = scene.fluid.field("pressure");
    double mean = 0, worst = 0;
    for (const double each : p) mean += each / double(p.size()), worst = std::max(worst, std::abs(each - 10e6));
    RecordProperty("mean", std::to_string(mean));
    std::printf("%s: mean %.4f MPa, worst %.4f MPa, speed %.3f m/s\n", std::visit([](auto& x) { return x.name; }, shape),
                mean * 1e-6, worst * 1e-6, scene.fluid.maximum_speed());
    EXPECT_NEAR(mean, 10e6, 0.1e6);
  }
}

TEST(Obstacles, ALightBodyIsStable) {
  Obstacle disc = obstacle_of(Sphere{{0, 0, 0}, 0.1}, Motion::free, 20);
  sph::Settings s = water(2, 0.02, Box{{-0.3, -0.3, 0}, {0.3, 0.3, 0}}, {disc});
  s.bodies[0].pressure = 1e5;
  const Box tank{{-0.3, -0.3, -1}, {0.3, 0.3, 1}};
  s.walls = {wall_of(tank, {"x_low", "x_high", "y_low", "y_high"})};
  disc.velocity = Vec3(5, 0, 0);
  Scene scene(s, {disc});
  const double start = scene.energy(), given = scene.body().ledger().kinetic;
  scene.run(2e-4);
  EXPECT_LT(scene.body().body().velocity().norm(), 5.0);
  EXPECT_LT(std::abs(scene.energy() - start), 0.1 * given);
}

/// Velocity over F a/(m_f c) of a free ball of radius a and mu times the mass m_f of the water that it displaces, a force F acting
/// from time zero on, at tau = c t/a. In Laplace's domain the water answers with m_f s U (1 + s)/(2 + 2 s + s^2) (a dipole in sound,
/// s in c/a): half of m_f in the end, rho c per area at first.
double ball_under_force(double mu, double tau) {
  using Complex = std::complex<double>;
  const double b = 2 * mu + 1;
  const Complex root = std::sqrt(Complex(b * b - 4 * mu * b));
  Complex v = 2 / b * tau;
  for (const Complex s : {(-b + root) / (2 * mu), (-b - root) / (2 * mu)})
    v += (2.0 + 2.0 * s + s * s) / (s * s * (2 * mu * s + b)) * std::exp(s * tau);
  return v.real();
}

TEST(Obstacles, ABallUnderAForceHasTheAddedMassOfTheExactSolution) {
  // In its meridian; nothing comes back from the walls until tau = 6.
  const double a = 0.1, length = 0.4, pressure = 10e6;
  for (const double mu : {0.2, 2.7}) {
    Obstacle ball = obstacle_of(Sphere{{0, 0, 0}, a}, Motion::free, 1000 * mu);
    const Box tank{{-length, -length, -1}, {length, length, 1}};
    sph::Settings s = water(2, 0.01, tank, {ball});
    s.axisymmetric = true;
    s.symmetry.axis = {true, false, false};
    s.bodies[0].pressure = pressure;
    s.walls = {wall_of(tank, {"x_high", "y_low", "y_high"})};
    const double rho = sph::start_density(s.bodies[0]);
    const double c = std::visit([&](const auto& law) { return law.evaluate(rho, 0.0).sound_speed; }, s.bodies[0].material.law);
    const double displaced = rho * 4 / 3 * pi * a * a * a, unit = a / (displaced * c), force = 0.5 / unit;
    ball.time = {0};
    ball.force = {force};
    ball.direction = Vec3::UnitY();
    ball.density = rho * mu;
    Scene scene(s, {ball});
    const double start = scene.energy();
    for (const double tau : {0.5, 1.0, 2.0, 3.0, 4.0, 5.0}) {
      scene.run(tau * a / c);
      const double speed = scene.body().body().velocity()[1], exact = force * unit * ball_under_force(mu, tau);
      std::printf("mu %.1f tau %.1f: %.4f of %.4f\n", mu, tau, speed, exact);
      EXPECT_NEAR(speed, exact, (tau < 2 ? 0.06 : 0.03) * exact);
    }
    EXPECT_LT(std::abs(scene.energy() - start), 0.05 * scene.body().ledger().kinetic);
  }
}

TEST(Obstacles, AStreamThatAcceleratesPastAFixedBallPushesWithItsAddedMass) {
  // The water falls as a whole, and is seen from a frame that falls with it: no weight, the ball accelerates. A quarter in space.
  const double a = 0.1, length = 0.35, g = 2000;
  Obstacle ball = obstacle_of(Sphere{{0, 0, 0}, a}, Motion::fixed);
  const Box tank{{-length, -length, -length}, {length, length, length}};
  sph::Settings s = water(3, 0.025, tank, {ball});
  s.symmetry.axis = {true, true, false};
  s.bodies[0].pressure = 10e6;
  s.gravity = Vec3(0, 0, g);
  s.walls = {wall_of(tank, {"x_high", "y_high"})};
  Scene scene(s, {ball});
  const double rho = sph::start_density(s.bodies[0]);
  const double c = std::visit([&](const auto& law) { return law.evaluate(rho, 0.0).sound_speed; }, s.bodies[0].material.law);
  const double displaced = rho * 4 / 3 * pi * a * a * a;
  scene.run(1.5 * a / c);
  const double before = scene.body().state().impulse[2];
  const double tau = scene.flow.time() * c / a;
  // The integral of half of 1 + exp(-t) (sin t - cos t).
  const double exact = displaced * g * a / c * 0.5 * (tau - std::exp(-tau) * std::sin(tau));
  std::printf("impulse %.4f of %.4f\n", before, exact);
  EXPECT_NEAR(before, exact, 0.05 * exact);
}

TEST(Obstacles, GravityLiftsABuoyantBodyAsItsAddedMassSays) {
  // Of a cylinder in the plane the added mass is that of the water that it displaces.
  const double g = 10, low = 500;
  Obstacle disc = obstacle_of(Sphere{{0, 0, 0}, 0.1}, Motion::free, low);
  disc.fixed = {"x"};
  sph::Settings s = water(2, 0.02, Sphere{{0, 0, 0}, 0.8}, {disc});
  s.gravity = Vec3(0, -g, 0);
  s.bodies[0].pressure = 1e6;
  s.bodies[0].level = Vec3::Zero();
  s.walls = {wall_of(Sphere{{0, 0, 0}, 0.8}, {"side"})};
  Scene scene(s, {disc});
  scene.run(4e-3);
  std::printf("a/exact %.4f\n", scene.body().body().velocity()[1] / 4e-3 / (g * (1000 - low) / (1000 + low)));
}

TEST(Obstacles, TurningByItselfASquareKeepsItsSpinInGas) {
  // Two halves of a scene, mirrored: a plane halves the body, locks what a mirror would turn round, and gives the same motion.
  Obstacle disc = obstacle_of(Sphere{{0, 0, 0}, 0.1}, Motion::free, 2000);
  disc.velocity = Vec3(4, 0, 0);
  std::vector<double> speed;
  for (const bool halved : {false, true}) {
    sph::Settings s = water(2, 0.02, Box{{-0.3, -0.3, 0}, {0.3, 0.3, 0}}, {disc});
    s.symmetry.axis[1] = halved;
    Scene scene(s, {disc});
    scene.run(5e-5, 1e-6);
    speed.push_back(scene.body().body().velocity()[0]);
    EXPECT_NEAR(scene.body().state().velocity[1], 0.0, 1e-9);
  }
  EXPECT_NEAR(speed[0], speed[1], 1e-6 * speed[0]);
}

TEST(Obstacles, WhatCannotStandIsRefused) {
  const Box tank{{0, 0, 0}, {1, 1, 1}};
  sph::Settings s = water(3, 0.05, tank, {});
  s.walls = {wall_of(tank, {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"})};
  sph::Fluid fluid(s);
  const auto refused = [&](const Obstacle& one) {
    try {
      Flow(fluid, {one});
    } catch (const std::invalid_argument& why) {
      return std::string(why.what());
    }
    return std::string();
  };
  EXPECT_NE(refused(obstacle_of(Sphere{{0.1, 0.5, 0.5}, 0.2}, Motion::fixed)).find("beyond the walls"), std::string::npos);
  EXPECT_NE(refused(obstacle_of(Box{{0.3, 0.3, 0}, {0.6, 0.6, 0.4}}, Motion::free)).find("may part from it"), std::string::npos);
  EXPECT_EQ(refused(obstacle_of(Box{{0.3, 0.3, 0}, {0.6, 0.6, 0.4}}, Motion::fixed)), "");
  Obstacle slides = obstacle_of(Box{{0.3, 0.3, 0}, {0.6, 0.6, 0.4}}, Motion::free);
  slides.fixed = {"z", "rx", "ry"};
  EXPECT_EQ(refused(slides), "");
}

TEST(Obstacles, ARunEndsWhereBodiesMeet) {
  Obstacle ram = obstacle_of(Box{{-0.2, 0, 0}, {0, 1, 1}}, Motion::prescribed);
  ram.time = {0};
  ram.speed = {100};
  ram.direction = Vec3::UnitX();
  sph::Settings s = water(1, 0.02, Box{{0, 0, 0}, {0.1, 1, 1}}, {});
  s.walls = {wall_of(Box{{-1, 0, 0}, {0.1, 1, 1}}, {"x_high"})};
  Scene scene(s, {ram});
  EXPECT_THROW(scene.run(2e-3), NumericalStop);
  EXPECT_LT(scene.body().body().center()[0] + 0.1, 0.1);
}

}  // namespace
}  // namespace undex::coupling::testing
