// Sjogreen's problem (Chen et al. 2019, eq. 34): two streams of gas torn apart. Barotropic and without shocks, so the exact
// solution is two centred rarefactions (Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, chapter 4, test 2).
#include "bodies.hpp"

namespace undex::sph::testing {
namespace {

struct State {
  double rho, u, p;
};

/// Exact solution at (x - 0.5)/t for gamma 1.4, rho 1, p 0.4, u = -2 | +2.
State exact(double similarity) {
  const double gamma = 1.4, rho0 = 1.0, p0 = 0.4, u0 = 2.0;
  const double c0 = std::sqrt(gamma * p0 / rho0), side = similarity < 0 ? -1.0 : 1.0, s = std::abs(similarity);
  const double c_middle = c0 - 0.5 * (gamma - 1) * u0;
  double c = c0, u = u0;
  if (s <= c_middle) {
    c = c_middle;
    u = 0;
  } else if (s < u0 + c0) {  // u + c = s, and u - 2c/(gamma - 1) as in the gas at rest
    c = (s - u0 + 2 / (gamma - 1) * c0) * (gamma - 1) / (gamma + 1);
    u = s - c;
  }
  const double rho = rho0 * std::pow(c / c0, 2 / (gamma - 1));
  return {rho, side * u, p0 * std::pow(rho / rho0, gamma)};
}

struct Errors {
  double rho = 0, u = 0, p = 0;  // L1, over |x - 0.5| < 0.45, weighted by the particles' volumes
  double fan = 0;                // the same of the density, over 0.1 < |x - 0.5| < 0.45
  double centre_rho = 0;
};

Errors run(int particles, SchemeName scheme) {
  Settings settings = scene_1d(1.0 / particles, scheme);
  settings.bodies = {slab("left", 0, 0.5, "sjogreen-gas", -2), slab("right", 0.5, 1, "sjogreen-gas", 2)};
  for (Body& body : settings.bodies) body.variable_h = true;
  settings.numerics.courant = 0.1;  // a zone in the middle thins out faster than a sound wave crosses it
  settings.numerics.h_high = 60;    // the gas in the middle is 46 times thinner
  Fluid fluid(settings);
  run_until(fluid, 0.15);
  const std::vector<double> x = along_x(fluid.field("position")), u = along_x(fluid.field("velocity"));
  const std::vector<double> rho = fluid.field("density"), p = fluid.field("pressure"), mass = fluid.field("mass");
  Errors errors;
  double volume = 0, fan_volume = 0, nearest = 1;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::abs(x[i] - 0.5) > 0.45) continue;
    const State wanted = exact((x[i] - 0.5) / 0.15);
    const double V = mass[i] / rho[i];
    volume += V;
    errors.rho += V * std::abs(rho[i] - wanted.rho);
    if (std::abs(x[i] - 0.5) > 0.1) {
      fan_volume += V;
      errors.fan += V * std::abs(rho[i] - wanted.rho);
    }
    errors.u += V * std::abs(u[i] - wanted.u);
    errors.p += V * std::abs(p[i] - wanted.p);
    if (std::abs(x[i] - 0.5) < nearest) {
      nearest = std::abs(x[i] - 0.5);
      errors.centre_rho = rho[i];
    }
  }
  errors.rho /= volume;
  errors.fan /= fan_volume;
  errors.u /= volume;
  errors.p /= volume;
  return errors;
}

TEST(SjogreenExact, IsTheKnownState) {
  EXPECT_NEAR(exact(0).p, 0.00189387, 5e-9);
  EXPECT_NEAR(exact(0).rho, 0.0218521, 5e-8);
  EXPECT_NEAR(exact(0.41225 / 0.15 + 1e-9).rho, 1.0, 1e-4);
  EXPECT_NEAR(exact(0.05225 / 0.15).u, 0.0, 1e-3);
  for (double s = -3; s < 3; s += 0.01) EXPECT_LT(std::abs(exact(s + 1e-6).rho - exact(s).rho), 1e-5) << "jump at " << s;
}

class Sjogreen : public Schemes {};

TEST_P(Sjogreen, ConvergesToTheTwoRarefactions) {
  const Errors coarse = run(200, GetParam()), fine = run(400, GetParam());
  report("rho_L1_200", coarse.rho);
  report("rho_L1_400", fine.rho);
  report("u_L1_400", fine.u);
  report("p_L1_400", fine.p);
  report("order_rho", std::log2(coarse.rho / fine.rho));
  report("order_u", std::log2(coarse.u / fine.u));
  report("order_p", std::log2(coarse.p / fine.p));
  report("centre_rho_400", fine.centre_rho);
  report("fan_rho_L1_400", fine.fan);
  report("order_fan_rho", std::log2(coarse.fan / fine.fan));
  // Of 400 particles the exact solution leaves one in the middle state, and the density carried by the continuity equation
  // stays ten times too high there: the middle alone keeps the whole norm at order one half. A density by summation, or
  // one that is renewed from the spacing of the particles, should do better; then tighten these bounds.
  EXPECT_LT(fine.rho, 0.035);
  EXPECT_LT(fine.u, 0.022);
  EXPECT_LT(fine.p, 0.011);
  EXPECT_LT(fine.fan, 0.029);
  EXPECT_GT(std::log2(coarse.rho / fine.rho), 0.5);
  EXPECT_GT(std::log2(coarse.p / fine.p), 0.65);
  EXPECT_GT(std::log2(coarse.fan / fine.fan), 0.8);
}

INSTANTIATE_TEST_SUITE_P(, Sjogreen, ::testing::Values(SchemeName::monaghan, SchemeName::riemann),
                         [](const auto& c) { return name_of(c.param); });

}  // namespace
}  // namespace undex::sph::testing
