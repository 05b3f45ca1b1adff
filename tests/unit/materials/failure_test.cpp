// Spall and Johnson-Cook damage of single points.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/stress_update.hpp"

namespace undex::materials {
namespace {

constexpr JohnsonCookDamage steel_4340{.D1 = 0.05, .D2 = 3.44, .D3 = -2.12, .D4 = 0.002, .D5 = 0.61, .T_melt = 1793.0};

Solid metal(double heat_share = 0.0) {
  Solid s;
  s.name = "metal";
  s.source = "test";
  s.rho0 = 7830.0;
  s.shear_modulus = 77e9;
  s.pressure = LinearPressure{160e9};
  s.flow = LinearHardening{.Y0 = 600e6, .H = 0.0};
  s.taylor_quinney = heat_share;
  return s;
}

struct Point {
  SolidPoints points{};
  double stress_work = 0.0, plastic_work = 0.0;

  explicit Point(double temperature = 293.0) {
    for (double& T : points.temperature) T = temperature;
  }
  /// Stretches along x at constant volume by `strain` over dt [s]; all eight points alike.
  void stretch(const Solid& solid, double strain, double pressure, double dt) {
    EightPoints gradient[3][3] = {}, volume, lanes;
    for (int q = 0; q < 8; ++q) {
      volume[q] = 1.0 / solid.rho0;
      lanes[q] = pressure;
      gradient[0][0][q] = strain;
      gradient[1][1][q] = gradient[2][2][q] = -0.5 * strain;
    }
    SolidStep done;
    advance_deviator(solid, gradient, volume, lanes, dt, points, done);
    stress_work += 0.5 * (done.old_work[0] + done.new_work[0]);
    plastic_work += done.plastic_work[0];
  }
  double mises() const { return 1.5 * std::abs(points.deviator[0][0]); }
};

TEST(FractureStrain, ByHand) {
  // Triaxiality 1/3 at 1000 1/s and 1043 K: 0.05 + 3.44 exp(-0.70666667) = 1.7469030; 1 + 0.002*6.9077553; 1 + 0.61/2.
  EXPECT_NEAR(fracture_strain(steel_4340, 1.0 / 3.0, 1e3, 1043.0), 1.7469030 * 1.0138155 * 1.305, 1e-6);
  EXPECT_DOUBLE_EQ(fracture_strain(steel_4340, 0.0, 0.5, 200.0), 3.49);
  EXPECT_DOUBLE_EQ(fracture_strain(steel_4340, 0.0, 1.0, 9e9), 3.49 * 1.61);
}

TEST(FractureStrain, StaysPositiveAndEndsAtTheEdgeOfItsRange) {
  EXPECT_EQ(fracture_strain(steel_4340, 7.0, 1.0, 293.0), fracture_strain(steel_4340, 1.5, 1.0, 293.0));
  EXPECT_GT(fracture_strain(steel_4340, 1.4, 1.0, 293.0), fracture_strain(steel_4340, 1.5, 1.0, 293.0));
  EXPECT_TRUE(std::isinf(fracture_strain(steel_4340, -1e9, 1.0, 293.0)));
  JohnsonCookDamage odd = steel_4340;
  odd.D4 = -1.0;
  EXPECT_EQ(fracture_strain(odd, 0.0, 1e6, 293.0), 1e-9);
  odd = {.D1 = 0.3, .D2 = 0.0, .D3 = -1.0, .D4 = 0.0, .D5 = 0.0, .T_melt = 1000.0};
  EXPECT_EQ(fracture_strain(odd, -1e9, 1.0, 293.0), 0.3);
}

TEST(Damage, IsPlasticStrainOverFractureStrainAtConstantTriaxiality) {
  Solid solid = metal();
  solid.damage = steel_4340;
  for (const double triaxiality : {-0.5, 0.0, 1.0 / 3.0, 1.2, 4.0})
    for (const double rate : {0.1, 1e3})
      for (const double T : {293.0, 900.0}) {
        Point point(T);
        for (int i = 0; i < 400; ++i) point.stretch(solid, 5e-4, -triaxiality * 600e6, 5e-4 / rate);
        const double homologous = (T - 293.0) / 1500.0;
        const double fracture = (0.05 + 3.44 * std::exp(-2.12 * std::min(triaxiality, 1.5))) *
                                (1.0 + 0.002 * std::max(std::log(rate), 0.0)) * (1.0 + 0.61 * homologous);
        const double strain = point.points.plastic_strain[0];
        if (point.points.damage[0] < failed) {
          EXPECT_NEAR(strain, 0.2 - 600e6 / (3 * 77e9), 1e-12);
        }
        // The one step of first yield flows at a lower rate than the others.
        EXPECT_NEAR(point.points.damage[0], std::min(strain / fracture, 1.0), 1e-5) << triaxiality << " " << rate << " " << T;
      }
}

TEST(Damage, ComesToTheIntegralWhereHeatingMovesTheFractureStrain) {
  Solid solid = metal(0.9);
  solid.damage = steel_4340;
  // Perfectly plastic at 600 MPa: T = T0 + k eps; damage = integral of d eps/(a (1 + D5 (T - 293)/1500)), a logarithm.
  const double k = 0.9 * 600e6 / (solid.rho0 * solid.heat_capacity), a = 3.49, b = 0.61 * k / 1500.0;
  const auto error = [&](int steps) {
    Point point;
    for (int i = 0; i < steps; ++i) point.stretch(solid, 2.0 / steps, 0.0, 1e9);
    const double strain = point.points.plastic_strain[0];
    return std::abs(point.points.damage[0] - std::log1p(b * strain) / (a * b));
  };
  EXPECT_LT(error(1000), 1e-4);
  EXPECT_NEAR(std::log2(error(500) / error(1000)), 1.0, 0.02);
}

TEST(Damage, AFailedPointHasNoDeviatorAndNoTension) {
  Solid solid = metal(0.9);
  solid.damage = JohnsonCookDamage{.D1 = 0.1, .D2 = 0.0, .D3 = 0.0, .D4 = 0.0, .D5 = 0.0, .T_melt = 1793.0};
  Point point;
  double last = 0.0;
  while (point.points.damage[0] < failed) {
    last = point.mises();
    point.stretch(solid, 1e-3, 0.0, 1e-6);
    ASSERT_LT(point.points.plastic_strain[0], 0.2);
  }
  EXPECT_EQ(last, 600e6);
  EXPECT_NEAR(point.points.plastic_strain[0], 0.1, 1.001e-3);
  EXPECT_EQ(point.points.damage[0], failed);
  // Nothing is left to be given back: all work is plastic. The update counts plastic work at each step's end.
  EXPECT_EQ(point.mises(), 0.0);
  EXPECT_NEAR(point.plastic_work, point.stress_work, 5e-3 * point.stress_work);
  const Point before = point;
  for (int i = 0; i < 10; ++i) point.stretch(solid, -1e-3, 1e9, 1e-6);
  EXPECT_EQ(point.mises(), 0.0);
  EXPECT_EQ(point.points.plastic_strain[0], before.points.plastic_strain[0]);
  EXPECT_EQ(point.points.temperature[0], before.points.temperature[0]);
  EXPECT_EQ(point.stress_work, before.stress_work);
  EXPECT_EQ(point.plastic_work, before.plastic_work);
  EXPECT_EQ(carried_pressure(solid, -1e6, failed), 0.0);
  EXPECT_EQ(carried_pressure(solid, 1e9, failed), 1e9);
  EXPECT_EQ(carried_pressure(solid, -1e9, 0.999), -1e9);
}

TEST(Damage, ElasticEnergyOfAPointThatIsMarkedIsBookedAsPlasticWork) {
  Solid solid = metal();
  solid.spall = Spall{.strength = 1e9, .mode = Spall::Mode::fail};
  Point point;
  for (int i = 0; i < 10; ++i) point.stretch(solid, 1e-4, 0.0, 1e-6);  // elastic
  EXPECT_NEAR(point.mises(), 3 * 77e9 * 1e-3, 1.0);
  EXPECT_EQ(point.plastic_work, 0.0);
  for (double& damage : point.points.damage) damage = failed;
  point.stretch(solid, 1e-4, 0.0, 1e-6);
  EXPECT_EQ(point.mises(), 0.0);
  EXPECT_EQ(point.points.plastic_strain[0], 0.0);
  EXPECT_NEAR(point.plastic_work, point.stress_work, 1e-12 * point.stress_work);
  point.stretch(solid, 1e-4, 0.0, 1e-6);
  EXPECT_NEAR(point.plastic_work, point.stress_work, 1e-12 * point.stress_work);
}

TEST(Spall, CutoffLimitsTension) {
  Solid solid = metal();
  solid.spall = Spall{.strength = 1e9};
  EXPECT_FALSE(can_fail(solid));
  EXPECT_FALSE(spalls(solid, -5e9));
  EXPECT_EQ(carried_pressure(solid, -5e9, 0.0), -1e9);
  EXPECT_EQ(carried_pressure(solid, -0.999e9, 0.0), -0.999e9);
  EXPECT_EQ(carried_pressure(solid, 3e9, 0.0), 3e9);
}

TEST(Spall, FailMarksThePointForGood) {
  Solid solid = metal();
  solid.spall = Spall{.strength = 1e9, .mode = Spall::Mode::fail};
  EXPECT_TRUE(can_fail(solid));
  EXPECT_FALSE(spalls(solid, -0.999e9));
  EXPECT_TRUE(spalls(solid, -1e9));
  EXPECT_EQ(carried_pressure(solid, -0.5e9, 0.0), -0.5e9);
  EXPECT_EQ(carried_pressure(solid, -0.5e9, failed), 0.0);
  EXPECT_EQ(carried_pressure(solid, 0.5e9, failed), 0.5e9);
}

TEST(Failure, ASolidWithoutItDoesNotTouchDamage) {
  const Solid solid = metal();
  EXPECT_FALSE(can_fail(solid));
  EXPECT_FALSE(spalls(solid, -1e12));
  EXPECT_EQ(carried_pressure(solid, -1e12, 0.0), -1e12);
  Point point;
  for (double& damage : point.points.damage) damage = std::nan("");
  for (int i = 0; i < 100; ++i) point.stretch(solid, 1e-3, -1e9, 1e-6);
  EXPECT_NEAR(point.mises(), 600e6, 1.0);
  EXPECT_TRUE(std::isnan(point.points.damage[0]));
}

// A model that never breaks anything gives the same bits as none.
TEST(Failure, AnUnreachedLimitChangesNothing) {
  const Solid plain = metal(0.9);
  Solid guarded = plain;
  guarded.damage = steel_4340;
  guarded.spall = Spall{.strength = 1e12, .mode = Spall::Mode::fail};
  Point a, b;
  for (int i = 0; i < 50; ++i) {
    a.stretch(plain, 1e-3, 1e8, 1e-6);
    b.stretch(guarded, 1e-3, 1e8, 1e-6);
    EXPECT_EQ(a.points.deviator[0][0], b.points.deviator[0][0]);
    EXPECT_EQ(a.points.temperature[0], b.points.temperature[0]);
  }
  EXPECT_GT(b.points.damage[0], 0.0);
  EXPECT_EQ(a.plastic_work, b.plastic_work);
}

}  // namespace
}  // namespace undex::materials
