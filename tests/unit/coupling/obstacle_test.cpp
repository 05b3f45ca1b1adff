// Rigid bodies in water: what crosses between both, exact flows, and what is refused.
#include "coupling/flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/errors.hpp"
#include "core/closed_surface.hpp"
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
    scene.run(1e-4);
    const double early = scene.body().state().impulse[0];
    scene.run(3e-4);
    const double x = scene.body().body().center()[0] + 0.25;
    EXPECT_NEAR(x, 3e-4 * piston.speed[0], 1e-12);
    EXPECT_NEAR(scene.fluid.at(Vec3(x + 0.1, 0, 0)).pressure, pressure, 0.005 * pressure);
    EXPECT_NEAR((scene.body().state().impulse[0] - early) / 2e-4, -pressure, 0.005 * pressure);
    EXPECT_LT(std::abs(scene.energy() - start), 0.005 * scene.body().ledger().external);
    EXPECT_GT(scene.body().ledger().external, 0.0);
  }
}

/// Water under one pressure shows it on every face of a box's surface, those at edges and corners included; in a plane and in
/// a meridian too. The surface moves with its body.
TEST(Obstacles, SurfacesShowPlacesMotionAndPressure) {
  struct Kind {
    int dimension;
    bool ring;
    Primitive shape, extent;
  };
  const Box box{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}, sea{{-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25}};
  for (const Kind& kind : {Kind{3, false, box, sea}, {2, false, box, sea}, {2, true, box, sea}}) {
    Obstacle one = obstacle_of(kind.shape, Motion::prescribed);
    one.direction = Vec3::UnitY();
    one.time = {0.0};
    one.speed = {2.0};
    sph::Settings s = water(kind.dimension, 0.025, kind.extent, {one});
    s.bodies[0].pressure = 1e6;
    s.axisymmetric = kind.ring;
    s.symmetry.axis[0] = kind.ring;
    std::vector<std::string> faces{"x_low", "x_high", "y_low", "y_high"};
    if (kind.dimension == 3) faces.insert(faces.end(), {"z_low", "z_high"});
    s.walls = {wall_of(kind.extent, faces)};
    Scene scene(s, {one});
    scene.flow.step_limit();  // forces are found
    const BodySnapshot start = scene.flow.snapshot();
    ASSERT_EQ(start.position.size(), scene.body().surface().nodes.size());
    ASSERT_EQ(start.cells.size(), scene.body().surface().faces.size());
    ASSERT_EQ(start.of_cells.size(), 2u);
    const std::vector<double>& pressure = start.of_cells[0].values;
    const double close = kind.ring ? 0.15e6 : 0.1e6;  // of the rings on the axis
    double least = 1e300, most = 0;
    for (const double p : pressure) least = std::min(least, p), most = std::max(most, p);
    EXPECT_NEAR(least, 1e6, close) << kind.dimension << kind.ring;
    EXPECT_NEAR(most, 1e6, close) << kind.dimension << kind.ring;
    EXPECT_EQ(start.of_cells[1].values, std::vector<double>(start.cells.size(), 0.0));
    scene.run(1e-6);
    const BodySnapshot later = scene.flow.snapshot();
    for (std::size_t n = 0; n < later.position.size(); ++n) {
      EXPECT_NEAR(later.position[n][1] - start.position[n][1], 2e-6, 1e-15);
      EXPECT_NEAR(later.of_points[0].values[3 * n + 1], 2e-6, 1e-15);
      EXPECT_EQ(later.of_points[1].values[3 * n + 1], 2.0);
    }
  }
}

