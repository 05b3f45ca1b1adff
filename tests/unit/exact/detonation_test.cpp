// The wave behind a detonation: published numbers, closed isentrope, and the integrals of mass and energy.
#include "exact/detonation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "materials/library.hpp"

namespace undex::exact {
namespace {

materials::Jwl petn() { return std::get<materials::Jwl>(materials::find_fluid("petn")->law); }

TEST(TaylorWave, PlanarCoreOfPetn) {
  // The page of scene 3: constant for x/(D t) < 0.5105, 9.336 GPa, 1571.9 kg/m^3.
  const TaylorWave wave(petn(), 1);
  EXPECT_NEAR(wave.core_share(), 0.5105, 5e-5);
  EXPECT_NEAR(wave.core().pressure, 9.336e9, 5e5);
  EXPECT_NEAR(wave.core().density, 1571.9, 0.05);
  const double D = wave.front().detonation_speed;
  const TaylorWave::Sample front = wave.sample(D * (1 - 1e-12), 1.0);
  EXPECT_NEAR(front.pressure, wave.front().pressure, 1e-6 * front.pressure);
  EXPECT_NEAR(front.velocity, wave.front().particle_speed, 1e-3);
  EXPECT_EQ(wave.sample(0.3 * D, 1.0).velocity, 0.0);
  EXPECT_FALSE(wave.sample(1.001 * D, 1.0).burned);
  EXPECT_EQ(wave.sample(1.001 * D, 1.0).pressure, 0.0);
}

TEST(TaylorWave, LiesOnTheClosedIsentrope) {
  const auto j = petn().parameters();
  for (const int d : {1, 2, 3}) {
    const TaylorWave wave(petn(), d);
    const auto& cj = wave.front();
    const double v_cj = j.rho0 / cj.density;
    const double C = (cj.pressure - j.A * std::exp(-j.R1 * v_cj) - j.B * std::exp(-j.R2 * v_cj)) * std::pow(v_cj, 1.25);
    for (const double share : {0.1, 0.55, 0.7, 0.9, 0.999}) {
      const auto s = wave.sample(share * cj.detonation_speed, 1.0);
      const double v = j.rho0 / s.density;
      const double closed = j.A * std::exp(-j.R1 * v) + j.B * std::exp(-j.R2 * v) + C * std::pow(v, -1.25);
      EXPECT_NEAR(s.pressure, closed, 1e-8 * closed) << d << " " << share;
    }
  }
}

TEST(TaylorWave, HoldsTheMassAndEnergyOfTheBurnedExplosive) {
  const auto j = petn().parameters();
  for (const int d : {1, 2, 3}) {
    const TaylorWave wave(petn(), d);
    const double D = wave.front().detonation_speed;
    // Midpoint sums, refined towards the front, where the gradient is infinite when d > 1: x = 1 - y^3.
    const int n = 1000;
    double mass = 0, energy = 0;
    for (int i = 0; i < n; ++i) {
      const double y = (i + 0.5) / n, x = 1.0 - y * y * y;
      const double weight = 3.0 * y * y / n * d * std::pow(x, d - 1);
      const auto s = wave.sample(x * D, 1.0);
      mass += weight * s.density;
      energy += weight * s.density * (s.energy + 0.5 * s.velocity * s.velocity);
    }
    EXPECT_NEAR(mass / j.rho0, 1.0, 1e-5) << d;
    EXPECT_NEAR(energy / (j.rho0 * j.E0), 1.0, 1e-5) << d;
    EXPECT_GT(wave.core_share(), 0.3);
  }
}

TEST(TaylorWave, RefusesOtherDimensions) { EXPECT_THROW(TaylorWave(petn(), 4), std::invalid_argument); }

}  // namespace
}  // namespace undex::exact
