// Columns at rest against their closed forms.
#include "materials/hydrostatic.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace undex::materials {
namespace {

constexpr double g = 9.81;

TEST(Hydrostatic, IsothermalAirIsExponential) {
  const double energy = 2e5, scale_height = 0.4 * energy / g;  // p/rho = (gamma - 1) e
  const HydrostaticColumn air(IdealGas({.rho0 = 1.2, .gamma = 1.4}), energy, 1e5, g, -3e3, 5e2);
  for (const double depth : {-3e3, -1234.56, -1.0, 0.0, 77.7, 5e2}) {
    const double p = 1e5 * std::exp(depth / scale_height);
    EXPECT_NEAR(air.pressure(depth), p, 1e-11 * p) << depth;
    EXPECT_NEAR(air.density(depth), p / (0.4 * energy), 1e-11 * p) << depth;
  }
}

TEST(Hydrostatic, TaitWaterByItsEnthalpy) {
  // dp/rho = g ds and dp = B N rho^(N-1)/rho0^N drho: B N/((N-1) rho0) (rho/rho0)^(N-1) grows by g times the depth.
  const TaitWater::Parameters q;
  const double base = q.B * q.N / ((q.N - 1) * q.rho0), surface = std::pow(1 + (2e5 - q.A) / q.B, (q.N - 1) / q.N);
  const HydrostaticColumn water(TaitWater(q), 0, 2e5, g, -5, 11000);  // of the deepest sea
  for (const double depth : {-5.0, 0.0, 10.0, 4000.0, 11000.0}) {
    const double ratio = std::pow(surface + g * depth / base, 1 / (q.N - 1));
    EXPECT_NEAR(water.density(depth), q.rho0 * ratio, 1e-11 * q.rho0) << depth;
    EXPECT_NEAR(water.pressure(depth), q.A + q.B * (std::pow(ratio, q.N) - 1), 1e-6) << depth;  // of 1e8: round-off of the power
  }
}

TEST(Hydrostatic, LevelMayLieBesideTheColumn) {
  const FluidLaw water = TaitWater(TaitWater::Parameters{});
  const HydrostaticColumn below(water, 0, 1e5, g, 100, 101), all(water, 0, 1e5, g, 0, 101);
  EXPECT_NEAR(below.pressure(100.4), all.pressure(100.4), 1e-6);
}

TEST(Hydrostatic, NoWaterAboveWhereItsPressureEnds) {
  EXPECT_THROW(HydrostaticColumn(TaitWater(TaitWater::Parameters{}), 0, 1e5, g, -11, 0), std::domain_error);
  EXPECT_NO_THROW(HydrostaticColumn(TaitWater(TaitWater::Parameters{}), 0, 1e5, g, -10, 0));
}

}  // namespace
}  // namespace undex::materials
