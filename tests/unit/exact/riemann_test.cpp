// Riemann problems against published and closed solutions, and by the residuals of the conservation laws.
#include "exact/riemann.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "materials/library.hpp"

namespace undex::exact {
namespace {

using materials::find_fluid;
using materials::FluidLaw;

FluidLaw fluid(const char* name) { return find_fluid(name)->law; }
const FluidLaw ideal_gas = materials::IdealGas({.rho0 = 1.0, .gamma = 1.4});

RiemannSide gas(double rho, double u, double p) { return {ideal_gas, rho, u, p / (0.4 * rho)}; }

double pressure_of(const RiemannSide& side) { return true_pressure_sound(side.law, side.density, side.energy).pressure; }

/// Flux of mass, momentum and total energy through a front of speed s.
struct Fluxes {
  double mass, momentum, energy;
};
Fluxes fluxes(double rho, double u, double p, double e, double s) {
  const double relative = u - s;
  return {rho * relative, rho * relative * u + p, rho * relative * (e + 0.5 * u * u) + p * u};
}

TEST(Riemann, TorosFiveTests) {
  // Toro 2009, table 4.2 and 4.3: p*, u*, densities left and right of the contact, printed to five or six
  // digits.
  struct Case {
    RiemannSide left, right;
    double p, u, rho_left, rho_right;
  };
  const Case cases[] = {{gas(1, 0, 1), gas(0.125, 0, 0.1), 0.30313, 0.92745, 0.42632, 0.26557},
                        {gas(1, -2, 0.4), gas(1, 2, 0.4), 0.00189, 0.0, 0.02185, 0.02185},
                        {gas(1, 0, 1000), gas(1, 0, 0.01), 460.894, 19.5975, 0.57506, 5.99924},
                        {gas(1, 0, 0.01), gas(1, 0, 100), 46.0950, -6.19633, 5.99242, 0.57511},
                        {gas(5.99924, 19.5975, 460.894), gas(5.99242, -6.19633, 46.0950), 1691.64, 8.68975, 14.2823, 31.0426}};
  for (const Case& c : cases) {
    const RiemannSolution s(c.left, c.right);
    EXPECT_NEAR(s.pressure(), c.p, 5e-6 * std::max(1.0, c.p)) << c.p;
    EXPECT_NEAR(s.velocity(), c.u, 5e-6 * std::max(1.0, std::abs(c.u))) << c.p;
    EXPECT_NEAR(s.star(0).density, c.rho_left, 1e-5 * std::max(1.0, c.rho_left)) << c.p;
    EXPECT_NEAR(s.star(1).density, c.rho_right, 1e-5 * std::max(1.0, c.rho_right)) << c.p;
    EXPECT_FALSE(s.cavity());
  }
}

TEST(Riemann, IdealGasFanIsTheClosedOne) {
  const RiemannSolution s(gas(1, 0, 1), gas(0.125, 0, 0.1));
  const double c0 = std::sqrt(1.4);
  for (const double xi : {-1.1, -0.8, -0.5, -0.2}) {
    ASSERT_GT(xi, s.head(0));
    ASSERT_LT(xi, s.tail(0));
    const double u = (c0 + xi) / 1.2, c = c0 - 0.2 * u;
    const RiemannSample f = s.sample(xi);
    EXPECT_NEAR(f.velocity, u, 1e-11);
    EXPECT_NEAR(f.density, std::pow(c / c0, 5.0), 1e-11);
    EXPECT_NEAR(f.pressure, std::pow(c / c0, 7.0), 1e-11);
  }
  EXPECT_EQ(s.sample(-2.0).pressure, pressure_of(gas(1, 0, 1)));
  EXPECT_EQ(s.sample(1.0).pressure, s.pressure());
  EXPECT_EQ(s.sample(1.0).density, s.star(1).density);
  EXPECT_EQ(s.sample(2.0).density, 0.125);
}

TEST(Riemann, GasesLeaveAVacuum) {
  const double c = std::sqrt(1.4 * 0.4);
  const RiemannSolution s(gas(1, -4, 0.4), gas(1, 4, 0.4));
  ASSERT_TRUE(s.cavity());
  EXPECT_NEAR(s.star(1).velocity, 4.0 - 5.0 * c, 1e-6);
  EXPECT_NEAR(s.star(0).velocity, -s.star(1).velocity, 1e-12);
  EXPECT_EQ(s.sample(0.01).density, 0.0);
  EXPECT_EQ(s.sample(0.01).side, -1);
  // The fan's closed form, deep in it.
  const double xi = s.star(1).velocity + 0.1;
  const double local = c + (xi - 4.0 - c) / 6.0;
  EXPECT_NEAR(s.sample(xi).density / std::pow(local / c, 5.0), 1.0, 1e-6);
}

TEST(Riemann, Sjoegreen) {
  // Barotropic gas, p0 = 0.4, rho0 = 1, gamma 1.4: both waves are rarefactions, closed form.
  const RiemannSolution s({fluid("sjogreen-gas"), 1, -2}, {fluid("sjogreen-gas"), 1, 2});
  EXPECT_NEAR(s.pressure(), 0.00189387, 5e-9);
  EXPECT_NEAR(s.star(1).density, 0.0218521, 5e-8);
  EXPECT_NEAR(s.velocity(), 0.0, 1e-13);
  EXPECT_NEAR(0.15 * s.head(1), 0.41225, 5e-6);
  EXPECT_NEAR(0.15 * s.tail(1), 0.05225, 5e-6);
  // With gamma 2 there is a vacuum: it begins where u = 2 - 2 c.
  const RiemannSolution v({fluid("sjogreen-gas-gamma2"), 1, -2}, {fluid("sjogreen-gas-gamma2"), 1, 2});
  ASSERT_TRUE(v.cavity());
  EXPECT_NEAR(v.star(1).velocity, 2.0 - 2.0 * std::sqrt(0.8), 1e-9);
}

TEST(Riemann, BarotropicShockKeepsMassAndMomentum) {
  const RiemannSide left{fluid("bubble-gas"), 1770.0, 0.0}, right{fluid("water-tait"), 1000.0, 0.0};
  const RiemannSolution s(left, right);
  ASSERT_TRUE(s.shock(1));
  ASSERT_FALSE(s.shock(0));
  const Fluxes ahead = fluxes(1000.0, 0.0, pressure_of(right), 0.0, s.head(1));
  const Fluxes behind = fluxes(s.star(1).density, s.velocity(), s.pressure(), 0.0, s.head(1));
  EXPECT_NEAR(behind.mass / ahead.mass, 1.0, 1e-11);
  EXPECT_NEAR(behind.momentum, ahead.momentum, 1e-9 * s.pressure());
  // Gas: gamma = 2, so u = 2 (c0 - c); the water's pressure by Tait's formula.
  const double c0 = std::sqrt(2.0 * 2e9 / 1770.0), c = c0 * std::sqrt(s.star(0).density / 1770.0);
  EXPECT_NEAR(s.velocity(), 2.0 * (c0 - c), 1e-8 * c0);
  EXPECT_NEAR(s.pressure(), 3.31e8 * (std::pow(s.star(1).density / 1000.0, 7.15) - 1.0) + 1e5, 1e-8 * s.pressure());
}

TEST(Riemann, CavitatingTube) {
  // 1 m of water torn apart at +-100 m/s, seen after 0.2 ms. Liquid: Tait in closed form. Mixture: the speed
  // gained is the integral of a drho/rho with the mixture's own slope, here by a plain sum.
  const FluidLaw law = fluid("water-tait");
  const auto& tait = std::get<materials::TaitWater>(law);
  const double rho = materials::density_at(law, 1e5, 0.0), t = 2e-4;
  const RiemannSolution s({law, rho, -100.0}, {law, rho, 100.0});
  ASSERT_TRUE(s.cavity());
  EXPECT_NEAR(s.head(1) * t, 0.32768, 5e-6);
  EXPECT_NEAR(s.star(1).velocity * t, 0.01998, 5e-6);
  EXPECT_NEAR(s.star(1).pressure, 1e-5, 1e-9);
  double gained = (tait.evaluate(rho, 0).sound_speed - tait.evaluate(tait.liquid_limit(), 0).sound_speed) * 2.0 / 6.15;
  const double liquid = 100.0 - gained;
  // Down to the floor, with spacing that is even in the root of the expansion: a is steep at its start.
  const double depth = std::log(tait.liquid_limit() / tait.floor_density());
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double from = std::pow(double(i) / n, 3), to = std::pow(double(i + 1) / n, 3);
    gained += depth * (to - from) * tait.evaluate(tait.liquid_limit() * std::exp(-0.5 * depth * (from + to)), 0).sound_speed;
  }
  EXPECT_NEAR(s.star(1).velocity, 100.0 - gained, 1e-6);
  // Across the liquid's part of the fan, 0.063 m/s; with the plateau of the literal formula 0.084 to the
  // foot.
  EXPECT_NEAR(100.0 - liquid, (1e5 - 3165.0) / (1000.0 * 1538.3), 1e-4);
  EXPECT_EQ(s.sample(0.0).side, -1);
  // Mixture next to the cavity: the void fraction which the page of the scene gives as the largest outside of
  // it.
  const RiemannSample edge = s.sample(s.star(1).velocity + 1e-3);
  EXPECT_NEAR(tait.void_fraction(edge.density), 2.75e-4, 0.05e-4);
  double last = 0.0;
  for (double x = s.star(1).velocity; x < 1700.0; x += 0.37) {
    const RiemannSample f = s.sample(x);
    EXPECT_GE(f.pressure, last);
    last = f.pressure;
  }
}

TEST(Riemann, ShockIntoACavitatedLiquid) {
  // Liquid hits water which has been expanded to one half: closed mass and momentum balance, and the floor
  // ahead.
  const FluidLaw law = fluid("water-tait");
  const RiemannSide left{law, 1000.0, 50.0}, right{law, 500.0, 0.0};
  const RiemannSolution s(left, right);
  ASSERT_TRUE(s.shock(1));
  const Fluxes ahead = fluxes(500.0, 0.0, pressure_of(right), 0.0, s.head(1));
  const Fluxes behind = fluxes(s.star(1).density, s.velocity(), s.pressure(), 0.0, s.head(1));
  EXPECT_NEAR(behind.mass / ahead.mass, 1.0, 1e-10);
  EXPECT_NEAR(behind.momentum, ahead.momentum, 1e-9 * s.pressure());
  EXPECT_LT(s.velocity(), 50.0);
}

TEST(Riemann, JwlAgainstMieGrueneisenWaterByResiduals) {
  const FluidLaw petn = fluid("petn"), water = fluid("water-steinberg");
  const RiemannSide left{petn, 1770.0, 0.0, std::get<materials::Jwl>(petn).parameters().E0};
  const RiemannSide right{water, 1000.0, 0.0, 100.0};
  const RiemannSolution s(left, right);
  ASSERT_TRUE(s.shock(1));
  ASSERT_FALSE(s.shock(0));
  const double p0 = pressure_of(right);
  const Fluxes ahead = fluxes(1000.0, 0.0, p0, 100.0, s.head(1));
  const Fluxes behind = fluxes(s.star(1).density, s.velocity(), s.pressure(), s.star(1).energy, s.head(1));
  EXPECT_NEAR(behind.mass / ahead.mass, 1.0, 1e-11);
  EXPECT_NEAR(behind.momentum, ahead.momentum, 1e-9 * s.pressure());
  EXPECT_NEAR(behind.energy, ahead.energy, 1e-9 * s.pressure() * s.velocity());
  const auto& mg = std::get<materials::MieGruneisenWater>(water);
  EXPECT_NEAR(mg.evaluate(s.star(1).density, s.star(1).energy).pressure, s.pressure(), 1e-9 * s.pressure());
  // The JWL's isentropes are known: p = A exp(-R1 v) + B exp(-R2 v) + C v^-(1 + omega), v = rho0/rho.
  const auto& j = std::get<materials::Jwl>(petn).parameters();
  const double C = pressure_of(left) - j.A * std::exp(-j.R1) - j.B * std::exp(-j.R2);
  for (const double share : {0.2, 0.6, 1.0}) {
    const RiemannSample f = s.sample(s.head(0) + share * (s.tail(0) - s.head(0)));
    const double v = 1770.0 / f.density;
    const double closed = j.A * std::exp(-j.R1 * v) + j.B * std::exp(-j.R2 * v) + C * std::pow(v, -1.25);
    EXPECT_NEAR(f.pressure, closed, 1e-9 * closed);
  }
  // The integral form of the conservation laws over [-X, X] after one second, by a midpoint sum of the
  // sampled state.
  const double X = 8000.0;
  const int n = 200000;
  double mass = 0, momentum = 0, energy = 0;
  for (int i = 0; i < n; ++i) {
    const RiemannSample f = s.sample(-X + (i + 0.5) * 2.0 * X / n);
    mass += f.density * 2.0 * X / n;
    momentum += f.density * f.velocity * 2.0 * X / n;
    energy += f.density * (f.energy + 0.5 * f.velocity * f.velocity) * 2.0 * X / n;
  }
  EXPECT_NEAR(mass, 2770.0 * X, 2e-5 * 2770.0 * X);
  EXPECT_NEAR(momentum, pressure_of(left) - p0, 2e-4 * pressure_of(left));
  EXPECT_NEAR(energy, (1770.0 * left.energy + 1000.0 * right.energy) * X, 2e-5 * 1770.0 * left.energy * X);
}

TEST(Riemann, MirroredProblemGivesMirroredAnswer) {
  const FluidLaw petn = fluid("petn"), water = fluid("water-tait");
  const RiemannSide explosive{petn, 1770.0, 30.0, 5.7e6}, liquid{water, 1010.0, -70.0};
  RiemannSide explosive_mirrored = explosive, liquid_mirrored = liquid;
  explosive_mirrored.velocity *= -1;
  liquid_mirrored.velocity *= -1;
  const RiemannSolution a(explosive, liquid), b(liquid_mirrored, explosive_mirrored);
  EXPECT_NEAR(a.pressure(), b.pressure(), 1e-12 * a.pressure());
  for (const double xi : {-4000.0, -3000.0, -1000.0, 0.0, 500.0, 2000.0, 6000.0}) {
    const RiemannSample f = a.sample(xi), g = b.sample(-xi);
    EXPECT_NEAR(f.density, g.density, 1e-9 * f.density) << xi;
    EXPECT_NEAR(f.velocity, -g.velocity, 1e-7) << xi;
  }
}

TEST(Riemann, TensionWhereItIsAllowed) {
  materials::TaitWater::Parameters p;
  p.cavitation = materials::Cavitation::none;
  const FluidLaw law = materials::TaitWater(p);
  const RiemannSolution s({law, 1000.0, -10.0}, {law, 1000.0, 10.0});
  EXPECT_FALSE(s.cavity());
  // Acoustic estimate 1e5 - rho c u = -15.3 MPa, softened by (N + 1)/4 M.
  EXPECT_NEAR(s.pressure(), 1e5 - 1000.0 * 1538.4 * 10.0, 0.03 * 15.4e6);
  const double c = std::sqrt(7.15 * (s.pressure() - 1e5 + 3.31e8) / s.star(1).density);
  EXPECT_NEAR(10.0, 2.0 / 6.15 * (std::sqrt(7.15 * 3.31e8 / 1000.0) - c), 1e-9);
}

TEST(Riemann, SteinbergWaterCavitatesOnItsFloor) {
  const FluidLaw law = fluid("water-steinberg");
  const RiemannSolution s({law, 1000.0, -100.0, 200.0}, {law, 1000.0, 100.0, 200.0});
  ASSERT_TRUE(s.cavity());
  EXPECT_NEAR(s.star(1).pressure, 1e-5, 1e-6);  // the last digit of the density is 2e-7 Pa
  EXPECT_NEAR(100.0 - s.star(1).velocity, 1e5 / (1000.0 * 1480.0), 2e-4);
}

TEST(Riemann, StiffenedGasIsTheIdealOneUnderPressure) {
  // With one gamma and p_inf on both sides p + p_inf obeys the equations of the ideal gas.
  const double inner = 6.0;
  const FluidLaw law = materials::StiffenedGas({.rho0 = 1.0, .gamma = 1.4, .p_inf = inner});
  const auto liquid = [&](double rho, double u, double p) {
    return RiemannSide{law, rho, u, (p - inner + 1.4 * inner) / (0.4 * rho)};
  };
  for (const double weak : {0.1, 5.0}) {
    const RiemannSolution s(liquid(1, 0, 10), liquid(0.125, 0.3, weak)), ideal(gas(1, 0, 10), gas(0.125, 0.3, weak));
    EXPECT_NEAR(s.pressure() + inner, ideal.pressure(), 1e-10 * ideal.pressure());
    EXPECT_NEAR(s.velocity(), ideal.velocity(), 1e-10 * ideal.velocity());
    for (const double xi : {-3.0, -1.0, 0.0, 1.0, 3.0, 8.0}) {
      EXPECT_NEAR(s.sample(xi).density, ideal.sample(xi).density, 1e-9) << xi;
      EXPECT_NEAR(s.sample(xi).pressure + inner, ideal.sample(xi).pressure, 1e-9 * ideal.pressure()) << xi;
    }
  }
}

TEST(Riemann, GasAgainstStiffenedWaterByResiduals) {
  // Air of 1 GPa against water of 1 bar: laws of both sides differ, the shock in the water keeps mass, momentum, energy.
  const FluidLaw water = materials::StiffenedGas({.rho0 = 1000.0, .gamma = 4.4, .p_inf = 6e8});
  const RiemannSide left{ideal_gas, 500.0, 0.0, 5e6}, right{water, 1000.0, 0.0, (1e5 + 4.4 * 6e8) / 3.4e3};
  const RiemannSolution s(left, right);
  ASSERT_TRUE(s.shock(1));
  ASSERT_FALSE(s.shock(0));
  const double D = s.head(1);
  const RiemannSample behind = s.star(1);
  const Fluxes before = fluxes(1000.0, 0.0, 1e5, right.energy, D),
               after = fluxes(behind.density, behind.velocity, behind.pressure, behind.energy, D);
  EXPECT_NEAR(after.mass / before.mass, 1.0, 1e-10);
  EXPECT_NEAR(after.momentum, before.momentum, 1e-9 * std::abs(before.momentum) + 1e-9 * behind.pressure);
  EXPECT_NEAR(after.energy, before.energy, 1e-9 * std::abs(before.energy));
  EXPECT_NEAR(s.star(0).pressure, behind.pressure, 1e-9 * behind.pressure);
}

TEST(Riemann, RefusesNoDensity) { EXPECT_THROW(RiemannSolution(gas(0.0, 0, 1), gas(1, 0, 1)), std::invalid_argument); }

TEST(Riemann, NothingHappensInEqualStates) {
  const RiemannSolution s(gas(1, 3, 1), gas(1, 3, 1));
  EXPECT_NEAR(s.pressure(), 1.0, 1e-12);
  EXPECT_NEAR(s.velocity(), 3.0, 1e-12);
  for (const double xi : {-1.0, 1.7, 2.9, 3.1, 4.3, 9.0}) EXPECT_NEAR(s.sample(xi).density, 1.0, 1e-9) << xi;
}

}  // namespace
}  // namespace undex::exact
