// Rings about an axis: what they keep, water at rest beside axis and walls, and against spheres in three dimensions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pair_sample.hpp"
#include "scenes.hpp"

namespace undex::sph::testing {
namespace {

constexpr double pi = std::numbers::pi;

Settings meridian(double spacing, KernelName kernel, SchemeName scheme) {
  Settings s;
  s.dimension = 2;
  s.axisymmetric = true;
  s.symmetry.axis[0] = true;
  s.lattice.spacing = spacing;
  s.numerics.kernel = kernel;
  s.numerics.eta = with_kernel(kernel, [](auto k) { return k.usual_eta; });
  s.numerics.scheme = scheme;
  return s;
}

Shape disc(const Vec3& center, double radius) { return Shape{Sphere{.center = center, .radius = radius}, {}}; }

/// A gas bubble that expands off the middle of a ball of water, both with their middles on the axis.
Settings ball(double spacing, SchemeName scheme) {
  Settings s = meridian(spacing, KernelName::wendland_c2, scheme);
  Body gas = body("gas", disc({0, 0.002, 0}, 0.005), "bubble-gas");
  gas.variable_h = true;
  Body water = body("water", disc({0, 0, 0}, 0.02), "water-tait");
  water.shape.removed.push_back(gas.shape.base);
  s.bodies = {gas, water};
  return s;
}

class Axisymmetric : public ::testing::TestWithParam<SchemeName> {};

void keeps_mass_and_momentum(SchemeName scheme, Precision precision) {
  Settings settings = ball(0.001, scheme);
  settings.numerics.precision = precision;
  Fluid fluid(settings);
  const Ledger before = fluid.ledger();
  const double gas = 1770.0 * 4.0 / 3.0 * pi * std::pow(0.005, 3);
  const double water =
      fluid.field("density")[fluid.particle_count() - 1] * 4.0 / 3.0 * pi * (std::pow(0.02, 3) - std::pow(0.005, 3));
  EXPECT_NEAR(before.mass / (gas + water), 1.0, 1e-5);
  double scale = 0;
  for (int k = 0; k < 60; ++k) {
    fluid.step(fluid.step_limit().step);
    scale = std::max(scale, std::sqrt(2.0 * fluid.ledger().kinetic * before.mass));
  }
  const Ledger after = fluid.ledger();
  EXPECT_NEAR(after.mass, before.mass, 1e-15 * before.mass);
  EXPECT_LT(std::abs(after.momentum[1]), (precision == Precision::mixed ? 1e-7 : 1e-13) * scale);
  EXPECT_GT(after.kinetic, 1.0);
}

/// Loops of all instruction sets, in both precisions.
TEST_P(Axisymmetric, KeepsMassAndMomentumAlongTheAxis) {
  for (const char* level : {"x86-64-v2", "x86-64-v3", "x86-64-v4"})
    for (const Precision precision : {Precision::full, Precision::mixed}) {
      SCOPED_TRACE(std::string(level) + (precision == Precision::mixed ? ", mixed" : ""));
      const AtLevel at(level);
      keeps_mass_and_momentum(GetParam(), precision);
    }
}

TEST_P(Axisymmetric, ErrorOfEnergyIsThatOfTheStep) {
  double error[2];
  for (int level = 0; level < 2; ++level) {
    Fluid fluid(ball(0.001, GetParam()));
    const double before = total(fluid.ledger()), dt = fluid.step_limit().step / (6 << level);
    for (int k = 0; k < (120 << level); ++k) fluid.step(dt);
    error[level] = std::abs(total(fluid.ledger()) - before) / fluid.ledger().kinetic;
  }
  EXPECT_LT(error[0], 2e-3);
  EXPECT_LT(error[1], 0.35 * error[0] + 1e-9) << error[0];
}

TEST_P(Axisymmetric, WaterUnderPressureStaysAtRest) {
  Settings s = meridian(0.002, KernelName::wendland_c2, GetParam());
  Body water = body("water", box({0, 0, 0}, {0.02, 0.03, 0}), "water-tait");
  water.pressure = 1e9;
  s.bodies = {water};
  s.walls = {box_wall({-1, 0, 0}, {0.02, 0.03, 0})};
  Fluid fluid(s);
  double worst = 0;
  while (fluid.time() < 100e-6) fluid.step(fluid.step_limit().step);
  for (const double p : fluid.field("pressure")) worst = std::max(worst, std::abs(p / 1e9 - 1.0));
  EXPECT_LT(worst, 0.01);
  RecordProperty("worst", std::to_string(worst));
}

/// A lone ring of gas in nothing has no end but itself to push at: its volume grows by no more than its radius, however large it
/// is already, and where its smoothing length is at its bound, too. (Monaghan's scheme has no filling to see to it.)
TEST(AxisymmetricGas, ALoneRingGrowsAsItsRadius) {
  for (const SchemeName scheme : {SchemeName::riemann, SchemeName::riemann_corrected})
    for (const double bound : {0.3, 0.5, 3.0}) {
      Settings s = meridian(0.001, KernelName::wendland_c2, scheme);
      s.numerics.h_low = 0.2;
      s.numerics.h_high = bound;
      s.bodies = {body("gas", box({0.01, 0, 0}, {0.011, 0.001, 0}), "bubble-gas")};
      s.bodies[0].variable_h = true;
      Fluid fluid(s);
      ASSERT_EQ(fluid.particle_count(), 1u);
      double before = fluid.field("density")[0], r = 0.0105;
      while (r < 0.1) {
        fluid.step(fluid.step_limit().step);
        const double density = fluid.field("density")[0], now = by_id(fluid, "position")[0][0];
        ASSERT_LE(std::log(before / density), 1.01 * std::log(now / r)) << bound;
        before = density, r = now;
      }
    }
}

/// The largest error of the pressure of water at 1 GPa after 50 us, and its fastest particle [m/s].
std::pair<double, double> unrest(Fluid& fluid) {
  double worst = 0;
  while (fluid.time() < 50e-6) fluid.step(fluid.step_limit().step);
  for (const double p : fluid.field("pressure")) worst = std::max(worst, std::abs(p / 1e9 - 1.0));
  return {worst, fluid.maximum_speed()};
}

/// A spherical vessel, which a Cartesian lattice meets in steps: what these do in two dimensions, where the vessel is a circle,
/// they do here too.
TEST(AxisymmetricWalls, SphericalVessel) {
  double worst[2];
  for (const bool rings : {false, true}) {
    Settings s = meridian(0.001, KernelName::wendland_c2, SchemeName::riemann);
    s.axisymmetric = rings;
    s.bodies = {body("water", disc({0, 0, 0}, 0.02), "water-tait")};
    s.bodies[0].pressure = 1e9;
    Wall vessel;
    vessel.name = "vessel";
    vessel.container = Sphere{Vec3::Zero(), 0.02};
    s.walls = {vessel};
    Fluid fluid(s);
    const double momentum = fluid.ledger().momentum[1];
    worst[rings] = unrest(fluid).first;
    EXPECT_NEAR(fluid.ledger().momentum[1], momentum, 1e-6 * fluid.ledger().mass);
    for (const Vec3& x : by_id(fluid, "position")) EXPECT_LT(x.norm(), 0.02);
  }
  EXPECT_LT(worst[0], 0.15);
  EXPECT_LT(worst[1], 1.5 * worst[0]);
}

/// A conical vessel in space and about its axis.
Settings conical(double spacing, const Cone& cone, double pressure, bool rings) {
  Settings s = meridian(spacing, KernelName::wendland_c2, SchemeName::riemann);
  Cone as = cone;
  if (!rings) {
    s.dimension = 3;
    s.axisymmetric = false;
    s.symmetry.axis = {true, true, false};
    as.axis = 2;
  }
  s.bodies = {body("water", Shape{as, {}}, "water-tait")};
  s.bodies[0].pressure = pressure;
  Wall vessel;
  vessel.name = "vessel";
  vessel.container = as;
  s.walls = {vessel};
  return s;
}

const Cone funnel{.axis = 1, .center = Vec3::Zero(), .low_radius = 0.01, .high_radius = 0.02, .low = 0, .high = 0.02};

/// Root mean square of the speed of water under 1 MPa after 25 us [m/s]. Nobody leaves the vessel.
double unrest_within(const Settings& settings) {
  Fluid fluid(settings);
  while (fluid.time() < 25e-6) fluid.step(fluid.step_limit().step);
  const Shape vessel{settings.walls[0].container, {}};
  for (const Vec3& x : by_id(fluid, "position")) EXPECT_LT(signed_distance(vessel, x, settings.dimension), 0.0);
  double square = 0;
  for (const Vec3& v : by_id(fluid, "velocity")) square += v.squaredNorm() / double(fluid.particle_count());
  return std::sqrt(square);
}

/// Water in a cone, which a Cartesian lattice meets in steps, is as much at rest as in other vessels that it meets in steps:
/// about the axis in a sphere, in space in a cylinder.
TEST(AxisymmetricWalls, ConicalVesselKeepsWaterAtRest) {
  for (const bool rings : {true, false}) {
    const Settings cone = conical(0.001, funnel, 1e6, rings);
    Settings other = cone;
    if (rings) other.walls[0].container = Sphere{Vec3::Zero(), 0.02};
    else other.walls[0].container = Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = 0.0153, .low = 0, .high = 0.02};
    other.bodies[0].shape.base = other.walls[0].container;
    const double speed = unrest_within(cone), usual = unrest_within(other);
    RecordProperty(rings ? "meridian" : "space", std::to_string(speed) + " " + std::to_string(usual));
    EXPECT_LT(speed, 1.3 * usual);
    EXPECT_LT(speed, 1e6 / (1000 * 1483)) << "p/(rho c)";
  }
}

/// What the side gives to water under uniform pressure, its ends free, is the pressure on its area: along the axis
/// p pi (R_high^2 - R_low^2).
TEST(AxisymmetricWalls, ConesSideBearsThePressure) {
  for (const bool rings : {true, false}) {
    double error[2];
    for (const int finer : {0, 1}) {
      Settings s = conical(finer ? 0.0005 : 0.001, funnel, 1e6, rings);
      s.walls[0].faces = {{"side", FaceCondition::free_slip}, {"low", FaceCondition::open}, {"high", FaceCondition::open}};
      Fluid fluid(s);
      const int along = rings ? 1 : 2;
      const double before = fluid.ledger().momentum[along], dt = 1e-4 * fluid.step_limit().step;
      fluid.step(dt);
      const double share = rings ? 1.0 : 0.25, area = pi * (0.02 * 0.02 - 0.01 * 0.01);
      error[finer] = (fluid.ledger().momentum[along] - before) / (share * 1e6 * area * dt) - 1.0;
    }
    RecordProperty(rings ? "meridian" : "space", std::to_string(error[0]) + " " + std::to_string(error[1]));
    EXPECT_LT(std::abs(error[0]), 0.05);
    EXPECT_LT(std::abs(error[1]), 0.03);
  }
}

/// Segments from (r, axial) to (r, axial), the water on their left.
MirrorWall segments(const std::vector<Vec3>& nodes) {
  MirrorWall wall;
  wall.position = nodes;
  wall.velocity.assign(nodes.size(), Vec3::Zero());
  for (int n = 0; n + 1 < int(nodes.size()); ++n) wall.faces.push_back({n, n + 1, n + 1, n});
  return wall;
}

/// Water in a tube of segments is as much at rest as beside the wall of the scene.
TEST(AxisymmetricWalls, ATubeOfSegmentsIsTheWall) {
  Settings s = meridian(0.002, KernelName::wendland_c2, SchemeName::riemann);
  s.bodies = {body("water", box({0, 0, 0}, {0.02, 0.03, 0}), "water-tait")};
  s.bodies[0].pressure = 1e9;
  s.walls = {box_wall({-1, 0, 0}, {0.02, 0.03, 0})};
  Fluid plain(s);
  s.walls[0].faces["x_high"] = FaceCondition::open;
  Fluid meshed(s);
  std::vector<Vec3> nodes;
  for (int n = 0; n <= 18; ++n) nodes.emplace_back(0.02, -0.006 + 0.042 * n / 18, 0.0);
  const auto index = meshed.add_wall(segments(nodes));
  const auto [worst, fastest] = unrest(meshed);
  EXPECT_NEAR(worst, unrest(plain).first, 1e-9);
  // What the wall bears is the pressure on its area, half of the nodes at the ends of the water included.
  double pushed = 0;
  for (const Vec3& impulse : meshed.wall(index).impulse) pushed += impulse[0];
  EXPECT_NEAR(pushed / (1e9 * 2 * pi * 0.02 * 0.03 * 50e-6), 1.0, 0.01);
}

/// A cone of segments that moves unevenly: what the water loses along the axis the wall has, and its work closes the balance with
/// the order of the step.
TEST(AxisymmetricWalls, AMovingConeReceivesWhatTheWaterLoses) {
  for (const SchemeName scheme : {SchemeName::riemann, SchemeName::monaghan}) {
    double error[2];
    for (const int finer : {0, 1}) {
      Settings s = meridian(0.001, KernelName::wendland_c2, scheme);
      s.lattice.jitter = 0.2;
      Body water = body("water", disc({0, 0, 0}, 0.02), "water-tait");
      water.shape.removed.push_back(Slab{.axis = 1, .low = -0.1, .high = -0.01});
      water.pressure = 2e8;
      s.bodies = {water};
      Fluid fluid(s);
      std::vector<Vec3> nodes;  // under the cut ball of water
      for (int n = 0; n <= 24; ++n) nodes.emplace_back(0.024 * n / 24, -0.01 - 0.002 * n / 24, 0.0);
      MirrorWall cone = segments(nodes);
      for (std::size_t n = 0; n < nodes.size(); ++n)
        cone.velocity[n] = Vec3(nodes[n][0] > 0 ? 3.0 : 0.0, 20 + 30 * std::sin(300 * nodes[n][0]), 0);
      const auto index = fluid.add_wall(cone);
      const double dt = (finer ? 0.1 : 0.2) * fluid.step_limit().step;
      const Ledger start = fluid.ledger();
      for (int k = 0; k < (finer ? 40 : 20); ++k) {
        MirrorWall& wall = fluid.wall(index);
        for (std::size_t n = 0; n < wall.position.size(); ++n) wall.position[n] += dt * wall.velocity[n];
        fluid.step(dt);
      }
      const Ledger end = fluid.ledger();
      double received = 0;
      for (const Vec3& impulse : fluid.wall(index).impulse) received += impulse[1];
      EXPECT_GT(std::abs(received), 0.0);
      EXPECT_NEAR(received, -(end.momentum[1] - start.momentum[1]), 1e-11 * std::abs(received));
      error[finer] = std::abs(total(end) - total(start)) / std::abs(end.wall_work - start.wall_work);
    }
    EXPECT_LT(error[0], 2e-2);
    EXPECT_LT(error[1], 0.6 * error[0]);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Axisymmetric,
                         ::testing::Values(SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan),
                         [](const auto& each) {
                           for (const auto& [name, scheme] : scheme_names)
                             if (scheme == each.param) return std::string(name);
                           return std::string();
                         });

}  // namespace
}  // namespace undex::sph::testing
