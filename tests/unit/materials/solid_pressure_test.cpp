// Pressure laws of solids and the elastic wave speed.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/solid.hpp"

namespace undex::materials {
namespace {

constexpr MieGruneisenPressure aluminium{.C = 5300.0, .S = 1.5, .Gamma = 1.7};
constexpr double rho0 = 2710.0;

TEST(LinearPressure, PressureAndSound) {
  const LinearPressure law{164e9};
  EXPECT_EQ(evaluate(law, 7890.0, 7890.0, 1e5).pressure, 0.0);
  EXPECT_NEAR(evaluate(law, 7890.0, 7890.0 * 1.01, 0.0).pressure, 1.64e9, 1.0);
  EXPECT_NEAR(evaluate(law, 7890.0, 7890.0 * 0.99, 0.0).pressure, -1.64e9, 1.0);
  EXPECT_NEAR(evaluate(law, 7890.0, 7890.0, 0.0).bulk_sound, 4559.2, 0.1);
}

TEST(MieGruneisenPressure, RestStateAndHand) {
  const SolidPressureSound rest = evaluate(aluminium, rho0, rho0, 0.0);
  EXPECT_EQ(rest.pressure, 0.0);
  EXPECT_NEAR(rest.bulk_sound, 5300.0, 1e-9);
  // eta = 0.1: a0 = 76.1239 GPa, b0 = 2 a0, c0 = 1.75 a0; p_H = a0 (0.1 + 0.02 + 0.00175); 1 - 1.7*0.1/2 =
  // 0.915.
  EXPECT_NEAR(evaluate(aluminium, rho0, 1.1 * rho0, 0.0).pressure, 0.915 * 76.1239e9 * 0.12175, 1e4);
  // Tension is linear in p_H: eta = -0.1.
  EXPECT_NEAR(evaluate(aluminium, rho0, 0.9 * rho0, 0.0).pressure, -1.085 * 76.1239e9 * 0.1, 1e5);
  EXPECT_NEAR(evaluate(aluminium, rho0, 1.1 * rho0, 1e6).pressure - evaluate(aluminium, rho0, 1.1 * rho0, 0.0).pressure,
              1.7 * 1.1 * rho0 * 1e6, 1.0);
}

TEST(MieGruneisenPressure, CubicIsTheHugoniotToThirdOrder) {
  // U = C + S u gives p_H = rho0 C^2 eta (1 + eta)/(1 - (S - 1) eta)^2; on it e = p_H eta/(2 rho0 (1 + eta)),
  // and eq. 21 returns p_H for the printed weights to the order of the cubic. The error must fall like eta^4.
  const auto error = [](double eta) {
    const double exact = rho0 * 5300.0 * 5300.0 * eta * (1 + eta) / std::pow(1 - 0.5 * eta, 2);
    const double energy = 0.5 * exact * eta / (rho0 * (1 + eta));
    return std::abs(evaluate(aluminium, rho0, rho0 * (1 + eta), energy).pressure - exact);
  };
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 4.0, 0.1);
}

TEST(MieGruneisenPressure, SoundIsTheIsentropicSlope) {
  for (const double eta : {-0.2, -0.01, 0.01, 0.1, 0.4})
    for (const double energy : {0.0, 1e6}) {
      const double rho = rho0 * (1 + eta), h = 1e-5 * rho;
      const auto along = [&](double step) {
        const double half = rho + 0.5 * step;
        const double p = evaluate(aluminium, rho0, rho, energy).pressure;
        const double p_half = evaluate(aluminium, rho0, half, energy + p * (1 / rho - 1 / half)).pressure;
        return evaluate(aluminium, rho0, rho + step, energy + p_half * (1 / rho - 1 / (rho + step))).pressure;
      };
      const double c = evaluate(aluminium, rho0, rho, energy).bulk_sound;
      EXPECT_NEAR((along(h) - along(-h)) / (2 * h), c * c, 1e-6 * c * c) << eta << " " << energy;
    }
}

TEST(MieGruneisenPressure, ContinuousAtRestDensityAndGuarded) {
  for (const double energy : {0.0, 1e6}) {
    const SolidPressureSound above = evaluate(aluminium, rho0, rho0 * (1 + 1e-10), energy);
    const SolidPressureSound below = evaluate(aluminium, rho0, rho0 * (1 - 1e-10), energy);
    EXPECT_NEAR(above.pressure, below.pressure, 100.0);
    EXPECT_NEAR(above.bulk_sound, below.bulk_sound, 1e-4);
  }
  for (double rho = 1.0; rho < 4 * rho0; rho *= 1.01)
    for (const double energy : {-1e7, 0.0, 1e8})
      EXPECT_GE(evaluate(aluminium, rho0, rho, energy).bulk_sound, 530.0) << rho << " " << energy;
}

TEST(SolidPressure, VariantAsksTheLaw) {
  EXPECT_EQ(evaluate(SolidPressure{aluminium}, rho0, 3000.0, 1e5).pressure, evaluate(aluminium, rho0, 3000.0, 1e5).pressure);
  EXPECT_EQ(evaluate(SolidPressure{LinearPressure{70e9}}, rho0, 3000.0, 1e5).pressure,
            evaluate(LinearPressure{70e9}, rho0, 3000.0, 1e5).pressure);
}

TEST(WaveSpeed, Longitudinal) {
  Solid s;
  s.rho0 = 7890.0;
  s.shear_modulus = 80e9;
  s.pressure = LinearPressure{164e9};
  EXPECT_NEAR(wave_speed(s), std::sqrt((164e9 + 80e9 * 4 / 3) / 7890.0), 1e-9);
  EXPECT_NEAR(wave_speed(s), 5857.2, 0.5);
  s.rho0 = rho0;
  s.shear_modulus = 27.6e9;
  s.pressure = aluminium;
  EXPECT_NEAR(bulk_modulus(s), 76.1239e9, 1e6);
  EXPECT_NEAR(wave_speed(s), std::sqrt(5300.0 * 5300.0 + 4.0 / 3.0 * 27.6e9 / rho0), 1e-9);
}

}  // namespace
}  // namespace undex::materials
