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
  std::printf("worst %.3e, fastest %.3e m/s\n", worst, fluid.maximum_speed());
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
