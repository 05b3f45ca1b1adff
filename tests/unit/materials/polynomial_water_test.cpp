// Polynomial water: Hugoniot, sound speed, cut-off, inverse.
#include "materials/polynomial_water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "law_checks.hpp"

namespace undex::materials {
namespace {

PolynomialWater with(Cavitation cavitation) {
  PolynomialWater::Parameters p;
  p.cavitation = cavitation;
  return PolynomialWater(p);
}

/// Of the shock into (rho0, no pressure) that compresses by mu: p = polynomial + omega rho e, e = p/2 (1/rho0 - 1/rho).
double shock_pressure(const PolynomialWater::Parameters& p, double mu) {
  return mu * (p.A + mu * (p.B + mu * p.C)) / (1 - 0.5 * p.omega * mu);
}

TEST(PolynomialWater, HugoniotOfThePublishedSet) {
  const PolynomialWater law{PolynomialWater::Parameters{}};
  // Worked out by hand from the set: A mu + B mu^2 + C mu^3 over 1 - omega mu/2.
  EXPECT_NEAR(shock_pressure(law.parameters(), 0.1), 0.339e9, 0.001e9);
  EXPECT_NEAR(shock_pressure(law.parameters(), 0.2), 0.982e9, 0.002e9);
  for (const double mu : {0.01, 0.1, 0.2, 0.5, 0.9}) {
    const double p = shock_pressure(law.parameters(), mu), rho = 1000 * (1 + mu);
    EXPECT_NEAR(law.evaluate(rho, 0.5 * p * (1 / 1000.0 - 1 / rho)).pressure, p, 1e-10 * p) << mu;
  }
  EXPECT_NEAR(law.evaluate(1000.01, 0).sound_speed, 1483.3, 0.2);
}

TEST(PolynomialWater, SoundSpeedIsTheIsentropicSlope) {
  const PolynomialWater law = with(Cavitation::none);
  for (const double mu : {-0.2, -0.01, 0.001, 0.05, 0.3, 0.8})
    for (const double e : {0.0, 1e5, 3e6}) {
      const double c = law.evaluate(1000 * (1 + mu), e).sound_speed;
      EXPECT_NEAR(test::isentropic_slope(law, 1000 * (1 + mu), e), c * c, 2e-5 * c * c) << mu << " " << e;
    }
}

TEST(PolynomialWater, TensionGoesOnAlongItsLine) {
  const PolynomialWater law = with(Cavitation::none);
  EXPECT_NEAR(law.evaluate(900, 0).pressure, -0.22e9, 1);
  EXPECT_NEAR(law.evaluate(1000 * (1 + 1e-9), 0).sound_speed, law.evaluate(1000 * (1 - 1e-9), 0).sound_speed, 1e-4);
  EXPECT_EQ(law.void_fraction(500), 0);
}

TEST(PolynomialWater, CutoffIsContinuousAtEveryEnergy) {
  const PolynomialWater law{PolynomialWater::Parameters{}};
  for (const double e : {-1e4, 0.0, 1e3, 1e5, 1e6}) {  // below 0 it is reached in compression
    const double cut = law.cutoff_density(e);
    EXPECT_NEAR(law.evaluate(cut * (1 + 1e-12), e).pressure, 5000, 0.02) << e;
    EXPECT_GT(law.evaluate(cut * (1 + 1e-9), e).pressure, 5000) << e;
    EXPECT_EQ(law.evaluate(cut * (1 - 1e-9), e).pressure, 5000) << e;
    EXPECT_NEAR(law.evaluate(0.5 * cut, e).sound_speed, law.evaluate(cut * (1 + 1e-9), e).sound_speed, 0.02) << e;
    EXPECT_EQ(law.void_fraction(cut, e), 0);
    EXPECT_NEAR(law.void_fraction(0.25 * cut, e), 0.75, 1e-12);
  }
}

TEST(PolynomialWater, DensityInvertsPressure) {
  const PolynomialWater law{PolynomialWater::Parameters{}};
  for (const double e : {0.0, 1e5})
    for (const double p : {5e3, 1e5, 1e8, 5e9}) {
      if (p == 5e3) EXPECT_EQ(law.density_at(p, e), law.cutoff_density(e));
      else EXPECT_NEAR(law.evaluate(law.density_at(p, e), e).pressure, p, 1e-6 * p + 1e-2);
    }
  EXPECT_THROW(law.density_at(0, 0), std::domain_error);
  EXPECT_THROW(law.density_at(1e14, 0), std::domain_error);
}

TEST(PolynomialWater, RefusesImpossibleParameters) {
  for (double PolynomialWater::Parameters::*member :
       {&PolynomialWater::Parameters::rho0, &PolynomialWater::Parameters::A, &PolynomialWater::Parameters::B}) {
    PolynomialWater::Parameters p;
    p.*member = -1;
    EXPECT_THROW(PolynomialWater{p}, std::invalid_argument);
  }
  PolynomialWater::Parameters p;
  p.cavitation = Cavitation::schmidt;
  EXPECT_THROW(PolynomialWater{p}, std::invalid_argument);
}

}  // namespace
}  // namespace undex::materials