/// A box with a hole is a wall about what it holds: of its two surfaces the outer one meets no fluid. It does where the fluid is
/// on both sides, or the hole has a mouth.
TEST(Obstacles, TheOutsideOfAWallIsLeftOut) {
  const Primitive ball = Sphere{Vec3::Zero(), 0.05}, around = Box{Vec3::Constant(-0.08), Vec3::Constant(0.08)};
  const Obstacle wall = obstacle_of(Difference{{around, ball}}, Motion::fixed);
  const auto area_of = [](const WetSurface& surface) {
    double sum = 0;
    for (const auto& face : surface.faces) sum += face_area(face, surface.nodes);
    return sum;
  };
  const double inner = 4 * pi * 0.05 * 0.05, outer = 6 * 0.16 * 0.16;
  sph::Settings settings = water(3, 0.01, ball, {});
  const RigidObstacle alone(wall, settings);
  EXPECT_NEAR(area_of(alone.surface()) / inner, 1.0, 0.02);
  settings.symmetry.axis = {true, false, true};
  EXPECT_NEAR(area_of(RigidObstacle(wall, settings).surface()) / (inner / 4), 1.0, 0.02);

  const sph::Settings both = water(3, 0.01, Box{Vec3::Constant(-0.12), Vec3::Constant(0.12)}, {wall});
  EXPECT_NEAR(area_of(RigidObstacle(wall, both).surface()) / (inner + outer), 1.0, 0.02);

  const Primitive mouth = Cylinder{2, Vec3::Zero(), 0.02, 0.0, 0.09};
  const Obstacle bottle = obstacle_of(Difference{{around, ball, mouth}}, Motion::fixed);
  EXPECT_GT(area_of(RigidObstacle(bottle, water(3, 0.01, ball, {})).surface()), 0.9 * (inner + outer));
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

TEST(Obstacles, RestUnderPressureIsNearlyRestAtTheEdgesToo) {
  // Of a box that the lattice fits only the edges are out of balance.
  const Obstacle fixed = obstacle_of(Box{{-0.1, -0.1, -1}, {0.1, 0.1, 1}}, Motion::fixed);
  const Box tank{{0, 0, -1}, {0.3, 0.3, 1}};
  sph::Settings s = water(2, 0.0125, tank, {fixed});
  s.bodies[0].pressure = 10e6;
  s.symmetry.axis = {true, true, false};
  s.walls = {wall_of(tank, {"x_high", "y_high"})};
  Scene scene(s, {fixed});
  scene.run(1e-4);
  const auto p = scene.fluid.field("pressure");
  double mean = 0, worst = 0;
  for (const double each : p) mean += each / double(p.size()), worst = std::max(worst, std::abs(each - 10e6));
  EXPECT_NEAR(mean, 10e6, 0.015 * 10e6);
  EXPECT_LT(worst, 0.2 * 10e6);
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

/// Velocity over F a/(m_f c), at tau = c t/a, of a free ball of radius a and mu times the mass m_f of the water that it
/// displaces, a force F acting from time zero on. In Laplace's domain the water answers with m_f s U (1 + s)/(2 + 2 s + s^2)
/// (a dipole in sound, s in c/a): half of m_f in the end, rho c per area at first.
double ball_under_force(double mu, double tau) {
  using Complex = std::complex<double>;
  const double b = 2 * mu + 1;
  const Complex root = std::sqrt(Complex(b * b - 4 * mu * b));
  Complex v = 2 / b * tau;
  for (const Complex s : {(-b + root) / (2 * mu), (-b - root) / (2 * mu)})
    v += (2.0 + 2.0 * s + s * s) / (s * s * (2 * mu * s + b)) * std::exp(s * tau);
  return v.real();
}

/// A ball of radius 0.1 m in its meridian, in water under a pressure; walls round it and, where `closed`, at both ends.
struct InMeridian {
  double rho, c, displaced;
  Scene scene;

  static sph::Settings settings(double length, double spacing, double pressure, double gravity, bool closed,
                                const Obstacle& ball) {
    const Box tank{{-0.35, -length, -1}, {0.35, length, 1}};
    sph::Settings s = water(2, spacing, tank, {ball});
    s.axisymmetric = true;
    s.symmetry.axis = {true, false, false};
    s.gravity = Vec3(0, gravity, 0);
    s.bodies[0].pressure = pressure;
    s.walls = {wall_of(tank, {"x_high"})};
    if (closed) s.walls = {wall_of(tank, {"x_high", "y_low", "y_high"})};
    if (closed && gravity != 0) s.bodies[0].level = Vec3::Zero();
    return s;
  }
  explicit InMeridian(const sph::Settings& s, const Obstacle& ball) : scene(s, {ball}) {
    const materials::FluidLaw& law = s.bodies[0].material.law;
    rho = materials::density_at(law, *s.bodies[0].pressure, 0.0);
    c = std::visit([&](const auto& each) { return each.evaluate(rho, 0.0).sound_speed; }, law);
    displaced = rho * 4 / 3 * pi * 1e-3;
  }
  void run(double tau) { scene.run(tau * 0.1 / c); }
};

TEST(Obstacles, ABallUnderAForceHasTheAddedMassOfTheExactSolution) {
  // Nothing comes back from the walls until tau = 5. At first the water's answer comes late by about a spacing over c, by which a
  // light ball is ahead.
  for (const double mu : {0.2, 2.7}) {
    Obstacle ball = obstacle_of(Sphere{{0, 0, 0}, 0.1}, Motion::free);
    const sph::Settings s = InMeridian::settings(0.4, 0.01, 10e6, 0, true, ball);
    const double rho = materials::density_at(s.bodies[0].material.law, 10e6, 0.0), force = 5e4;
    ball.density = rho * mu;
    ball.time = {0};
    ball.force = {force};
    ball.direction = Vec3::UnitY();
    InMeridian flow(s, ball);
    const double unit = 0.1 / (flow.displaced * flow.c), start = flow.scene.energy();
    for (const double tau : {2.0, 3.0, 4.0, 5.0}) {
      flow.run(tau);
      const double speed = flow.scene.body().body().velocity()[1], exact = force * unit * ball_under_force(mu, tau);
      EXPECT_NEAR(speed, exact, 0.03 * exact);
    }
    EXPECT_LT(std::abs(flow.scene.energy() - start), 0.05 * flow.scene.body().ledger().kinetic);
  }
}

TEST(Obstacles, AStreamThatAcceleratesPastAFixedBallPushesWithItsAddedMass) {
  // The water falls as a whole, its ends free, and is seen from a frame that falls with it: no weight, the ball accelerates. The
  // force is half of m_f g (1 + exp(-t) (sin t - cos t)); the ends are felt at tau = 5.
  const double g = 2000;
  const Obstacle ball = obstacle_of(Sphere{{0, 0, 0}, 0.1}, Motion::fixed);
  InMeridian flow(InMeridian::settings(0.6, 0.0125, 10e6, g, false, ball), ball);
  const auto exact = [](double tau) { return 0.5 * (tau - std::exp(-tau) * std::sin(tau)); };
  flow.run(2.0);
  const double before = flow.scene.body().state().impulse[1];
  flow.run(4.8);
  const double given = flow.scene.body().state().impulse[1] - before, unit = flow.displaced * g * 0.1 / flow.c;
  EXPECT_NEAR(given, unit * (exact(4.8) - exact(2.0)), 0.03 * given);
}

TEST(Obstacles, GravityLiftsABuoyantBallAsItsAddedMassSays) {
  // Released, it feels (m_f - m) g from time zero on.
  const double g = -2000, mu = 0.6;
  Obstacle ball = obstacle_of(Sphere{{0, 0, 0}, 0.1}, Motion::free);
  const sph::Settings s = InMeridian::settings(0.4, 0.0125, 3e6, g, true, ball);
  ball.density = mu * materials::density_at(s.bodies[0].material.law, 3e6, 0.0);
  InMeridian flow(s, ball);
  flow.run(5.0);
  const double exact = (1 - mu) * -g * 0.1 / flow.c * ball_under_force(mu, 5.0);
  EXPECT_NEAR(flow.scene.body().body().velocity()[1], exact, 0.03 * exact);
}

TEST(Obstacles, APlaneThatHalvesABodyLeavesItsMotion) {
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

TEST(Obstacles, ATurningBoxMovesAlikeInAScenesTurnedByARightAngle) {
  std::vector<ObstacleState> end;
  std::vector<double> errors;
  for (const bool turned : {false, true}) {
    Obstacle box =
        obstacle_of(turned ? Box{{-0.1, -0.2, -1}, {0.1, 0.2, 1}} : Box{{-0.2, -0.1, -1}, {0.2, 0.1, 1}}, Motion::free, 700);
    box.velocity = turned ? Vec3(-2, 3, 0) : Vec3(3, 2, 0);
    box.spin = Vec3(0, 0, 20);
    sph::Settings s = water(2, 0.025, Box{{-0.4, -0.4, -1}, {0.4, 0.4, 1}}, {box});
    s.numerics.precision = sph::Precision::full;
    s.bodies[0].pressure = 5e6;
    Scene scene(s, {box});
    const double start = scene.energy(), given = scene.body().ledger().kinetic;
    const Vec3 momentum = scene.momentum();
    scene.run(8e-5, 2e-6);
    end.push_back(scene.body().state());
    EXPECT_LT(std::abs(scene.energy() - start), 0.02 * given);
    EXPECT_LT((scene.momentum() - momentum).norm(), 1e-12 * 2000);
  }
  // Gradients are in single precision, summed in another order.
  EXPECT_NEAR(end[0].velocity[0], end[1].velocity[1], 1e-7);
  EXPECT_NEAR(end[0].velocity[1], -end[1].velocity[0], 1e-7);
  EXPECT_NEAR(end[0].spin[2], end[1].spin[2], 1e-6);
  EXPECT_LT(end[0].spin[2], 19.0);  // the water takes part
  EXPECT_GT(end[0].rotation[2], 9e-4);
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
  EXPECT_NE(refused(obstacle_of(Box{{0.3, 0.3, -0.3}, {0.6, 0.6, 0.3}}, Motion::fixed)).find("beyond the walls"),
            std::string::npos);
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
