// Flow stress, radial return and hardening from tensile tests against independent solutions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "materials/solid.hpp"
#include "materials/tensile_test.hpp"

namespace undex::materials {
namespace {

Solid metal(FlowStress flow) {
  Solid s;
  s.name = "metal";
  s.source = "test";
  s.rho0 = 2700.0;
  s.shear_modulus = 26.7e9;
  s.pressure = LinearPressure{70e9};
  s.flow = flow;
  return s;
}

constexpr JohnsonCook al5083{.A = 167e6, .B = 596e6, .n = 0.551, .C = 0.001, .m = 0.859, .T_melt = 893.0};
constexpr JohnsonCook iron{.A = 175e6, .B = 380e6, .n = 0.32, .C = 0.06, .m = 0.55, .T_melt = 1811.0};

/// Increment of plastic strain by bisection in long double, flow stress written out from eqs 16 and 17.
long double bisected(const JohnsonCook& law, long double G, long double trial, long double strain, long double T,
                     long double dt) {
  long double homologous = (T - law.T_room) / (static_cast<long double>(law.T_melt) - law.T_room);
  homologous = std::fmin(std::fmax(homologous, 0.0L), 1.0L);
  const auto excess = [&](long double d) {
    const long double rate = std::fmax(d / dt, static_cast<long double>(law.rate0));
    const long double sigma = (law.A + law.B * std::pow(strain + d, static_cast<long double>(law.n))) *
                              (1.0L + law.C * std::log(rate / law.rate0)) *
                              (1.0L - std::pow(homologous, static_cast<long double>(law.m)));
    return sigma + 3.0L * G * d - trial;
  };
  if (excess(0.0L) >= 0.0L) return 0.0L;
  long double low = 0.0L, high = trial / (3.0L * G);
  for (int i = 0; i < 300; ++i) {
    const long double middle = 0.5L * (low + high);
    (excess(middle) < 0.0L ? low : high) = middle;
  }
  return high;
}

TEST(FlowStress, JohnsonCookByHand) {
  // At zero strain, reference rate and room temperature only A is left.
  EXPECT_EQ(flow_stress(al5083, 0.0, 1.0, 293.0), 167e6);
  // Strain 1: A + B. A thousandfold rate: ln 1000 = 6.907755. Half-way to melting with m = 1: one half.
  EXPECT_NEAR(flow_stress(al5083, 1.0, 1.0, 293.0), 763e6, 1e-3);
  EXPECT_NEAR(flow_stress(al5083, 1.0, 1000.0, 293.0), 763e6 * 1.006907755, 1.0);
  JohnsonCook linear = al5083;
  linear.m = 1.0;
  EXPECT_NEAR(flow_stress(linear, 1.0, 1.0, 593.0), 763e6 * 0.5, 1e-3);
  // Armco iron at strain 0.3, 1e4 1/s, 600 K: 0.3^0.32 = 0.6802661, ln 1e4 = 9.210340, T* = 0.202240,
  // T*^0.55 = 0.4151706.
  EXPECT_NEAR(flow_stress(iron, 0.3, 1e4, 600.0), (175e6 + 380e6 * 0.6802661) * (1 + 0.06 * 9.210340) * (1 - 0.4151706), 3e3);
}

TEST(FlowStress, RateAndTemperatureAreClamped) {
  for (const double rate : {0.0, 1e-3, 0.999, 1.0})
    EXPECT_EQ(flow_stress(iron, 0.1, rate, 293.0), flow_stress(iron, 0.1, 1.0, 293.0));
  EXPECT_GT(flow_stress(iron, 0.1, 1.001, 293.0), flow_stress(iron, 0.1, 1.0, 293.0));
  EXPECT_EQ(flow_stress(iron, 0.1, 1.0, 100.0), flow_stress(iron, 0.1, 1.0, 293.0));
  EXPECT_LT(flow_stress(iron, 0.1, 1.0, 294.0), flow_stress(iron, 0.1, 1.0, 293.0));
  EXPECT_EQ(flow_stress(iron, 0.1, 1.0, 1811.0), 0.0);
  EXPECT_EQ(flow_stress(iron, 0.1, 1.0, 5000.0), 0.0);
}

TEST(FlowStress, OtherLaws) {
  EXPECT_EQ(flow_stress(FlowStress{LinearHardening{550e6, 1e9}}, 0.1, 5.0, 800.0), 650e6);
  EXPECT_TRUE(std::isinf(flow_stress(FlowStress{Elastic{}}, 0.1, 1.0, 293.0)));
  EXPECT_EQ(hardening(FlowStress{LinearHardening{550e6, 1e9}}, 0.1, 1.0, 293.0), 1e9);
  EXPECT_EQ(hardening(FlowStress{Elastic{}}, 0.1, 1.0, 293.0), 0.0);
}

TEST(FlowStress, HardeningIsTheSlope) {
  for (const JohnsonCook& law : {al5083, iron})
    for (const double strain : {1e-3, 0.05, 0.7}) {
      const double h = 1e-5 * strain;
      const double slope = (flow_stress(law, strain + h, 1e3, 500.0) - flow_stress(law, strain - h, 1e3, 500.0)) / (2.0 * h);
      EXPECT_NEAR(hardening(FlowStress{law}, strain, 1e3, 500.0), slope, 1e-7 * slope);
    }
  const double at_zero = hardening(FlowStress{iron}, 0.0, 1.0, 293.0);
  EXPECT_TRUE(std::isfinite(at_zero));
  EXPECT_EQ(at_zero, hardening(FlowStress{iron}, 1e-6, 1.0, 293.0));
}

TEST(RadialReturn, ElasticBelowYield) {
  for (const Solid& s : {metal(al5083), metal(iron), metal(LinearHardening{167e6, 0.0})}) {
    const double yield = flow_stress(s.flow, 0.02, 0.0, 293.0);
    for (const double trial : {0.0, 0.5 * yield, yield}) {
      const PlasticStep step = radial_return(s, trial, 0.02, 293.0, 1e-7);
      EXPECT_EQ(step.scale, 1.0);
      EXPECT_EQ(step.plastic_strain, 0.0);
      EXPECT_EQ(step.work, 0.0);
    }
    EXPECT_GT(radial_return(s, yield * (1 + 1e-12), 0.02, 293.0, 1.0).plastic_strain, 0.0);
  }
  EXPECT_EQ(radial_return(metal(Elastic{}), 1e12, 0.0, 293.0, 1e-7).scale, 1.0);
}

TEST(RadialReturn, LinearHardeningClosedForm) {
  for (const double H : {0.0, 0.5e9, 50e9}) {
    const Solid s = metal(LinearHardening{300e6, H});
    for (const double trial : {301e6, 700e6, 9e9}) {
      const double strain = 0.01;
      const double start = 300e6 + H * strain;
      const PlasticStep step = radial_return(s, trial, strain, 293.0, 1e-7);
      if (trial <= start) {
        EXPECT_EQ(step.scale, 1.0);
        continue;
      }
      EXPECT_NEAR(step.plastic_strain, (trial - start) / (3 * 26.7e9 + H), 1e-15);
      EXPECT_NEAR(trial - 3 * 26.7e9 * step.plastic_strain, 300e6 + H * (strain + step.plastic_strain), 1e-14 * trial);
      EXPECT_NEAR(step.scale * trial, 300e6 + H * (strain + step.plastic_strain), 1e-14 * trial);
      EXPECT_NEAR(step.work, step.scale * trial * step.plastic_strain, 1e-12 * step.work);
    }
  }
}

TEST(RadialReturn, JohnsonCookWithoutRateAndPowerIsLinearHardening) {
  const JohnsonCook law{.A = 300e6, .B = 2e9, .n = 1.0, .C = 0.0, .m = 1.0, .T_melt = 900.0};
  for (const double trial : {310e6, 600e6, 5e9}) {
    const PlasticStep jc = radial_return(metal(law), trial, 0.003, 293.0, 1e-7);
    const PlasticStep linear = radial_return(metal(LinearHardening{300e6, 2e9}), trial, 0.003, 293.0, 1e-7);
    EXPECT_NEAR(jc.plastic_strain, linear.plastic_strain, 1e-12 * linear.plastic_strain);
    EXPECT_NEAR(jc.scale, linear.scale, 1e-14);
  }
}

TEST(RadialReturn, AgreesWithBisectionAndIsConsistent) {
  int plastic = 0;
  for (const JohnsonCook& law : {al5083, iron}) {
    const Solid s = metal(law);
    const double G = s.shear_modulus;
    for (const double T : {250.0, 293.0, 400.0, 0.999 * law.T_melt})
      for (const double strain : {0.0, 1e-9, 1e-4, 0.1, 2.0})
        for (const double rate : {1e-3, 0.5, 1.0, 1e2, 1e6})
          for (const double size : {1e-10, 1e-6, 1e-3, 0.3, 20.0}) {
            // A trial stress whose increment is about size * yield/3G at about that rate.
            const double start = flow_stress(law, strain, 0.0, T);
            const double trial = start * (1.0 + size), dt = size * start / (3.0 * G) / rate;
            const PlasticStep step = radial_return(s, trial, strain, T, dt);
            const double d = step.plastic_strain;
            const double expected = static_cast<double>(bisected(law, G, trial, strain, T, dt));
            // Round-off of the stress is worth eps trial/3G of strain; near melting 1 - T*^m costs three
            // digits.
            EXPECT_NEAR(d, expected, 1e-11 * expected + 1e-12 * trial / (3 * G))
                << "T " << T << " strain " << strain << " rate " << rate << " size " << size;
            const double residual = trial - 3 * G * d - flow_stress(law, strain + d, d / dt, T);
            EXPECT_LT(std::abs(residual), 1e-14 * trial * 10);
            EXPECT_NEAR(step.scale * trial, trial - 3 * G * d, 1e-14 * trial * 10);
            EXPECT_GE(d, 0.0);
            EXPECT_LE(step.scale, 1.0);
            plastic += d > 0.0;
          }
  }
  EXPECT_GT(plastic, 900);  // of 1000: the cases above are steps beyond yield
}

TEST(RadialReturn, FirstYieldWithInfiniteSlope) {
  // Trial just above A at zero strain: the increment is where B d^n takes up the excess, far below excess/3G.
  const PlasticStep step = radial_return(metal(iron), 175e6 * 1.001, 0.0, 293.0, 1.0);
  const double d = step.plastic_strain;
  EXPECT_GT(d, 0.0);
  EXPECT_LT(d, 0.01 * 175e3 / (3 * 26.7e9));
  EXPECT_NEAR(380e6 * std::pow(d, 0.32), 175e3 - 3 * 26.7e9 * d, 1.0);
}

TEST(RadialReturn, RateStiffens) {
  double last = 0.0;
  for (const double dt : {1.0, 1e-3, 1e-6, 1e-9}) {
    const double stress = 900e6 * radial_return(metal(iron), 900e6, 0.1, 293.0, dt).scale;
    EXPECT_GT(stress, last);
    last = stress;
  }
}

TEST(RadialReturn, MoltenMetalCarriesNoShear) {
  const PlasticStep step = radial_return(metal(iron), 1e6, 0.1, 1811.0, 1e-7);
  EXPECT_EQ(step.scale, 0.0);
  EXPECT_EQ(step.work, 0.0);
  EXPECT_NEAR(step.plastic_strain, 1e6 / (3 * 26.7e9), 1e-18);
  EXPECT_EQ(radial_return(metal(iron), 0.0, 0.1, 1811.0, 1e-7).scale, 1.0);
}

TEST(RadialReturn, WorkOfManyStepsIsTheAreaUnderTheCurve) {
  // Straining at constant rate with C = 0: the work is the integral of A + B eps^n over the plastic strain.
  JohnsonCook law = al5083;
  law.C = 0.0;
  const Solid s = metal(law);
  double stress = 0.0, strain = 0.0, work = 0.0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double trial = stress + 3 * s.shear_modulus * 0.2 / steps;
    const PlasticStep step = radial_return(s, trial, strain, 293.0, 1e-7);
    stress = step.scale * trial;
    strain += step.plastic_strain;
    work += step.work;
  }
  EXPECT_NEAR(stress, flow_stress(law, strain, 0.0, 293.0), 1e-6 * stress);
  EXPECT_NEAR(work, law.A * strain + law.B * std::pow(strain, law.n + 1) / (law.n + 1), 1e-4 * work);
}

TEST(TensileTest, ConsidereConditionOfAnnealed5086) {
  const PowerHardening h = hardening_from({.yield = 117e6, .ultimate = 262e6, .uniform_elongation = 0.22});
  EXPECT_EQ(h.A, 117e6);
  EXPECT_NEAR(h.B, 336e6, 0.5e6);
  EXPECT_NEAR(h.n, 0.314, 0.0005);
}

TEST(TensileTest, CurvePassesThroughTheNeckingPointAndNecksThere) {
  for (const TensileTest& t : {TensileTest{117e6, 262e6, 0.22}, TensileTest{207e6, 290e6, 0.12}}) {
    const PowerHardening h = hardening_from(t);
    const auto stress = [&](double strain) { return h.A + h.B * std::pow(strain, h.n); };
    const double neck = std::log(1 + t.uniform_elongation);
    EXPECT_NEAR(stress(neck) / (1 + t.uniform_elongation), t.ultimate, 1.0);
    // The engineering stress sigma exp(-eps) is largest there, and nowhere larger.
    for (double strain = 0.002; strain < 0.8; strain += 0.002)
      EXPECT_LE(stress(strain) * std::exp(-strain), t.ultimate * (1 + 1e-12)) << strain;
    const double d = 1e-6;
    EXPECT_NEAR((stress(neck + d) - stress(neck - d)) / (2 * d), stress(neck), 1e-6 * stress(neck));
  }
}

TEST(TensileTest, RefusesImpossibleTests) {
  EXPECT_THROW(hardening_from({.yield = 300e6, .ultimate = 262e6, .uniform_elongation = 0.1}), std::invalid_argument);
  EXPECT_THROW(hardening_from({.yield = 0.0, .ultimate = 262e6, .uniform_elongation = 0.1}), std::invalid_argument);
  EXPECT_THROW(hardening_from({.yield = 100e6, .ultimate = 262e6, .uniform_elongation = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace undex::materials
