// Classical solutions: their own conservation laws, published constants, and equations of motion.
#include "exact/classical.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace undex::exact {
namespace {

TEST(Noh, FrontConservesMassMomentumEnergy) {
  for (const int d : {1, 2, 3}) {
    const Noh noh{.dimension = d, .gamma = 1.4, .density = 2.0, .speed = 3.0};
    const double t = 0.5, front = noh.shock_radius(t), speed = front / t;
    const GasSample in = noh.sample(front * (1 - 1e-12), t), out = noh.sample(front * (1 + 1e-12), t);
    EXPECT_NEAR(in.density * (in.velocity - speed), out.density * (out.velocity - speed), 1e-9 * in.density * speed);
    EXPECT_NEAR(in.pressure + in.density * in.velocity * (in.velocity - speed),
                out.pressure + out.density * out.velocity * (out.velocity - speed), 1e-9 * in.pressure);
    EXPECT_NEAR(in.pressure, 0.4 * in.density * in.energy, 1e-12 * in.pressure);
  }
  EXPECT_NEAR(Noh{}.sample(0.1, 0.6).density, 64.0, 1e-12);
  EXPECT_NEAR(Noh{}.shock_radius(0.6), 0.2, 1e-15);
}

TEST(Sedov, PublishedConstants) {
  // alpha for gamma = 1.4, as tabulated by Sedov and by Korobeinikov; recalled, not read.
  EXPECT_NEAR(Sedov(1, 1.4, 1.0, 1.0).energy_integral(), 0.5387, 1e-4);
  EXPECT_NEAR(Sedov(2, 1.4, 1.0, 1.0).energy_integral(), 0.9840, 1e-4);
  EXPECT_NEAR(Sedov(3, 1.4, 1.0, 1.0).energy_integral(), 0.85107, 1e-5);
  // R = (E t^2/(alpha rho))^(1/5).
  EXPECT_NEAR(Sedov(3, 1.4, 2.0, 2.0 * 32.0 * 0.85107).shock_radius(1.0), 2.0, 1e-5);
}

TEST(Sedov, HoldsMassEnergyAndTheFirstIntegral) {
  for (const int d : {1, 2, 3})
    for (const double gamma : {1.4, 5.0 / 3.0}) {
      const Sedov blast(d, gamma, 2.0, 5.0);
      const double t = 0.7, R = blast.shock_radius(t), area = d == 1 ? 1.0 : (d == 2 ? 2.0 : 4.0) * std::numbers::pi;
      const int n = 20000;
      double mass = 0, energy = 0;
      for (int i = 0; i < n; ++i) {
        const double r = R * (i + 0.5) / n, volume = area * std::pow(r, d - 1) * R / n;
        const GasSample s = blast.sample(r, t);
        mass += s.density * volume;
        energy += (s.pressure / (gamma - 1.0) + 0.5 * s.density * s.velocity * s.velocity) * volume;
      }
      EXPECT_NEAR(mass / (2.0 * area * std::pow(R, d) / d), 1.0, 1e-6) << d << gamma;
      EXPECT_NEAR(energy / 5.0, 1.0, 1e-6) << d << gamma;
      // The energy inside of any r/R stays the same, so its flux relative to that moving sphere is zero.
      for (const double share : {0.3, 0.6, 0.95}) {
        const GasSample s = blast.sample(share * R, t);
        const double surface = share * R * 2.0 / ((d + 2.0) * t);
        const double total = s.pressure / (gamma - 1.0) + 0.5 * s.density * s.velocity * s.velocity;
        EXPECT_NEAR(total * (s.velocity - surface) + s.pressure * s.velocity, 0.0, 1e-6 * total * surface) << d << share;
      }
      EXPECT_EQ(blast.sample(1.01 * R, t).pressure, 0.0);
    }
  EXPECT_THROW(Sedov(3, 1.0, 1.0, 1.0), std::invalid_argument);
}

TEST(TaylorPlate, NumbersOfTheScene) {
  const TaylorPlate plate{.peak = 1e5, .decay = 20e-6, .impedance = 1000.0 * 1480.0, .plate_mass = 2700.0 * 6.35e-3};
  EXPECT_NEAR(plate.cavitation_time(), 15.0e-6, 0.05e-6);
  EXPECT_NEAR(plate.impulse() / (2.0 * 1e5 * 20e-6), 0.273, 5e-4);
  EXPECT_NEAR(plate.impulse() / (2.0 * 1e5 * 20e-6), std::pow(plate.ratio(), plate.ratio() / (1 - plate.ratio())), 1e-12);
}

TEST(TaylorPlate, ObeysNewton) {
  for (const double mass : {5.0, 29.6, 300.0}) {  // z = 5.92, 1, 0.0987
    const TaylorPlate plate{.peak = 1e5, .decay = 20e-6, .impedance = 1.48e6, .plate_mass = mass};
    const double end = plate.cavitation_time();
    EXPECT_NEAR(plate.wall_pressure(end), 0.0, 1e-9 * plate.peak);
    EXPECT_GT(plate.wall_pressure(0.9 * end), 0.0);
    double impulse = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) impulse += plate.wall_pressure((i + 0.5) * end / n) * end / n;
    EXPECT_NEAR(impulse / plate.impulse(), 1.0, 1e-7) << mass;
    EXPECT_NEAR(mass * plate.velocity(end) / impulse, 1.0, 1e-7) << mass;
  }
}

