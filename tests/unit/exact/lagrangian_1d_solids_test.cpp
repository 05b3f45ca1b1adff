// Layers of solids in the one-dimensional solver: conservation, elastic and plastic waves of exact speed and stress, shells that
// breathe and that flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "exact/lagrangian_1d.hpp"
#include "materials/library.hpp"

namespace undex::exact {
namespace {

using materials::Solid;

constexpr double density = 2700, bulk = 70e9, shear = 26e9;

Solid metal(double yield) {
  Solid solid{.name = "metal",
              .source = "",
              .rho0 = density,
              .shear_modulus = shear,
              .pressure = materials::LinearPressure{bulk},
              .flow = materials::Elastic{},
              .spall = {},
              .damage = {}};
  if (yield > 0) solid.flow = materials::LinearHardening{.Y0 = yield, .H = 0};
  return solid;
}

TEST(Lagrangian1DSolids, ChargeCaseAndWaterKeepTheirEnergyAndMass) {
  const materials::FluidLaw petn = materials::find_fluid("petn")->law, water = materials::find_fluid("water-tait")->law;
  const double energy = std::get<materials::Jwl>(petn).parameters().E0;
  for (const int d : {1, 3}) {
    Lagrangian1D s(d, {{.law = petn, .outer = 0.01, .cells = 60, .density = 1770, .energy = energy},
                       {.law = metal(3e8), .inner = 0.01, .outer = 0.012, .cells = 20, .density = density},
                       {.law = water, .inner = 0.012, .outer = 0.03, .cells = 80, .density = 1000}});
    const double start = s.total_energy();
    double mass = 0;
    for (const double m : s.cell_mass()) mass += m;
    s.advance(10e-6);
    EXPECT_NEAR(s.total_energy() / start, 1.0, 1e-13) << d;
    s.coarsen(1e-3);
    EXPECT_LT(s.cells(), 160);
    EXPECT_NEAR(s.total_energy() / start, 1.0, 1e-13) << d;
    double after = 0;
    for (const double m : s.cell_mass()) after += m;
    EXPECT_NEAR(after / mass, 1.0, 1e-14);
    s.advance(20e-6);
    EXPECT_NEAR(s.total_energy() / start, 1.0, 1e-13) << d;
    double plastic = 0;
    for (const double work : s.solids().plastic_energy) plastic += work;
    EXPECT_GT(plastic, 0.0);
  }
}

/// Two halves of a bar of infinite width meet at 2 v: stress rho c v behind waves of the speed c, or, where that yields, an
/// elastic precursor of Y (K + 4/3 G)/(2 G) and a plastic wave of the speed sqrt(K/rho).
TEST(Lagrangian1DSolids, PlaneImpactHasItsElasticAndItsPlasticWave) {
  const double fast = std::sqrt((bulk + 4.0 / 3.0 * shear) / density), slow = std::sqrt(bulk / density);
  for (const double yield : {0.0, 3e8}) {
    const double v = 50.0, time = 6e-6;
    const auto solve = [&](int cells) {
      Lagrangian1D s(1, {{.law = metal(yield), .outer = 0.06, .cells = cells, .density = density, .velocity = -v}},
                     Boundary::rigid, Boundary::free);
      s.advance(time);
      return s;
    };
    const Lagrangian1D s = solve(600);
    const auto stress = [&](double r) {  // compression along x
      const auto cell = std::upper_bound(s.node_radius().begin(), s.node_radius().end(), r) - s.node_radius().begin() - 1;
      return s.cell_pressure()[cell] - s.solids().deviator[cell];
    };
    const double first = yield > 0 ? yield * (bulk + 4.0 / 3.0 * shear) / (2.0 * shear) : density * fast * v;
    const double behind = yield > 0 ? first + density * slow * (v - first / (density * fast)) : first;
    EXPECT_NEAR(stress(0.5 * slow * time) / behind, 1.0, 5e-3) << yield;
    EXPECT_NEAR(stress(0.5 * (slow + fast) * time) / first, 1.0, 1e-2) << yield;
    EXPECT_NEAR(stress(1.05 * fast * time) / first, 0.0, 1e-3) << yield;
  }
}

/// A thin spherical shell breathes at the frequency sqrt(2 E/((1 - nu) rho))/R.
TEST(Lagrangian1DSolids, ThinShellBreathes) {
  const double E = 9 * bulk * shear / (3 * bulk + shear), nu = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
  const double radius = 0.1, thick = 1e-3, v = 0.1;
  const double period = 2 * std::numbers::pi * radius / std::sqrt(2 * E / ((1 - nu) * density));
  Lagrangian1D s(3,
                 {{.law = metal(0),
                   .inner = radius - thick / 2,
                   .outer = radius + thick / 2,
                   .cells = 8,
                   .density = density,
                   .velocity = v}},
                 Boundary::free, Boundary::free);
  const double start = s.total_energy();
  // Outermost where the mean velocity changes sign, a quarter of a period after the start; and half a period later again.
  const auto turns = [&](double sign) {
    double before = s.time(), u_before = s.integral(0, 1).velocity();
    while (true) {
      s.step_towards(1.0);
      const double u = s.integral(0, 1).velocity();
      if (sign * u < 0) return before + (s.time() - before) * u_before / (u_before - u);
      before = s.time();
      u_before = u;
    }
  };
  const double out = turns(1), in = turns(-1);
  EXPECT_NEAR(2 * (in - out) / period, 1.0, 3e-3);
  EXPECT_NEAR(s.total_energy() / start, 1.0, 1e-12);
}

/// A thin shell thrown outwards comes to rest when plastic flow has taken its kinetic energy: rho v^2/2 = Y 2 ln(R1/R0), the
/// elastic part, Y^2 (1 - nu)/E, aside.
TEST(Lagrangian1DSolids, ThrownShellIsStoppedByItsStrength) {
  const double yield = 3e8, radius = 0.1, thick = 1e-3, v = 150;
  Lagrangian1D s(3,
                 {{.law = metal(yield),
                   .inner = radius - thick / 2,
                   .outer = radius + thick / 2,
                   .cells = 10,
                   .density = density,
                   .velocity = v}},
                 Boundary::free, Boundary::free);
  const double kinetic = s.kinetic_energy();
  while (s.integral(0, 1).velocity() > 0) s.step_towards(1.0);
  const double E = 9 * bulk * shear / (3 * bulk + shear), nu = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
  const double elastic = yield * yield * (1 - nu) / E;  // per volume, of equal biaxial stress Y
  const double logarithm = (0.5 * density * v * v - elastic) / (2 * yield) + (1 - nu) * yield / E;
  const double now = std::cbrt(0.5 * (std::pow(s.node_radius().front(), 3) + std::pow(s.node_radius().back(), 3)));
  EXPECT_NEAR(std::log(now / radius) / logarithm, 1.0, 5e-3);
  double plastic = 0;
  for (const double work : s.solids().plastic_energy) plastic += work;
  EXPECT_NEAR(plastic / kinetic, 1.0 - elastic / (0.5 * density * v * v), 5e-3);
}

TEST(Lagrangian1DSolids, NoneInCylindricalSymmetry) {
  EXPECT_THROW(Lagrangian1D(2, {{.law = metal(0), .outer = 1, .cells = 4, .density = density}}), std::invalid_argument);
}

}  // namespace
}  // namespace undex::exact
