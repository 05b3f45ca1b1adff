// Mie-Grueneisen water: numbers, the Hugoniot it is built on, branches, cut-off and the end of the fit.
#include "materials/mie_gruneisen_water.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "law_checks.hpp"

namespace undex::materials {
namespace {

MieGruneisenWater steinberg(Cavitation cavitation = Cavitation::cutoff) {
  MieGruneisenWater::Parameters p;
  p.cavitation = cavitation;
  return MieGruneisenWater(p);
}

MieGruneisenWater printed() {
  MieGruneisenWater::Parameters p;
  p.S2 = 1.986;
  p.S3 = 1.2286;
  p.alpha = 0.0;
  return MieGruneisenWater(p);
}

/// Hugoniot pressure [Pa] of the shock fit U = C0 + S1 u + S2 u^2/U + S3 u^3/U^2, solved for U by bisection
/// from the jump conditions, without eq. 27.
double shock_pressure(const MieGruneisenWater::Parameters& p, double mu) {
  const double jump = mu / (1.0 + mu);  // u/U
  const double U = p.C0 / (1.0 - jump * (p.S1 + jump * (p.S2 + jump * p.S3)));
  return p.rho0 * U * U * jump;
}

TEST(MieGruneisenWater, NumbersOfBothSets) {
  EXPECT_NEAR(steinberg().evaluate(1100.0, 0.0).pressure, 313e6, 0.5e6);
  EXPECT_NEAR(steinberg().evaluate(1200.0, 0.0).pressure, 847e6, 0.5e6);
  EXPECT_NEAR(printed().evaluate(1100.0, 0.0).pressure, 346e6, 0.5e6);
  EXPECT_NEAR(printed().evaluate(1200.0, 0.0).pressure, 1332e6, 0.5e6);
}

TEST(MieGruneisenWater, RestState) {
  const PressureSound s = steinberg().evaluate(1000.0, 0.0);
  EXPECT_NEAR(s.pressure, 1e-5, 2e-5);
  EXPECT_NEAR(s.sound_speed, 1480.0, 1e-9);
}

TEST(MieGruneisenWater, ReturnsItsHugoniot) {
  // The energy behind a shock is p/2 (1/rho0 - 1/rho) per mass; only E = rho0 e makes eq. 27 return p there.
  for (const MieGruneisenWater& law : {steinberg(), printed()})
    for (const double mu : {0.01, 0.1, 0.2, 0.3, 0.4}) {
      const double p = shock_pressure(law.parameters(), mu);
      const double rho = 1000.0 * (1.0 + mu);
      const double energy = 0.5 * p * (1.0 / 1000.0 - 1.0 / rho);
      if (mu > law.limit()) continue;
      EXPECT_NEAR(law.evaluate(rho, energy).pressure, p, 1e-10 * p) << mu;
    }
  // Steinberg's fit also where a close charge drives it: 20 GPa at mu = 0.85.
  const double p = shock_pressure(steinberg().parameters(), 0.85);
  EXPECT_NEAR(p, 20.6e9, 0.2e9);
  EXPECT_NEAR(steinberg().evaluate(1850.0, 0.5 * p * (1 / 1000.0 - 1 / 1850.0)).pressure, p, 1e-10 * p);
}

TEST(MieGruneisenWater, EnergyEntersPerInitialVolume) {
  const MieGruneisenWater law = steinberg();
  const double mu = 0.2, e = 1e5;
  EXPECT_NEAR(law.evaluate(1200.0, e).pressure - law.evaluate(1200.0, 0.0).pressure, (0.5 + 2.67 * mu) * 1000.0 * e, 1e-3);
}

TEST(MieGruneisenWater, SmoothAtRestDensity) {
  const MieGruneisenWater law = steinberg(Cavitation::none);
  for (const double e : {0.0, 2e5}) {
    const double p = law.evaluate(1000.0, e).pressure;
    for (const double step : {1e-6, 1e-9}) {
      EXPECT_NEAR(law.evaluate(1000.0 * (1 + step), e).pressure, p, 1e10 * step + 1e-6);
      EXPECT_NEAR(law.evaluate(1000.0 * (1 - step), e).pressure, p, 1e10 * step + 1e-6);
    }
    EXPECT_NEAR(law.evaluate(1000.0 * (1 + 1e-9), e).sound_speed, law.evaluate(1000.0 * (1 - 1e-9), e).sound_speed, 1e-4);
  }
}

TEST(MieGruneisenWater, SoundSpeedIsTheIsentropicSlope) {
  for (const MieGruneisenWater& law : {steinberg(Cavitation::none), printed()})
    for (const double mu : {0.001, 0.05, 0.2, 0.35, 0.44, 0.6})
      for (const double e : {1e4, 5e5, 3e6}) {
        const double c = law.evaluate(1000.0 * (1 + mu), e).sound_speed;
        EXPECT_NEAR(test::isentropic_slope(law, 1000.0 * (1 + mu), e), c * c, 2e-5 * c * c) << mu << " " << e;
      }
  const MieGruneisenWater law = steinberg(Cavitation::none);
  for (const double mu : {-0.2, -0.05, -0.001}) {
    const double c = law.evaluate(1000.0 * (1 + mu), 1e5).sound_speed;
    EXPECT_NEAR(test::isentropic_slope(law, 1000.0 * (1 + mu), 1e5), c * c, 2e-5 * c * c) << mu;
  }
}

TEST(MieGruneisenWater, CutoffIsContinuousAtEveryEnergy) {
  MieGruneisenWater::Parameters p;
  p.p_floor = 2000.0;
  const MieGruneisenWater law(p);
  for (const double e : {0.0, 1e3, 1e5, 1e6}) {
    const double cut = law.cutoff_density(e);
    EXPECT_LE(cut, law.cutoff_density(0.0)) << e;  // hot water has to expand further
    EXPECT_NEAR(law.evaluate(cut * (1 + 1e-12), e).pressure, 2000.0, 1e-2) << e;
    EXPECT_GT(law.evaluate(cut * (1 + 1e-9), e).pressure, 2000.0) << e;
    EXPECT_EQ(law.evaluate(cut * (1 - 1e-9), e).pressure, 2000.0) << e;
    EXPECT_EQ(law.evaluate(0.5 * cut, e).pressure, 2000.0) << e;
    // Sound speed below is that of the liquid at the cut-off.
    EXPECT_NEAR(law.evaluate(0.5 * cut, e).sound_speed, law.evaluate(cut * (1 + 1e-9), e).sound_speed, 0.02) << e;
    EXPECT_EQ(law.void_fraction(cut, e), 0.0);
    EXPECT_NEAR(law.void_fraction(0.25 * cut, e), 0.75, 1e-12);
  }
  EXPECT_EQ(law.void_fraction(1100.0), 0.0);
  EXPECT_EQ(steinberg(Cavitation::none).void_fraction(500.0), 0.0);
  EXPECT_LT(steinberg(Cavitation::none).evaluate(950.0, 0.0).pressure, -1e8);
}

TEST(MieGruneisenWater, SteinbergNeverMeetsTheEndOfTheFit) {
  EXPECT_TRUE(std::isinf(steinberg().limit()));
  // The Hugoniot has a positive sound speed above the guard, and rises, to mu = 1.
  const MieGruneisenWater law = steinberg();
  double last = 0.0;
  for (double mu = 0.01; mu <= 1.0; mu += 0.01) {
    const double p = shock_pressure(law.parameters(), mu), rho = 1000.0 * (1 + mu);
    const double e = 0.5 * p * (1 / 1000.0 - 1 / rho);
    EXPECT_GT(p, last);
    EXPECT_GT(law.evaluate(rho, e).sound_speed, 1480.0) << mu;
    last = p;
  }
}

TEST(MieGruneisenWater, PrintedSetIsContinuedBeforeItsPole) {
  const MieGruneisenWater law = printed();
  EXPECT_GT(law.limit(), 0.38);
  EXPECT_LT(law.limit(), 0.44);  // the pole
  const double rho = 1000.0 * (1 + law.limit());
  const PressureSound below = law.evaluate(rho * (1 - 1e-10), 1e5), above = law.evaluate(rho * (1 + 1e-10), 1e5);
  EXPECT_NEAR(below.pressure, above.pressure, 1e-7 * above.pressure);
  EXPECT_NEAR(below.sound_speed, above.sound_speed, 1e-6 * above.sound_speed);
  double last = 0.0;
  for (double r = 1001.0; r < 3000.0; r += 1.0) {
    const PressureSound s = law.evaluate(r, 0.0);
    EXPECT_TRUE(std::isfinite(s.pressure)) << r;
    EXPECT_GT(s.pressure, last) << r;
    EXPECT_GT(s.sound_speed, 1480.0) << r;
    last = s.pressure;
  }
}

TEST(MieGruneisenWater, SoundSpeedIsGuardedInColdOvercompression) {
  const MieGruneisenWater law = steinberg();
  for (double rho = 1e-3; rho < 5000.0; rho *= 1.01)
    for (const double e : {-1e6, 0.0, 1e7}) EXPECT_GE(law.evaluate(rho, e).sound_speed, 148.0) << rho << " " << e;
}

TEST(MieGruneisenWater, DensityInvertsPressure) {
  for (const MieGruneisenWater& law : {steinberg(), printed()})
    for (const double e : {0.0, 1e5})
      for (const double p : {10.0, 1e5, 1e8, 2e9}) {
        const double rho = law.density_at(p, e);
        EXPECT_NEAR(law.evaluate(rho, e).pressure, p, 1e-6 + 1e-11 * p);
        EXPECT_GT(law.evaluate(rho * (1 + 1e-6), e).pressure, p);
      }
  EXPECT_EQ(steinberg().density_at(1e-5, 1e5), steinberg().cutoff_density(1e5));
  EXPECT_NEAR(steinberg(Cavitation::none).evaluate(steinberg(Cavitation::none).density_at(-1e8, 0.0), 0.0).pressure, -1e8, 1e-2);
}

TEST(MieGruneisenWater, UnreachablePressuresThrow) {
  EXPECT_THROW(steinberg().density_at(0.0, 0.0), std::domain_error);
  EXPECT_THROW(steinberg().density_at(1e11, 0.0), std::domain_error);  // beyond the fold of the cold curve
}

TEST(MieGruneisenWater, RefusesImpossibleParameters) {
  MieGruneisenWater::Parameters p;
  p.cavitation = Cavitation::schmidt;
  EXPECT_THROW(MieGruneisenWater{p}, std::invalid_argument);
  p = {};
  p.C0 = 0.0;
  EXPECT_THROW(MieGruneisenWater{p}, std::invalid_argument);
}

}  // namespace
}  // namespace undex::materials