TEST(Elastic, WaveSpeedsAgreeWithOneAnother) {
  const double E = 71e9, nu = 0.33, rho = 2700.0;
  const double K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));
  EXPECT_NEAR(bulk_wave_speed(E, nu, rho), std::sqrt((K + 4 * G / 3) / rho), 1e-9);
  EXPECT_NEAR(shear_wave_speed(E, nu, rho), std::sqrt(G / rho), 1e-9);
  EXPECT_NEAR(bar_wave_speed(E, rho), 5128.0, 0.2);
  EXPECT_EQ(bulk_wave_speed(E, 0.0, rho), bar_wave_speed(E, rho));
}

TEST(Elastic, RingPeriodByItsEquationOfMotion) {
  // A hoop segment: rho a w'' = -E w/a, integrated by leapfrog from w = 1 to its first return through zero, a
  // quarter.
  const double E = 71e9, nu = 0.33, rho = 2700.0, a = 0.05;
  const auto quarter = [&](double stiffness) {
    double w = 1.0, v = 0.0, t = 0.0, last = 1.0;
    const double dt = 1e-9;
    for (; w > 0.0; t += dt) {
      last = w;
      v -= (t == 0.0 ? 0.5 : 1.0) * dt * stiffness * w / (rho * a * a);
      w += dt * v;
    }
    return t - dt * w / (w - last);
  };
  EXPECT_NEAR(4.0 * quarter(E) / ring_breathing_period(E, rho, a), 1.0, 1e-4);
  EXPECT_NEAR(4.0 * quarter(E / (1 - nu * nu)) / tube_breathing_period(E, nu, rho, a), 1.0, 1e-4);
}

TEST(Elastic, BarImpactBalances) {
  const ElasticBarImpact bar{.length = 0.1, .speed = 5.0, .young = 71e9, .density = 2700.0};
  const int n = 20000;
  for (const double share : {0.2, 0.45, 0.7, 0.95}) {
    const double t = share * bar.contact_time();
    double momentum = 0, energy = 0;
    for (int i = 0; i < n; ++i) {
      const auto s = bar.sample((i + 0.5) * bar.length / n, t);
      momentum += s.velocity * bar.density * bar.length / n;
      energy += 0.5 * (bar.density * s.velocity * s.velocity + s.stress * s.stress / bar.young) * bar.length / n;
    }
    const double start = bar.density * bar.length * bar.speed;
    const double wall = -bar.sample(0.0, t).stress;
    EXPECT_NEAR(momentum, -start + wall * t, 1e-4 * start) << share;
    EXPECT_NEAR(energy, 0.5 * start * bar.speed, 1e-4 * start * bar.speed) << share;
  }
}

}  // namespace
}  // namespace undex::exact
