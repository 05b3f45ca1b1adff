// JWL products, their Chapman-Jouguet state, and programmed burn.
#include "materials/burn.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "law_checks.hpp"

namespace undex::materials {
namespace {

Jwl::Parameters petn_parameters() {
  return {.rho0 = 1770.0,
          .A = 617e9,
          .B = 16.926e9,
          .R1 = 4.4,
          .R2 = 1.2,
          .omega = 0.25,
          .E0 = 10.1e9 / 1770.0,
          .D = 8300.0,
          .p_cj = 33.5e9};
}

TEST(Jwl, PressureByHand) {
  const Jwl law(petn_parameters());
  // Constant-volume burn.
  EXPECT_NEAR(law.evaluate(1770.0, 10.1e9 / 1770.0).pressure, 13.706e9, 0.001e9);
  // Far expanded, the exponentials are gone: an ideal gas of gamma = 1 + omega.
  const PressureSound thin = law.evaluate(17.7, 1e6);
  EXPECT_NEAR(thin.pressure, 0.25 * 17.7 * 1e6, 1e-6 * thin.pressure);
  EXPECT_NEAR(thin.sound_speed, std::sqrt(1.25 * 0.25 * 1e6), 1e-6 * thin.sound_speed);
  // Energy enters as omega rho e.
  EXPECT_NEAR(law.evaluate(2000.0, 2e6).pressure - law.evaluate(2000.0, 1e6).pressure, 0.25 * 2000.0 * 1e6, 1.0);
}

TEST(Jwl, SoundSpeedIsTheIsentropicSlope) {
  const Jwl law(petn_parameters());
  for (const double rho : {1.0, 50.0, 300.0, 900.0, 1770.0, 2440.0, 3500.0})
    for (const double e : {1e5, 3e6, 8e6}) {
      const double c = law.evaluate(rho, e).sound_speed;
      EXPECT_NEAR(test::isentropic_slope(law, rho, e), c * c, 1e-6 * c * c) << rho << " " << e;
    }
}

TEST(Jwl, RisesWithDensityAndGuardsSound) {
  const Jwl law(petn_parameters());
  double last = 0.0;
  for (double rho = 0.01; rho < 4 * 1770.0; rho *= 1.01) {
    const PressureSound s = law.evaluate(rho, 10.1e9 / 1770.0);
    EXPECT_GT(s.pressure, last) << rho;
    last = s.pressure;
    for (const double e : {-1e7, 0.0}) {
      EXPECT_GT(law.evaluate(rho, e).sound_speed, 0.0) << rho;
      EXPECT_TRUE(std::isfinite(law.evaluate(rho, e).sound_speed)) << rho;
    }
  }
}

TEST(Jwl, DensityInvertsPressure) {
  const Jwl law(petn_parameters());
  for (const double e : {1e6, 5.7e6})
    for (const double p : {1e5, 1e8, 13.7e9, 60e9}) {
      const double rho = law.density_at(p, e);
      EXPECT_NEAR(law.evaluate(rho, e).pressure, p, 1e-11 * p);
    }
  EXPECT_THROW(law.density_at(-1.0, 5.7e6), std::domain_error);
  EXPECT_THROW(law.density_at(1e13, 5.7e6), std::domain_error);
  EXPECT_THROW(Jwl({.rho0 = 1770.0, .A = 1e9, .B = 1e9, .R1 = 0.0, .R2 = 1.0, .omega = 0.3, .E0 = 1e6, .D = 8e3, .p_cj = 1e9}),
               std::invalid_argument);
}

TEST(ChapmanJouguet, Petn) {
  const ChapmanJouguet s = chapman_jouguet(Jwl(petn_parameters()));
  EXPECT_NEAR(s.detonation_speed, 8300.79, 0.01);
  EXPECT_NEAR(s.pressure, 33.5086e9, 0.0001e9);
  EXPECT_NEAR(s.density, 2440.55, 0.01);
  EXPECT_NEAR(s.particle_speed, 2280.68, 0.01);
  EXPECT_NEAR(s.sound_speed, 6020.1, 0.05);
}

TEST(ChapmanJouguet, PetnSatisfiesTheJumpConditions) {
  const Jwl law(petn_parameters());
  const ChapmanJouguet s = chapman_jouguet(law);
  EXPECT_NEAR(1770.0 * s.detonation_speed, s.density * (s.detonation_speed - s.particle_speed), 1e-3);
  EXPECT_NEAR(s.pressure, 1770.0 * s.detonation_speed * s.particle_speed, 1e-9 * s.pressure);
  EXPECT_NEAR(s.energy - 10.1e9 / 1770.0, 0.5 * s.particle_speed * s.particle_speed, 1e-3);
  EXPECT_NEAR(s.pressure, law.evaluate(s.density, s.energy).pressure, 1e-9 * s.pressure);
  EXPECT_NEAR(s.sound_speed + s.particle_speed, s.detonation_speed, 1e-6 * s.detonation_speed);
  // The published pressure and speed on the Hugoniot: with D = 8300 and p = 33.5 GPa the JWL gives 33.506.
  const double u = 33.5e9 / (1770.0 * 8300.0), rho = 1770.0 / (1.0 - u / 8300.0);
  EXPECT_NEAR(law.evaluate(rho, 10.1e9 / 1770.0 + 0.5 * u * u).pressure, 33.506e9, 0.0005e9);
}

TEST(ChapmanJouguet, IdealGasLimitIsExact) {
  // Without the exponentials, gamma = 1 + omega: D^2 = 2 (gamma^2 - 1) E0, p = 2 (gamma - 1) rho0 E0,
  // rho/rho0 = (gamma + 1)/gamma.
  const Jwl law({.rho0 = 1000.0, .A = 0.0, .B = 0.0, .R1 = 4.0, .R2 = 1.0, .omega = 0.4, .E0 = 4e6, .D = 3000.0, .p_cj = 1e9});
  const ChapmanJouguet s = chapman_jouguet(law);
  EXPECT_NEAR(s.detonation_speed, std::sqrt(2.0 * (1.4 * 1.4 - 1.0) * 4e6), 1e-6);
  EXPECT_NEAR(s.pressure, 2.0 * 0.4 * 1000.0 * 4e6, 10.0);
  EXPECT_NEAR(s.density, 1000.0 * 2.4 / 1.4, 1e-5);
}

TEST(ProgrammedBurn, FrontMovesAtTheDetonationSpeed) {
  ProgrammedBurn burn;
  burn.origin = Vec3(0.1, 0.0, 0.0);
  burn.D = 8300.0;
  burn.width = 1e-3;
  const Vec3 x(0.1, 0.03, 0.04);  // 50 mm away
  const double lit = 0.05 / 8300.0;
  EXPECT_NEAR(burn.lighting_time(x), lit, 1e-18);
  EXPECT_EQ(burn.fraction(x, 0.0, 1.0), 0.0);
  EXPECT_EQ(burn.fraction(x, 0.999 * lit, 1.0), 0.0);
  EXPECT_NEAR(burn.fraction(x, lit + 0.25e-3 / 8300.0, 1.0), 0.25, 1e-9);
  EXPECT_NEAR(burn.fraction(x, lit + 0.999e-3 / 8300.0, 1.0), 0.999, 1e-9);
  EXPECT_EQ(burn.fraction(x, lit + 1.001e-3 / 8300.0, 1.0), 1.0);
  EXPECT_EQ(burn.fraction(x, 1.0, 0.1), 1.0);  // expanded products stay burned
}

TEST(ProgrammedBurn, ZeroWidthBurnsAtOnce) {
  ProgrammedBurn burn;
  burn.D = 1000.0;
  const Vec3 x(1.0, 0.0, 0.0);
  EXPECT_EQ(burn.fraction(x, 0.9999e-3, 1.0), 0.0);
  EXPECT_EQ(burn.fraction(x, 1e-3, 1.0), 0.0);
  EXPECT_EQ(burn.fraction(x, 1.0001e-3, 1.0), 1.0);
}

TEST(ProgrammedBurn, CompressionBurnsAheadOfTheFront) {
  const Jwl law(petn_parameters());
  ProgrammedBurn burn = programmed_burn(law, Vec3::Zero(), 1e-3);
  EXPECT_EQ(burn.D, 8300.0);
  EXPECT_NEAR(burn.cj_compression, 2440.55 / 1770.0, 1e-5);
  const Vec3 x(0.05, 0.0, 0.0);
  EXPECT_EQ(burn.fraction(x, 0.0, 1.0), 0.0);
  EXPECT_EQ(burn.fraction(x, 0.0, 0.8), 0.0);
  const double half = 1.0 / (1.0 - 0.5 * (1.0 - 1770.0 / 2440.55));  // half the volume change of the CJ state
  EXPECT_NEAR(burn.fraction(x, 0.0, half), 0.5, 1e-5);
  EXPECT_NEAR(burn.fraction(x, 0.0, burn.cj_compression), 1.0, 1e-12);
  EXPECT_EQ(burn.fraction(x, 0.0, 3.0), 1.0);
  // The larger of the two counts.
  const double lit = burn.lighting_time(x);
  EXPECT_NEAR(burn.fraction(x, lit + 0.8e-3 / 8300.0, half), 0.8, 1e-6);
  burn.cj_compression = 0.0;
  EXPECT_EQ(burn.fraction(x, 0.0, 3.0), 0.0);
}

TEST(ProgrammedBurn, Instantaneous) {
  ProgrammedBurn burn;
  burn.instantaneous = true;
  EXPECT_EQ(burn.fraction(Vec3(1.0, 2.0, 3.0), 0.0, 1.0), 1.0);
  EXPECT_EQ(burn.lighting_time(Vec3(1.0, 2.0, 3.0)), 0.0);
}

TEST(Burning, PressureScalesAndSoundStays) {
  const Jwl law(petn_parameters());
  const double e = 10.1e9 / 1770.0;
  EXPECT_EQ(burning(law, 1770.0, e, 0.0).pressure, 0.0);
  EXPECT_NEAR(burning(law, 1770.0, e, 0.3).pressure, 0.3 * law.evaluate(1770.0, e).pressure, 1e-3);
  EXPECT_EQ(burning(law, 1770.0, e, 1.0).pressure, law.evaluate(1770.0, e).pressure);
  EXPECT_NEAR(burning(law, 1770.0, e, 0.0).sound_speed, 4797.5, 0.5);
  EXPECT_EQ(burning(law, 1770.0, e, 0.0).sound_speed, burning(law, 1770.0, e, 1.0).sound_speed);
  EXPECT_EQ(burning(law, 1000.0, 0.0, 0.0).sound_speed, 4150.0);  // at least D/2
}

}  // namespace
}  // namespace undex::materials
