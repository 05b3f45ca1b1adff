// Tait water and its cavitation models against differences, quadrature and hand-worked numbers.
#include "materials/tait_water.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "law_checks.hpp"
#include "materials/library.hpp"

namespace undex::materials {
namespace {

TaitWater water(Cavitation cavitation) {
  TaitWater::Parameters p;
  p.cavitation = cavitation;
  return TaitWater(p);
}

TEST(TaitWater, ReferenceState) {
  const TaitWater law = water(Cavitation::schmidt);
  const PressureSound s = law.evaluate(1000.0, 0.0);
  EXPECT_NEAR(s.pressure, 1e5, 1e-6);
  EXPECT_NEAR(s.sound_speed, 1538.4, 0.05);
  EXPECT_NEAR(s.sound_speed, std::sqrt(3.31e8 * 7.15 / 1000.0), 1e-9);
  EXPECT_EQ(law.void_fraction(1000.0), 0.0);
  EXPECT_NEAR(law.barotropic_energy(1000.0), 0.0, 1e-9);
}

TEST(TaitWater, CompressedPressureByHand) {
  // mu = 0.1: 3.31e8 (1.1^7.15 - 1) + 1e5, with 1.1^7 = 1.9487171 and 1.1^0.15 = 1.01439921.
  EXPECT_NEAR(water(Cavitation::schmidt).evaluate(1100.0, 0.0).pressure, 3.31e8 * (1.9487171 * 1.01439921 - 1.0) + 1e5, 1e2);
  EXPECT_NEAR(water(Cavitation::schmidt).evaluate(1100.0, 0.0).pressure, 323e6, 1e6);
}

TEST(TaitWater, EnergyArgumentDoesNotMatter) {
  const TaitWater law = water(Cavitation::schmidt);
  for (const double rho : {0.005, 500.0, 999.8, 1300.0})
    EXPECT_EQ(law.evaluate(rho, 0.0).pressure, law.evaluate(rho, 1e6).pressure);
}

TEST(TaitWater, PressureScaleOfThePaper) {
  EXPECT_NEAR(schmidt_pressure_scale(SchmidtMixture{}, 1000.0), 432.64, 0.005);
  const TaitWater law = water(Cavitation::schmidt);
  EXPECT_NEAR(law.pressure_scale(), 432.64 * law.liquid_limit() / 1000.0, 0.005);
}

TEST(TaitWater, SaturationDensityIsWhereTaitReachesIt) {
  const TaitWater law = water(Cavitation::schmidt);
  EXPECT_NEAR(law.liquid_limit(), 999.959, 5e-4);
  EXPECT_NEAR(law.evaluate(law.liquid_limit(), 0.0).pressure, 3165.0, 1e-6);
}

TEST(TaitWater, ContinuousAtSaturation) {
  const TaitWater law = water(Cavitation::schmidt);
  const double limit = law.liquid_limit();
  for (const double step : {1e-6, 1e-9, 1e-12}) {
    const PressureSound above = law.evaluate(limit * (1.0 + step), 0.0);
    const PressureSound below = law.evaluate(limit * (1.0 - step), 0.0);
    // Slopes above are c^2 = 2.4e6; below they are smaller. Round-off of p is 1e-6 Pa.
    EXPECT_NEAR(above.pressure, 3165.0, 2.5e6 * limit * step + 1e-5);
    EXPECT_NEAR(below.pressure, 3165.0, 2.5e6 * limit * step + 1e-5);
    EXPECT_GT(above.pressure, below.pressure);
  }
  // Sound speed: the only step is that between the constants of the two laws.
  EXPECT_NEAR(law.evaluate(limit, 0.0).sound_speed, 1538.2, 0.05);
  EXPECT_NEAR(law.evaluate(limit * (1 - 1e-14), 0.0).sound_speed, 1538.0, 0.01);
}

TEST(TaitWater, ContinuousAtFloor) {
  const TaitWater law = water(Cavitation::schmidt);
  const double floor = law.floor_density();
  EXPECT_EQ(law.evaluate(floor, 0.0).pressure, 1e-5);
  EXPECT_EQ(law.evaluate(floor * (1 - 1e-9), 0.0).pressure, 1e-5);
  EXPECT_NEAR(law.evaluate(floor * (1 + 1e-12), 0.0).pressure, 1e-5, 1e-5);
  const double above = law.evaluate(floor * (1 + 1e-10), 0.0).sound_speed;
  const double below = law.evaluate(floor * (1 - 1e-10), 0.0).sound_speed;
  EXPECT_NEAR(above, below, 1e-4 * above);
  EXPECT_NEAR(law.void_fraction(floor), 2.75e-4, 0.5e-6);
}

TEST(TaitWater, MixturePressureIsTheIntegralOfItsSoundSpeed) {
  // Eq. 30: dp = a_m^2 drho, with a_m of eq. 31 written out here.
  const TaitWater law = water(Cavitation::schmidt);
  const double rho_l = law.liquid_limit(), rho_v = 1e-5 * rho_l;
  const auto sound_squared = [&](double rho) {
    const double alpha = (rho - rho_l) / (rho_v - rho_l);
    return 1.0 / (rho * (alpha / (rho_v * 208.0 * 208.0) + (1 - alpha) / (rho_l * 1538.0 * 1538.0)));
  };
  const double from = law.floor_density() * (1 + 1e-12), to = rho_l;
  const int intervals = 400000;  // eq. 31 falls within a void fraction of 2e-7
  const double h = (to - from) / intervals;
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i)
    sum += (i == 0 || i == intervals ? 1.0 : (i % 2 ? 4.0 : 2.0)) * sound_squared(from + i * h);
  EXPECT_NEAR(sum * h / 3.0, 3165.0, 1e-3);
  for (const double rho : {rho_l * 0.99999, 999.8, 999.0, 500.0, 1.0, 0.0101}) {
    EXPECT_NEAR(law.evaluate(rho, 0.0).sound_speed, std::sqrt(sound_squared(rho)), 1e-6 * std::sqrt(sound_squared(rho))) << rho;
  }
}

TEST(TaitWater, FormulaWithoutFloorEndsAtMinusEightKilopascal) {
  TaitWater::Parameters p;
  p.p_floor = -1e5;  // never reached by the mixture
  const TaitWater law{p};
  EXPECT_NEAR(law.floor_density(), 1e-5 * law.liquid_limit(), 1e-12);
  EXPECT_NEAR(law.evaluate(0.01, 0.0).pressure, -8.5e3, 0.1e3);
  EXPECT_EQ(law.evaluate(1e-4, 0.0).pressure, law.evaluate(law.floor_density(), 0.0).pressure);
  EXPECT_NEAR(law.evaluate(1e-4, 0.0).sound_speed, 208.0, 1e-6);
}

TEST(TaitWater, VoidFraction) {
  const TaitWater law = water(Cavitation::schmidt);
  const double rho_l = law.liquid_limit();
  EXPECT_EQ(law.void_fraction(rho_l), 0.0);
  EXPECT_EQ(law.void_fraction(2000.0), 0.0);
  EXPECT_NEAR(law.void_fraction(0.5 * rho_l * (1 + 1e-5)), 0.5, 1e-12);
  EXPECT_NEAR(law.void_fraction(1e-5 * rho_l), 1.0, 1e-12);
  EXPECT_EQ(law.void_fraction(1e-4), 1.0);
  EXPECT_EQ(water(Cavitation::none).void_fraction(100.0), 0.0);
  const TaitWater cut = water(Cavitation::cutoff);
  EXPECT_NEAR(cut.void_fraction(0.25 * cut.liquid_limit()), 0.75, 1e-12);
  EXPECT_EQ(cut.void_fraction(cut.liquid_limit()), 0.0);
}

TEST(TaitWater, CutoffHoldsPressureAndLiquidSoundSpeed) {
  TaitWater::Parameters p;
  p.cavitation = Cavitation::cutoff;
  p.p_floor = 2000.0;
  const TaitWater law(p);
  const double limit = law.liquid_limit();
  EXPECT_NEAR(law.evaluate(limit, 0.0).pressure, 2000.0, 1e-6);
  EXPECT_EQ(law.evaluate(0.999 * limit, 0.0).pressure, 2000.0);
  EXPECT_EQ(law.evaluate(1.0, 0.0).pressure, 2000.0);
  EXPECT_NEAR(law.evaluate(1.0, 0.0).sound_speed, law.evaluate(limit, 0.0).sound_speed, 1e-9);
  EXPECT_GT(law.evaluate(limit * (1 + 1e-9), 0.0).pressure, 2000.0);
}

TEST(TaitWater, WithoutCavitationTensionGoesOn) {
  const TaitWater law = water(Cavitation::none);
  const double p = law.evaluate(950.0, 0.0).pressure;
  EXPECT_NEAR(p, 3.31e8 * (std::exp(7.15 * std::log(0.95)) - 1.0) + 1e5, 1.0);
  EXPECT_LT(p, -1e8);
  EXPECT_GT(law.evaluate(1e-60, 0.0).sound_speed, 0.0);
}

TEST(TaitWater, SoundSpeedIsTheSlope) {
  for (const Cavitation cavitation : {Cavitation::none, Cavitation::cutoff, Cavitation::schmidt, Cavitation::isentropic})
    for (const double rho : {1000.5, 1100.0, 1500.0}) {
      const double c = water(cavitation).evaluate(rho, 0.0).sound_speed;
      EXPECT_NEAR(test::isentropic_slope(water(cavitation), rho, 0.0), c * c, 1e-6 * c * c);
    }
  // In the mixture pressures are thousands of Pa over 0.27 kg/m^3: a smaller step.
  const TaitWater law = water(Cavitation::schmidt);
  for (const double share : {0.02, 0.3, 0.7, 0.98}) {
    const double rho = law.liquid_limit() + share * (law.floor_density() - law.liquid_limit());
    const double c = law.evaluate(rho, 0.0).sound_speed;
    EXPECT_NEAR(test::isentropic_slope(law, rho, 0.0, 1e-7), c * c, 2e-3 * c * c) << rho;
  }
}

TEST(TaitWater, PressureNeverFallsAndSoundIsPositive) {
  for (const Cavitation cavitation : {Cavitation::none, Cavitation::cutoff, Cavitation::schmidt, Cavitation::isentropic}) {
    const TaitWater law = water(cavitation);
    double last = -std::numeric_limits<double>::infinity();
    for (double rho = 1e-4; rho < 3000.0; rho *= 1.0003) {
      const PressureSound s = law.evaluate(rho, 0.0);
      EXPECT_GE(s.pressure, last) << rho;
      EXPECT_GT(s.sound_speed, 0.0) << rho;
      EXPECT_TRUE(std::isfinite(s.sound_speed)) << rho;
      last = s.pressure;
    }
  }
}

TEST(TaitWater, CompressionEnergyIsTheIntegralOfPressure) {
  for (const Cavitation cavitation : {Cavitation::none, Cavitation::cutoff, Cavitation::schmidt, Cavitation::isentropic}) {
    const TaitWater law = water(cavitation);
    EXPECT_NEAR(law.barotropic_energy(1400.0), test::compression_work(law, 1000.0, 1400.0), 1e-9 * law.barotropic_energy(1400.0));
  }
  // Through the mixture, from its limit to its floor, and on along the floor: pieces of smooth integrand
  // each.
  const TaitWater law = water(Cavitation::schmidt);
  const double limit = law.liquid_limit(), floor = law.floor_density();
  const double mixture_work = law.barotropic_energy(limit) - law.barotropic_energy(floor);
  EXPECT_NEAR(mixture_work, test::compression_work(law, floor * (1 + 1e-13), limit * (1 - 1e-13)), 1e-6 * mixture_work);
  EXPECT_GT(mixture_work, 0.0);
  EXPECT_NEAR(law.barotropic_energy(floor) - law.barotropic_energy(0.1), 1e-5 * (1 / 0.1 - 1 / floor), 1e-10);
  const double liquid_work = law.barotropic_energy(1000.0) - law.barotropic_energy(limit);
  EXPECT_NEAR(liquid_work, test::compression_work(law, limit, 1000.0), 1e-6 * liquid_work);
}

TEST(TaitWater, FloorEnergyWithALargeFloorPressure) {
  TaitWater::Parameters p;
  p.p_floor = 3000.0;
  for (const Cavitation cavitation : {Cavitation::cutoff, Cavitation::schmidt}) {
    p.cavitation = cavitation;
    const TaitWater law(p);
    EXPECT_NEAR(law.barotropic_energy(500.0) - law.barotropic_energy(250.0), 3000.0 * (1 / 250.0 - 1 / 500.0), 1e-9);
    const double floor = law.floor_density();
    EXPECT_NEAR(law.barotropic_energy(floor * (1 + 1e-12)), law.barotropic_energy(floor * (1 - 1e-12)), 1e-9);
  }
}

TEST(TaitWater, DensityInvertsPressure) {
  for (const Cavitation cavitation : {Cavitation::none, Cavitation::cutoff, Cavitation::schmidt, Cavitation::isentropic}) {
    const TaitWater law = water(cavitation);
    for (const double rho : {999.97, 1000.0, 1001.0, 1100.0, 1800.0})
      EXPECT_NEAR(law.density_at(law.evaluate(rho, 0.0).pressure), rho, 1e-11 * rho);
    for (const double pressure : {1.0, 500.0, 3164.999, 3165.0, 3165.001, 1e5, 1e9})
      EXPECT_NEAR(law.evaluate(law.density_at(pressure), 0.0).pressure, pressure, 1e-6 + 1e-12 * pressure);
  }
  EXPECT_NEAR(water(Cavitation::none).evaluate(water(Cavitation::none).density_at(-1e8), 0.0).pressure, -1e8, 1e-3);
}

TEST(TaitWater, DensityAtTheFloorIsTheLargest) {
  const TaitWater schmidt = water(Cavitation::schmidt), cut = water(Cavitation::cutoff);
  EXPECT_EQ(schmidt.density_at(1e-5), schmidt.floor_density());
  EXPECT_EQ(cut.density_at(1e-5), cut.liquid_limit());
}

TEST(TaitWater, UnreachablePressuresThrow) {
  EXPECT_THROW(water(Cavitation::schmidt).density_at(0.0), std::domain_error);
  EXPECT_THROW(water(Cavitation::cutoff).density_at(-1.0), std::domain_error);
  EXPECT_THROW(water(Cavitation::none).density_at(1e5 - 3.31e8), std::domain_error);
  EXPECT_THROW(water(Cavitation::none).density_at(std::numeric_limits<double>::quiet_NaN()), std::domain_error);
}

TEST(TaitWater, RefusesImpossibleParameters) {
  const auto with = [](auto change) {
    TaitWater::Parameters p;
    change(p);
    return TaitWater(p);
  };
  EXPECT_THROW(with([](auto& p) { p.rho0 = 0.0; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.B = -1.0; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.N = 1.0; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.p_floor = 4000.0; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.p_floor = -4e8; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.mixture.density_ratio = 1.0; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.mixture.vapour_sound = 0.0; }), std::invalid_argument);
}

// ---- Isentropic mixture --------------------------------------------------------------------------------------------

TaitWater isentropic() { return std::get<TaitWater>(find_fluid("water-tait-isentropic")->law); }

TEST(IsentropicMixture, IsTheMixtureOfItsPhases) {
  // By hand, at a hundredth of the saturation pressure: k = 1e-5/(1 - 1e-5), steam thinner by 100^(1/1.33) = 31.893.
  const double k = 1e-5 / (1 - 1e-5), liquid = isentropic().liquid_limit(), steam = 2.31e-5 * liquid;
  const double stretched = k * std::pow(100.0, 1 / 1.33), liquid_now = std::pow((31.65 + 3.309e8) / (3165 + 3.309e8), -1 / 7.15);
  const double rho = (liquid + k * steam) / (liquid_now + stretched);
  EXPECT_NEAR(isentropic().density_at(31.65), rho, 1e-12 * rho);
  EXPECT_NEAR(isentropic().evaluate(rho, 0.0).pressure, 31.65, 1e-7);
  EXPECT_NEAR(isentropic().void_fraction(rho), stretched / (liquid_now + stretched), 1e-12);
  // Each phase on its own isentrope makes up the density: rho = alpha rho_g + (1 - alpha) rho_l.
  const double alpha = isentropic().void_fraction(rho);
  EXPECT_NEAR(alpha * steam * std::pow(0.01, 1 / 1.33) + (1 - alpha) * liquid / liquid_now, rho, 1e-12 * rho);
}

TEST(IsentropicMixture, ContinuousAtSaturation) {
  const TaitWater law = isentropic();
  const double limit = law.liquid_limit(), wet = law.density_at(3165.0 * (1 - 1e-12));
  EXPECT_NEAR((limit - wet) / limit, 1e-5, 1e-9) << "the first vapour appears at p_sat";
  for (const double rho : {limit * (1 + 1e-12), limit * (1 - 1e-12), 0.5 * (limit + wet), wet * (1 + 1e-12), wet * (1 - 1e-12)})
    EXPECT_NEAR(law.evaluate(rho, 0.0).pressure, 3165.0, 1e-2) << rho;
  // The liquid's energy is a difference of terms of 5e4 J/kg.
  for (const double rho : {limit, wet})
    EXPECT_NEAR(law.barotropic_energy(rho * (1 + 1e-12)), law.barotropic_energy(rho * (1 - 1e-12)), 1e-10);
  EXPECT_EQ(law.void_fraction(limit), 0.0);
  EXPECT_NEAR(law.void_fraction(wet * (1 - 1e-13)), 1e-5, 1e-9);
  EXPECT_NEAR(law.void_fraction(wet * (1 + 1e-13)), 1e-5, 1e-9);
}

TEST(IsentropicMixture, SoundIsTheSlopeAndWoods) {
  const TaitWater law = isentropic();
  for (const double p : {3164.0, 3000.0, 1000.0, 10.0, 0.1}) {
    const double rho = law.density_at(p), c = law.evaluate(rho, 0.0).sound_speed, step = 1e-4 * p;
    const double slope = 2 * step / (law.density_at(p + step) - law.density_at(p - step));
    EXPECT_NEAR(slope, c * c, 1e-6 * c * c) << p;
    const double alpha = law.void_fraction(rho);
    const double wood = alpha / (1.33 * p) + (1 - alpha) / (7.15 * (p + 3.309e8));
    EXPECT_NEAR(1 / (rho * c * c), wood, 1e-9 * wood) << p;
  }
  // Half vapour: a few metres per second, far below either phase.
  double low = 1e-3, high = 3000;
  for (int k = 0; k < 60; ++k) (law.void_fraction(law.density_at(0.5 * (low + high))) > 0.5 ? low : high) = 0.5 * (low + high);
  EXPECT_LT(law.evaluate(law.density_at(low), 0.0).sound_speed, 1.0);
}

TEST(IsentropicMixture, PressureRisesAllThrough) {
  const TaitWater law = isentropic();
  double last = 0;
  for (double rho = law.floor_density() * 1.0001; rho < law.liquid_limit() * (1 - 1.1e-5); rho *= 1.0003) {
    const double p = law.evaluate(rho, 0.0).pressure;
    EXPECT_GT(p, last) << rho;
    EXPECT_NEAR(law.density_at(p), rho, 1e-11 * rho);
    last = p;
  }
}

TEST(IsentropicMixture, EnergyIsTheWorkOfPressure) {
  const TaitWater law = isentropic();
  const double start = law.density_at(3165.0 * (1 - 1e-12));
  double from = start;
  for (const double p : {1000.0, 10.0, 0.1}) {
    const double to = law.density_at(p);
    const double work = law.barotropic_energy(from) - law.barotropic_energy(to);
    EXPECT_NEAR(work, test::compression_work(law, to, from, 200000), 1e-5 * work) << p;
    from = to;
  }
  EXPECT_LT(law.barotropic_energy(from), law.barotropic_energy(start));
}

TEST(IsentropicMixture, RefusesImpossibleParameters) {
  const auto with = [](auto change) {
    TaitWater::Parameters p;
    p.cavitation = Cavitation::isentropic;
    change(p);
    return TaitWater(p);
  };
  EXPECT_NO_THROW(with([](auto&) {}));
  EXPECT_THROW(with([](auto& p) { p.vapour_gamma = 1.0; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.initial_void = 0.0; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.initial_void = 1.0; }), std::invalid_argument);
  EXPECT_THROW(with([](auto& p) { p.p_floor = 0.0; }), std::invalid_argument);
}

}  // namespace
}  // namespace undex::materials
