// Bubble gas, ideal gas and the general questions asked of any fluid law.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "law_checks.hpp"
#include "materials/equation_of_state.hpp"

namespace undex::materials {
namespace {

TEST(BarotropicGas, PaperBubble) {
  const BarotropicGas gas({.rho0 = 1770.0, .p0 = 2e9, .gamma = 2.0});
  EXPECT_EQ(gas.evaluate(1770.0, 0.0).pressure, 2e9);
  EXPECT_NEAR(gas.evaluate(885.0, 0.0).pressure, 0.5e9, 1e-3);
  // Eq. 26.
  EXPECT_NEAR(gas.evaluate(885.0, 0.0).sound_speed, std::sqrt(2e9 * 2.0 / 1770.0 * 0.5), 1e-9);
  EXPECT_NEAR(gas.barotropic_energy(1770.0), 2e9 / 1770.0, 1e-6);
}

TEST(BarotropicGas, ShortcutForTwoIsThePower) {
  const BarotropicGas two({.rho0 = 3.0, .p0 = 7.0, .gamma = 2.0});
  const BarotropicGas nearly({.rho0 = 3.0, .p0 = 7.0, .gamma = 2.0 + 1e-13});
  EXPECT_NEAR(two.evaluate(5.1, 0.0).pressure, nearly.evaluate(5.1, 0.0).pressure, 1e-10);
}

TEST(BarotropicGas, SlopeEnergyInverseMonotone) {
  for (const double gamma : {1.4, 2.0, 3.0}) {
    const BarotropicGas gas({.rho0 = 1.0, .p0 = 0.4, .gamma = gamma});
    double last = 0.0;
    for (const double rho : {1e-3, 0.02, 0.5, 1.0, 4.0}) {
      const PressureSound s = gas.evaluate(rho, 0.0);
      EXPECT_NEAR(test::isentropic_slope(gas, rho, 0.0), s.sound_speed * s.sound_speed, 1e-8 * s.sound_speed * s.sound_speed);
      EXPECT_NEAR(gas.density_at(s.pressure), rho, 1e-12 * rho);
      EXPECT_GT(s.pressure, last);
      last = s.pressure;
    }
    EXPECT_NEAR(gas.barotropic_energy(2.0) - gas.barotropic_energy(0.01), test::compression_work(gas, 0.01, 2.0), 1e-10);
    EXPECT_LT(gas.barotropic_energy(1e-20), 1e-7);  // zero at infinite expansion
    EXPECT_GT(gas.evaluate(1e-30, 0.0).sound_speed, 0.0);
  }
}

TEST(BarotropicGas, Refusals) {
  EXPECT_THROW(BarotropicGas({.rho0 = 1.0, .p0 = 1.0, .gamma = 1.0}), std::invalid_argument);
  EXPECT_THROW(BarotropicGas({.rho0 = 0.0, .p0 = 1.0, .gamma = 2.0}), std::invalid_argument);
  EXPECT_THROW(BarotropicGas({.rho0 = 1.0, .p0 = -1.0, .gamma = 2.0}), std::invalid_argument);
  EXPECT_THROW(BarotropicGas({.rho0 = 1.0, .p0 = 1.0, .gamma = 2.0}).density_at(0.0), std::domain_error);
}

TEST(IdealGas, AirAtRoomConditions) {
  const IdealGas gas({.rho0 = 1.204, .gamma = 1.4});
  const double e = 101325.0 / (0.4 * 1.204);
  EXPECT_NEAR(gas.evaluate(1.204, e).pressure, 101325.0, 1e-6);
  EXPECT_NEAR(gas.evaluate(1.204, e).sound_speed, 343.2, 0.1);
  EXPECT_NEAR(gas.density_at(101325.0, e), 1.204, 1e-12);
}

TEST(IdealGas, SlopeAndGuard) {
  const IdealGas gas({.rho0 = 1.0, .gamma = 5.0 / 3.0});
  for (const double rho : {0.01, 1.0, 6.0}) {
    const double c = gas.evaluate(rho, 2.5e5).sound_speed;
    EXPECT_NEAR(test::isentropic_slope(gas, rho, 2.5e5), c * c, 1e-7 * c * c);
  }
  EXPECT_GT(gas.evaluate(1.0, 0.0).sound_speed, 0.0);
  EXPECT_GT(gas.evaluate(1.0, -10.0).sound_speed, 0.0);
  EXPECT_LT(gas.evaluate(1.0, -10.0).pressure, 0.0);  // not hidden
  EXPECT_THROW(gas.density_at(1e5, 0.0), std::domain_error);
  EXPECT_THROW(IdealGas({.rho0 = 1.0, .gamma = 1.0}), std::invalid_argument);
}

TEST(FluidLaw, SaysWhetherItNeedsAnEnergy) {
  EXPECT_FALSE(uses_energy(TaitWater(TaitWater::Parameters{})));
  EXPECT_FALSE(uses_energy(BarotropicGas({.rho0 = 1.0, .p0 = 1.0, .gamma = 2.0})));
  EXPECT_TRUE(uses_energy(IdealGas({.rho0 = 1.0, .gamma = 1.4})));
  EXPECT_TRUE(uses_energy(MieGruneisenWater(MieGruneisenWater::Parameters{})));
}

TEST(FluidLaw, DensityAtNamesTheLawAndItsRange) {
  const FluidLaw water = TaitWater(TaitWater::Parameters{});
  EXPECT_NEAR(density_at(water, 1e5, 0.0), 1000.0, 1e-10);
  try {
    density_at(water, -5.0, 0.0);
    FAIL() << "a tension below the floor has no density";
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("Tait"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("1e-05"), std::string::npos) << error.what();
  }
  const FluidLaw steinberg = MieGruneisenWater(MieGruneisenWater::Parameters{});
  try {
    density_at(steinberg, 1e12, 0.0);
    FAIL() << "beyond the fold";
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("Mie-Grueneisen"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace undex::materials
