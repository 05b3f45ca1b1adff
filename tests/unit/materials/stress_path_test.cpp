// The stress update along whole paths against the laws' rate equations, integrated without it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "exact/ode.hpp"
#include "materials/stress_update.hpp"

namespace undex::materials {
namespace {

// Off the infinite slopes that powers have at zero strain and, of temperature, at room temperature.
constexpr double start_strain = 1e-3, coolest = 300.0;

Solid metal(FlowStress flow, double heat_share = 0.9) {
  Solid s;
  s.name = "metal";
  s.source = "test";
  s.rho0 = 7800.0;
  s.shear_modulus = 75e9;
  s.pressure = LinearPressure{160e9};
  s.flow = flow;
  s.heat_capacity = 450.0;
  s.taylor_quinney = heat_share;
  return s;
}

/// A law as a test sees it: stress at zero rate, and the plastic rate at a stress above that, each written out anew.
struct Metal {
  const char* name;
  FlowStress flow;
  double least_rate;  ///< below it the stress does not depend on the rate; infinite: nowhere
  double melting;     ///< highest temperature of the tests [K]
  double (*still)(double strain, double T);
  double (*rate)(double stress, double strain, double T);
};

void PrintTo(const Metal& metal, std::ostream* out) { *out << metal.name; }

double melt(double T, double top, double m) { return 1.0 - std::pow(std::clamp((T - 293.0) / (top - 293.0), 0.0, 1.0), m); }

const Metal metals[] = {
    {"power", PowerHardening{.A = 200e6, .B = 500e6, .n = 0.4}, std::numeric_limits<double>::infinity(), 1500.0,
     [](double e, double) { return 200e6 + 500e6 * std::pow(e, 0.4); }, nullptr},
    {"linear", LinearHardening{.Y0 = 300e6, .H = 1e9}, std::numeric_limits<double>::infinity(), 1500.0,
     [](double e, double) { return 300e6 + 1e9 * e; }, nullptr},
    {"perfectly plastic", LinearHardening{.Y0 = 300e6, .H = 0.0}, std::numeric_limits<double>::infinity(), 1500.0,
     [](double, double) { return 300e6; }, nullptr},
    {"Johnson-Cook", JohnsonCook{.A = 175e6, .B = 380e6, .n = 0.32, .C = 0.06, .m = 0.55, .T_melt = 1811.0}, 1.0, 1800.0,
     [](double e, double T) { return (175e6 + 380e6 * std::pow(e, 0.32)) * melt(T, 1811.0, 0.55); },
     [](double s, double e, double T) {
       return std::exp((s / ((175e6 + 380e6 * std::pow(e, 0.32)) * melt(T, 1811.0, 0.55)) - 1.0) / 0.06);
     }},
    {"Cowper-Symonds", CowperSymonds{.Y0 = 250e6, .H = 800e6, .D = 40.0, .q = 5.0}, 0.0, 1500.0,
     [](double e, double) { return 250e6 + 800e6 * e; },
     [](double s, double e, double) { return 40.0 * std::pow(std::max(s / (250e6 + 800e6 * e) - 1.0, 0.0), 5.0); }},
    {"Zerilli-Armstrong bcc", ZerilliArmstrong{.C0 = 65e6, .C1 = 1033e6, .C3 = 0.00698, .C4 = 0.000415, .C5 = 266e6, .n = 0.289},
     1e-3, 1700.0,
     [](double e, double T) {
       return 65e6 + 266e6 * std::pow(e, 0.289) + 1033e6 * std::exp(-0.00698 * T + 0.000415 * T * std::log(1e-3));
     },
     [](double s, double e, double T) {
       return std::exp((std::log((s - 65e6 - 266e6 * std::pow(e, 0.289)) / 1033e6) / T + 0.00698) / 0.000415);
     }},
    {"Zerilli-Armstrong fcc", ZerilliArmstrong{.C0 = 65e6, .C2 = 890e6, .C3 = 0.0028, .C4 = 0.000115}, 1e-3, 1300.0,
     [](double e, double T) { return 65e6 + 890e6 * std::sqrt(e) * std::exp(-0.0028 * T + 0.000115 * T * std::log(1e-3)); },
     [](double s, double e, double T) {
       return std::exp((std::log((s - 65e6) / (890e6 * std::sqrt(e))) / T + 0.0028) / 0.000115);
     }},
};

struct End {
  double stress, strain, temperature;
};

/// Straining at `rate` [1/s] by `strain` in all, from the yield surface at rest: d sigma/dt = 3 G (rate - plastic rate). In
/// total strain as the variable, sigma in units of G.
End exact_end(const Solid& solid, const Metal& of, double T, double rate, double strain) {
  const double G = solid.shear_modulus, heating = solid.taylor_quinney / (solid.heat_capacity * solid.rho0);
  const auto slope = [&](double, const exact::OdeState<3>& y) {
    const double s = y[0] * G, e = y[1], t = y[2];
    // On the surface at rest plasticity follows from staying there, as long as that is slower than the law's least rate.
    const double h = 1e-4 * e, dT = 1e-3;
    const double hardening = (of.still(e + h, t) - of.still(e - h, t)) / (2 * h);
    const double softening = (of.still(e, t + dT) - of.still(e, t - dT)) / (2 * dT) * heating * s;
    double plastic = 3 * G * rate / (3 * G + hardening + softening);
    if (plastic > of.least_rate) plastic = s > of.still(e, t) ? std::max(of.rate(s, e, t), of.least_rate) : of.least_rate;
    const double share = plastic / rate;
    return exact::OdeState<3>{3.0 * (1.0 - share), share, heating * s * share};
  };
  const exact::OdeState<3> start{of.still(start_strain, T) / G, start_strain, T}, scale{1e-4, 1e-3, 100.0};
  const auto last = exact::integrate<3>(slope, 0.0, strain, start, scale, 1e-9, strain, 100'000'000).back().y;
  return {last[0] * G, last[1], last[2]};
}

struct Path {
  SolidPoints points;
  double stress_work = 0.0, plastic_work = 0.0;  // [J/m^3]
};

/// Stretches along x at constant volume in equal steps, starting on the yield surface at rest.
Path stretched(const Solid& solid, double yield, double T, double rate, double strain, int steps, double pressure = 0.0) {
  Path path{};
  EightPoints gradient[3][3] = {}, volume, old_pressure;
  for (int q = 0; q < 8; ++q) {
    const double s[3] = {2.0 / 3.0 * yield, -yield / 3.0, -yield / 3.0};
    for (int k = 0; k < 3; ++k) path.points.deviator[k][q] = s[k];
    path.points.plastic_strain[q] = start_strain;
    path.points.temperature[q] = T;
    volume[q] = 1.0 / solid.rho0;
    old_pressure[q] = pressure;
    gradient[0][0][q] = strain / steps;
    gradient[1][1][q] = gradient[2][2][q] = -0.5 * strain / steps;
  }
  for (int i = 0; i < steps; ++i) {
    SolidStep done;
    advance_deviator(solid, gradient, volume, old_pressure, strain / steps / rate, path.points, done);
    path.stress_work += 0.5 * (done.old_work[0] + done.new_work[0]);
    path.plastic_work += done.plastic_work[0];
  }
  return path;
}

double mises(const SolidPoints& p, int q = 0) {
  double square = 0.0;
  for (int k = 0; k < 6; ++k) square += (k < 3 ? 1.0 : 2.0) * p.deviator[k][q] * p.deviator[k][q];
  return std::sqrt(1.5 * square);
}

class StressPath : public ::testing::TestWithParam<Metal> {};
INSTANTIATE_TEST_SUITE_P(All, StressPath, ::testing::ValuesIn(metals), [](const ::testing::TestParamInfo<Metal>& each) {
  std::string name = each.param.name;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

TEST_P(StressPath, ConvergesToTheRateEquationsInTheFirstOrder) {
  const Metal& of = GetParam();
  const Solid solid = metal(of.flow);
  const double strain = 0.05;
  for (const double T : {coolest, 0.5 * (coolest + of.melting), 0.97 * of.melting})
    for (const double rate : {1e-3, 0.1, 30.0, 1e4, 1e6}) {
      const End exact = exact_end(solid, of, T, rate, strain);
      const auto error = [&](int steps) {
        const SolidPoints p = stretched(solid, of.still(start_strain, T), T, rate, strain, steps).points;
        return std::abs(mises(p) / exact.stress - 1.0) + std::abs(p.plastic_strain[0] - exact.strain) / strain +
               std::abs(p.temperature[0] / exact.temperature - 1.0);
      };
      const double coarse = error(200), middle = error(400), fine = error(800);
      const std::string where = std::string(of.name) + ", T " + std::to_string(T) + " K, rate " + std::to_string(rate) +
                                " 1/s: " + std::to_string(coarse) + " " + std::to_string(middle) + " " + std::to_string(fine);
      EXPECT_LT(fine, 2e-3) << where;
      if (fine < 1e-7) continue;  // exact but for round-off and the reference's tolerance
      EXPECT_GT(std::log2(coarse / middle), 0.85) << where;
      EXPECT_GT(std::log2(middle / fine), 0.9) << where;
    }
}

TEST_P(StressPath, WorkIsElasticEnergyAndPlasticWork) {
  const Metal& of = GetParam();
  const Solid solid = metal(of.flow);
  for (const double rate : {1e-2, 1e4}) {
    const auto lost = [&](int steps) {
      const double yield = of.still(start_strain, 293.0);
      const Path path = stretched(solid, yield, 293.0, rate, 0.1, steps);
      const double elastic = (mises(path.points) * mises(path.points) - yield * yield) / (6.0 * solid.shear_modulus);
      return std::abs(path.stress_work - elastic - path.plastic_work) / path.plastic_work;
    };
    const double coarse = lost(500), fine = lost(2000);
    EXPECT_LT(fine, 1e-3) << of.name;
    // The plastic work counts the stress at the step's end: a first-order difference that hardening makes.
    if (fine > 1e-12) {
      EXPECT_GT(std::log(coarse / fine) / std::log(4.0), 0.85) << of.name << " " << coarse << " " << fine;
    }
  }
}

TEST_P(StressPath, SlopesAreThoseOfTheStress) {
  const FlowStress& law = GetParam().flow;
  for (const double T : {293.0, 700.0, 1200.0})
    for (const double strain : {1e-4, 0.02, 0.8})
      for (const double rate : {1e-2, 5.0, 1e3, 1e6}) {
        const Flow now = flow(law, strain, rate, T);
        EXPECT_EQ(now.stress, flow_stress(law, strain, rate, T));
        EXPECT_EQ(now.hardening, hardening(law, strain, rate, T));
        const double de = 1e-4 * strain, dr = 1e-4 * rate, round_off = 1e-11 * now.stress;
        EXPECT_NEAR(now.hardening, (flow_stress(law, strain + de, rate, T) - flow_stress(law, strain - de, rate, T)) / (2 * de),
                    1e-7 * now.hardening + round_off / de);
        EXPECT_NEAR(now.rate_slope, (flow_stress(law, strain, rate + dr, T) - flow_stress(law, strain, rate - dr, T)) / (2 * dr),
                    1e-7 * now.rate_slope + round_off / dr);
      }
}

TEST_P(StressPath, IsTheLawWrittenOutAtRest) {
  const Metal& of = GetParam();
  for (const double T : {293.0, 600.0, of.melting})
    for (const double strain : {0.0, 1e-5, 0.1, 1.0}) {
      const double still = of.still(strain, T);
      EXPECT_NEAR(flow_stress(of.flow, strain, 0.0, T), still, 1e-13 * still) << of.name;
      EXPECT_TRUE(std::isfinite(hardening(of.flow, strain, 1.0, T))) << of.name;
      EXPECT_EQ(radial_return(of.flow, 75e9, flow_stress(of.flow, strain, 0.0, T), strain, T, 1e-7).scale, 1.0);
      if (!of.rate) continue;
      for (const double rate : {2.0, 1e4}) {
        if (strain == 0.0) continue;
        const double stress = flow_stress(of.flow, strain, rate, T);
        EXPECT_NEAR(of.rate(stress, strain, T), rate, 1e-8 * rate) << of.name << " T " << T << " strain " << strain;
      }
      if (of.least_rate > 0.0) {
        EXPECT_EQ(flow_stress(of.flow, strain, 0.5 * of.least_rate, T), flow_stress(of.flow, strain, 0.0, T));
      }
    }
}

/// Reproducible numbers in [0, 1).
struct Random {
  unsigned long long state = 88172645463325252ull;
  double operator()() {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  }
};

TEST_P(StressPath, ReturnIsSolvedToRoundOff) {
  const Metal& of = GetParam();
  Random random;
  const double G = 75e9;
  int plastic = 0;
  for (int i = 0; i < 20000; ++i) {
    const double strain = random() < 0.1 ? 0.0 : std::pow(10.0, -9.0 + 9.3 * random());
    const double T = 200.0 + (of.melting - 200.0) * random();
    const double yield = flow_stress(of.flow, strain, 0.0, T);
    const double trial = yield * (1.0 + std::pow(10.0, -9.0 + 10.5 * random()));
    const double dt = std::pow(10.0, -12.0 + 13.0 * random());
    const PlasticStep step = radial_return(of.flow, G, trial, strain, T, dt);
    const double d = step.plastic_strain;
    ASSERT_GE(d, 0.0);
    ASSERT_LE(step.scale, 1.0);
    ASSERT_NEAR(step.work, step.scale * trial * d, 1e-13 * step.work);
    // Two neighbouring increments enclose the root where round-off of the increment is worth more than that of the stress.
    const auto excess = [&](double at) { return flow_stress(of.flow, strain + at, at / dt, T) + 3 * G * at - trial; };
    const Flow now = flow(of.flow, strain + d, d / dt, T);
    const double slope = 3 * G + now.hardening + (d > 0.0 ? now.rate_slope / dt : 0.0);
    const double ulp = 4e-16 * (d + (strain + d) * (now.hardening > 0.0 ? 1.0 : 0.0));
    ASSERT_LE(std::abs(excess(d)), 1e-14 * trial + slope * ulp)
        << of.name << " strain " << strain << " T " << T << " trial " << trial << " dt " << dt << " d " << d;
    plastic += d > 0.0;
  }
  EXPECT_GT(plastic, 19000);
}

TEST_P(StressPath, AFasterRateIsNeverWeaker) {
  const Metal& of = GetParam();
  for (const double T : {293.0, 0.9 * of.melting}) {
    double last = 0.0;
    for (double dt = 1e3; dt > 1e-12; dt *= 0.1) {
      const double stress = 2e9 * radial_return(of.flow, 75e9, 2e9, 0.05, T, dt).scale;
      EXPECT_GE(stress, last * (1 - 1e-14)) << of.name << " T " << T << " dt " << dt;
      last = stress;
    }
  }
}

TEST_P(StressPath, EightPointsAreEightSinglePoints) {
  Solid solid = metal(GetParam().flow);
  solid.damage = JohnsonCookDamage{.D1 = 0.05, .D2 = 3.44, .D3 = -2.12, .D4 = 0.002, .D5 = 0.61, .T_melt = 1793.0};
  Random random;
  for (int round = 0; round < 20; ++round) {
    SolidPoints all;
    EightPoints gradient[3][3], volume, pressure;
    for (int q = 0; q < 8; ++q) {
      for (int k = 0; k < 6; ++k) all.deviator[k][q] = 3e8 * (random() - 0.5);
      all.plastic_strain[q] = random();
      all.temperature[q] = 250.0 + 600.0 * random();
      all.damage[q] = q == 3 ? 1.0 : random();
      volume[q] = 1e-4 * (1.0 + random());
      pressure[q] = 2e9 * (random() - 0.5);
      for (auto& row : gradient)
        for (auto& entry : row) entry[q] = 2e-2 * (random() - 0.5);
    }
    const SolidPoints start = all;
    SolidStep done;
    advance_deviator(solid, gradient, volume, pressure, 1e-6, all, done);
    for (int q = 0; q < 8; ++q) {  // the same point in every lane
      SolidPoints one;
      EightPoints g[3][3], v, p;
      for (int lane = 0; lane < 8; ++lane) {
        for (int k = 0; k < 6; ++k) one.deviator[k][lane] = start.deviator[k][q];
        one.plastic_strain[lane] = start.plastic_strain[q];
        one.temperature[lane] = start.temperature[q];
        one.damage[lane] = start.damage[q];
        v[lane] = volume[q];
        p[lane] = pressure[q];
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) g[i][j][lane] = gradient[i][j][q];
      }
      SolidStep step;
      advance_deviator(solid, g, v, p, 1e-6, one, step);
      for (int lane = 0; lane < 8; ++lane) {
        for (int k = 0; k < 6; ++k) EXPECT_EQ(one.deviator[k][lane], all.deviator[k][q]);
        EXPECT_EQ(one.plastic_strain[lane], all.plastic_strain[q]);
        EXPECT_EQ(one.temperature[lane], all.temperature[q]);
        EXPECT_EQ(one.damage[lane], all.damage[q]);
        EXPECT_EQ(step.strain_norm[lane], done.strain_norm[q]);
        EXPECT_EQ(step.old_work[lane], done.old_work[q]);
        EXPECT_EQ(step.new_work[lane], done.new_work[q]);
        EXPECT_EQ(step.plastic_work[lane], done.plastic_work[q]);
      }
    }
  }
}

TEST(ZerilliArmstrong, ByHand) {
  // OFHC copper at strain 0.25, 1e4 1/s, 400 K: exp(400 (0.000115*9.2103404 - 0.0028)) = exp(-0.69632434) = 0.49841398.
  const ZerilliArmstrong copper{.C0 = 65e6, .C2 = 890e6, .C3 = 0.0028, .C4 = 0.000115};
  EXPECT_NEAR(flow_stress(copper, 0.25, 1e4, 400.0), 65e6 + 890e6 * 0.5 * 0.49841398, 20.0);
}

TEST(CowperSymonds, DoublesAtD) {
  const CowperSymonds steel{.Y0 = 250e6, .H = 1e9, .D = 40.4, .q = 5.0};
  EXPECT_NEAR(flow_stress(steel, 0.1, 40.4, 293.0), 700e6, 1e-6);
  EXPECT_NEAR(flow_stress(steel, 0.0, 40.4 * 32.0, 293.0), 750e6, 1e-6);
  EXPECT_EQ(flow_stress(steel, 0.1, 0.0, 293.0), 350e6);
}

TEST(PowerHardening, IsJohnsonCookWithoutRateAndHeat) {
  const PowerHardening power{.A = 100e6, .B = 300e6, .n = 0.35};
  const JohnsonCook same{.A = 100e6, .B = 300e6, .n = 0.35, .C = 0.0, .m = 1.0, .T_melt = 1e9, .T_room = 1e8};
  for (const double trial : {90e6, 150e6, 400e6, 5e9})
    EXPECT_EQ(radial_return(power, 75e9, trial, 0.01, 293.0, 1e-6).plastic_strain,
              radial_return(same, 75e9, trial, 0.01, 293.0, 1e-6).plastic_strain);
}

}  // namespace
}  // namespace undex::materials
