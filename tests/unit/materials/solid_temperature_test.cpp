// Temperature of solids by compression and shock heat.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/library.hpp"
#include "materials/solid.hpp"
#include "tests/unit/materials/solid_hugoniot.hpp"

namespace undex::materials {
namespace {

/// Internal energy [J/kg] on the isentrope from rest at a specific volume [m^3/kg].
double isentropic(const Solid& solid, double volume) {
  const int steps = 20000;
  const double v0 = 1 / solid.rho0, h = (volume - v0) / steps;
  double e = 0;
  const auto pressure = [&](double v, double at) { return evaluate(solid.pressure, solid.rho0, 1 / v, at).pressure; };
  for (int k = 0; k < steps; ++k) {
    const double v = v0 + k * h;
    e -= h * pressure(v + h / 2, e - h / 2 * pressure(v, e));
  }
  return e;
}

/// Temperature [K] after a step from `before` to `after` [m^3/kg] in which the energy rises from `energy` by `gained` [J/kg].
double after_step(const Solid& solid, double temperature, double before, double after, double energy, double gained) {
  return warming(solid,
                 {.before = before, .after = after, .energy = energy, .pressure_work = gained, .dissipated = 0})(temperature);
}

TEST(SolidTemperature, IsentropicCompressionWarmsByTheGrueneisenParameter) {
  const Solid metal = *find_solid("al-2024-t351");
  const double v0 = 1 / metal.rho0, v = 0.8 * v0, gamma = *gruneisen(metal.pressure), cold = 293 * std::pow(1 / 0.8, gamma);
  double T = 293, e = 0;
  const int steps = 4;
  for (int k = 0; k < 2 * steps; ++k) {  // there, and back on the same path
    const auto volume = [&](int n) { return v0 + (v - v0) * (steps - std::abs(steps - n)) / steps; };
    const double next = isentropic(metal, volume(k + 1));
    T = after_step(metal, T, volume(k), volume(k + 1), e, next - e);
    e = next;
    if (k == steps - 1) {
      EXPECT_NEAR(T, cold, 0.1);
    }
  }
  EXPECT_NEAR(T, 293, 0.1);
}

TEST(SolidTemperature, AShockGivesTheSameInOneStepAndInMany) {
  const Solid metal = *find_solid("al-2024-t351");
  const double v0 = 1 / metal.rho0, v = 0.8 * v0, middle = 0.9 * v0, gained = 3e6;
  const double once = after_step(metal, 293, v0, v, 0, gained);
  const double first = after_step(metal, 293, v0, middle, 0, 0.3 * gained);
  EXPECT_NEAR(after_step(metal, first, middle, v, 0.3 * gained, 0.7 * gained) / once, 1.0, 1e-3);
  EXPECT_NEAR(testing::temperature_of(metal, 1 / v, gained) / once, 1.0, 1e-3);
}

TEST(SolidTemperature, HeatWarmsByTheHeatCapacity) {
  const Solid metal = *find_solid("al-2024-t351");
  const VolumeStep still{.before = 1e-4, .after = 1e-4, .energy = 0, .pressure_work = 0, .dissipated = 10 * metal.heat_capacity};
  EXPECT_NEAR(warming(metal, still)(300), 310, 1e-12);
  EXPECT_NEAR(rise_by(metal, still.dissipated), 10, 1e-12);
}

TEST(SolidTemperature, PartedMatterIsAsWarmWhenItClosesAgain) {
  Solid metal = *find_solid("al-2024-t351");
  metal.spall = Spall{.strength = 1e9};
  EXPECT_TRUE(is_parted(metal, -1e9, false));
  EXPECT_FALSE(is_parted(metal, -0.99e9, false));
  EXPECT_TRUE(is_parted(metal, 0, true));
  EXPECT_FALSE(is_parted(metal, 1, true));
  const double v = 1 / metal.rho0;
  VolumeStep step{.before = v, .after = 2 * v, .energy = 0, .pressure_work = 1e9 * v, .dissipated = 0, .parted = true};
  double T = warming(metal, step)(300);
  EXPECT_EQ(T, 300);
  std::swap(step.before, step.after);
  EXPECT_EQ(warming(metal, step)(T), 300);
}

TEST(SolidTemperature, ALawWithoutEnergyKnowsPlasticWorkAlone) {
  const Solid metal = *find_solid("armco-iron");
  EXPECT_FALSE(gruneisen(metal.pressure));
  EXPECT_EQ(after_step(metal, 300, 1e-4, 0.9e-4, 0, 1e5), 300);
  EXPECT_EQ(rise_by(metal, 1e5), 0);
}

}  // namespace
}  // namespace undex::materials
