// Stiffened gas: the ideal gas under an inner pressure.
#include "materials/stiffened_gas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "law_checks.hpp"
#include "materials/gas.hpp"

namespace undex::materials {
namespace {

TEST(StiffenedGas, WithoutInnerPressureIsTheIdealGas) {
  const StiffenedGas stiffened({.rho0 = 1.0, .gamma = 1.4, .p_inf = 0.0});
  const IdealGas ideal({.rho0 = 1.0, .gamma = 1.4});
  for (const double rho : {0.1, 1.0, 700.0})
    for (const double energy : {1e3, 2.5e5}) {
      const PressureSound a = stiffened.evaluate(rho, energy), b = ideal.evaluate(rho, energy);
      EXPECT_NEAR(a.pressure, b.pressure, 1e-14 * b.pressure);
      EXPECT_NEAR(a.sound_speed, b.sound_speed, 1e-14 * b.sound_speed);
    }
}

TEST(StiffenedGas, SoundIsTheIsentropicSlope) {
  const StiffenedGas water({.rho0 = 1000.0, .gamma = 4.4, .p_inf = 6e8});
  for (const double rho : {900.0, 1000.0, 1300.0}) {
    const double energy = (1e9 + 4.4 * 6e8) / (3.4 * rho);
    const PressureSound s = water.evaluate(rho, energy);
    EXPECT_NEAR(s.pressure, 1e9, 1.0);
    EXPECT_NEAR(test::isentropic_slope(water, rho, energy), s.sound_speed * s.sound_speed, 1e-6 * s.sound_speed * s.sound_speed);
    EXPECT_NEAR(water.density_at(s.pressure, energy), rho, 1e-9 * rho);
  }
}

/// Noble-Abel stiffened gas, with a volume of its molecules.
TEST(StiffenedGas, SoundIsTheIsentropicSlopeWithMolecules) {
  const StiffenedGas water({.rho0 = 1000.0, .gamma = 1.19, .p_inf = 702.8e6, .b = 6.61e-4, .q = -1177788});
  for (const double rho : {900.0, 1000.0, 1300.0}) {
    const double energy = water.energy_at(1e9, rho);
    const PressureSound s = water.evaluate(rho, energy);
    EXPECT_NEAR(s.pressure, 1e9, 1.0);
    EXPECT_NEAR(test::isentropic_slope(water, rho, energy), s.sound_speed * s.sound_speed, 1e-6 * s.sound_speed * s.sound_speed);
    EXPECT_NEAR(water.density_at(s.pressure, energy), rho, 1e-9 * rho);
  }
  EXPECT_GT(water.evaluate(1600.0, 1e6).pressure, 1e11) << "beyond 1/b it stays stiff";
}

TEST(StiffenedGas, RefusesWhatItCannotBe) {
  EXPECT_THROW(StiffenedGas({.rho0 = 0.0, .gamma = 4.4, .p_inf = 6e8}), std::invalid_argument);
  EXPECT_THROW(StiffenedGas({.rho0 = 1.0, .gamma = 1.0, .p_inf = 6e8}), std::invalid_argument);
  EXPECT_THROW(StiffenedGas({.rho0 = 1.0, .gamma = 4.4, .p_inf = -1.0}), std::invalid_argument);
  EXPECT_THROW(StiffenedGas({.rho0 = 1000.0, .gamma = 1.2, .p_inf = 7e8, .b = 1e-3}), std::invalid_argument);
  EXPECT_THROW(StiffenedGas({.rho0 = 1.0, .gamma = 4.4, .p_inf = 1.0, .b = -1e-3}), std::invalid_argument);
  const StiffenedGas water({.rho0 = 1000.0, .gamma = 4.4, .p_inf = 6e8});
  EXPECT_THROW(water.density_at(1e5, 0.0), std::domain_error);
  EXPECT_THROW(water.density_at(-4.4 * 6e8, 1e6), std::domain_error);
  EXPECT_GT(water.evaluate(1000.0, 0.0).sound_speed, 0.0);  // -gamma p_inf, no state of equilibrium
}

}  // namespace
}  // namespace undex::materials
