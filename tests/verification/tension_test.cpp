// Water that carries tension, pulled apart or off a wall at 5 m/s: an acoustic wave of -rho c u runs into it. Exact by Riemann's
// invariant of Tait's law: c falls by (N - 1)/2 times the speed.
#include <algorithm>

#include "bodies.hpp"

namespace undex::sph::testing {
namespace {

constexpr double speed = 5.0, rest = 1e5, end = 1.5e-4;

Body tearless(const std::string& name, double low, double high, double velocity, double floor = 0.0) {
  Body body = slab(name, low, high, "water-tait", velocity);
  materials::TaitWater::Parameters water;
  water.cavitation = floor < 0.0 ? materials::Cavitation::cutoff : materials::Cavitation::none;
  if (floor < 0.0) water.p_floor = floor;
  body.material.name = "water in tension";
  body.material.law = materials::TaitWater(water);
  body.pressure = rest;
  return body;
}

double exact_pressure() {
  const materials::TaitWater water{materials::TaitWater::Parameters{}};
  const auto& p = water.parameters();
  const double c = water.evaluate(water.density_at(rest), 0).sound_speed - 0.5 * (p.N - 1) * speed;
  return p.B * (std::pow(c * c * p.rho0 / (p.N * p.B), p.N / (p.N - 1)) - 1) + p.A;
}

struct State {
  double pressure = 0, velocity = 0, lowest = 1e300;
};

/// Means from 0.02 to 0.12 m; the waves are at 0.22 m.
State behind_the_wave(const Settings& settings) {
  Fluid fluid(settings);
  run_until(fluid, end);
  const std::vector<double> x = along_x(fluid.field("position")), u = along_x(fluid.field("velocity"));
  const std::vector<double> p = fluid.field("pressure");
  State mean;
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < 0.02 || x[i] > 0.12) continue;
    mean.pressure += p[i];
    mean.velocity += u[i];
    mean.lowest = std::min(mean.lowest, p[i]);
    ++count;
  }
  mean.pressure /= count;
  mean.velocity /= count;
  return mean;
}

class Tension : public ::testing::TestWithParam<SchemeName> {};

void expect_exact(const State& state, double tolerance = 0.01) {
  EXPECT_LT(exact_pressure(), -7.3e6);
  EXPECT_NEAR(state.pressure / exact_pressure(), 1.0, tolerance);
  EXPECT_NEAR(state.velocity, 0.0, 0.01 * speed);
}

TEST_P(Tension, HalvesOfOneLiquidHoldTogether) {
  Settings settings = scene_1d(0.002, GetParam());
  settings.bodies = {tearless("left", -0.6, 0, -speed), tearless("right", 0, 0.6, speed)};
  expect_exact(behind_the_wave(settings));
}

TEST_P(Tension, AMirrorHoldsLikeTheOtherHalf) {
  Settings settings = scene_1d(0.002, GetParam());
  settings.symmetry.axis[0] = true;
  settings.bodies = {tearless("right", 0, 0.6, speed)};
  expect_exact(behind_the_wave(settings));
}

TEST_P(Tension, ASlipWallHoldsLikeAMirror) {
  Settings settings = scene_1d(0.002, GetParam());
  settings.bodies = {tearless("right", 0, 0.6, speed)};
  settings.walls = {{.name = "wall", .container = Box{Vec3(0, -1, -1), Vec3(2, 1, 1)}, .faces = {}}};
  for (const char* face : {"x_low", "x_high"}) settings.walls[0].faces[face] = FaceCondition::free_slip;
  // A wall with the wall's own velocity sees half of the approach: see equations.md, section 4.
  if (GetParam() != SchemeName::paper) expect_exact(behind_the_wave(settings));
}

TEST_P(Tension, ALinedWallHoldsToo) {
  Settings settings = scene_1d(0.002, GetParam());
  settings.bodies = {tearless("right", 0, 0.6, speed)};
  settings.walls = {{.name = "wall", .container = Box{Vec3(0, -1, -1), Vec3(2, 1, 1)}, .faces = {}}};
  for (const char* face : {"x_low", "x_high"}) settings.walls[0].faces[face] = FaceCondition::no_slip;
  if (GetParam() != SchemeName::paper) expect_exact(behind_the_wave(settings));
}

TEST_P(Tension, UnderAnAtmosphereItIsTheSame) {
  Settings settings = scene_1d(0.002, GetParam());
  settings.surroundings.pressure = rest;
  settings.bodies = {tearless("left", -0.6, 0, -speed), tearless("right", 0, 0.6, speed)};
  expect_exact(behind_the_wave(settings));
}

TEST_P(Tension, ACutOffBoundsIt) {
  // It tears at -2 MPa, and no pair pulls harder; where the halves have parted their ends are free, and the tension is let go of.
  Settings settings = scene_1d(0.002, GetParam());
  settings.bodies = {tearless("left", -0.6, 0, -speed, -2e6), tearless("right", 0, 0.6, speed, -2e6)};
  const State state = behind_the_wave(settings);
  EXPECT_GE(state.lowest, -2e6);
  EXPECT_LT(state.pressure, -1e6);
}

TEST_P(Tension, WaterThatCavitatesStillDoesNotPull) {
  Settings settings = scene_1d(0.002, GetParam());
  settings.bodies = {slab("left", -0.6, 0, "water-tait-cutoff", -speed), slab("right", 0, 0.6, "water-tait-cutoff", speed)};
  for (Body& body : settings.bodies) body.pressure = rest;
  const State state = behind_the_wave(settings);
  EXPECT_GE(state.lowest, 0.0);
}

std::string scheme_name(SchemeName scheme) {
  return scheme == SchemeName::paper ? "paper" : scheme == SchemeName::monaghan_switch ? "monaghan_switch" : name_of(scheme);
}

INSTANTIATE_TEST_SUITE_P(, Tension,
                         ::testing::Values(SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan,
                                           SchemeName::monaghan_switch, SchemeName::paper),
                         [](const auto& c) { return scheme_name(c.param); });

}  // namespace
}  // namespace undex::sph::testing
