// Gravity: a falling body does not know that it falls; a column at rest stays at rest and weighs what it weighs.
#include <algorithm>

#include "refused_step.hpp"

namespace undex::sph::testing {
namespace {

/// A blob of water with a bubble of four times finer spacing, which bursts in the open.
Settings blob(SchemeName scheme, Integrator integrator, bool local, const Vec3& gravity) {
  Settings s;
  s.dimension = 2;
  s.lattice.spacing = 0.05;
  s.numerics.threads = 1;
  s.numerics.scheme = scheme;
  s.numerics.integrator = integrator;
  s.numerics.local_steps = local;
  s.gravity = gravity;
  const Sphere bubble{Vec3(0.02, 0.01, 0), 0.12};
  Body water = body("water", Shape{Sphere{Vec3::Zero(), 1.2}, {bubble}}, "water-tait"),
       gas = body("gas", Shape{bubble, {}}, "bubble-gas");
  water.pressure = 5e7;
  gas.spacing = 0.0125;
  gas.variable_h = true;
  s.bodies = {water, gas};
  return s;
}

struct Way {
  SchemeName scheme;
  Integrator integrator;
  bool local;
};

class Falling : public ::testing::TestWithParam<Way> {};
INSTANTIATE_TEST_SUITE_P(Ways, Falling,
                         ::testing::Values(Way{SchemeName::riemann, Integrator::leapfrog, false},
                                           Way{SchemeName::riemann, Integrator::leapfrog, true},
                                           Way{SchemeName::riemann, Integrator::ssp_rk3, false},
                                           Way{SchemeName::riemann_corrected, Integrator::leapfrog, true},
                                           Way{SchemeName::monaghan, Integrator::leapfrog, false},
                                           Way{SchemeName::monaghan, Integrator::leapfrog, true},
                                           Way{SchemeName::monaghan_switch, Integrator::ssp_rk3, false},
                                           Way{SchemeName::paper, Integrator::leapfrog, false}),
                         [](const auto& one) {
                           std::string name;
                           for (const auto& [word, scheme] : scheme_names)
                             if (scheme == one.param.scheme) name = word;
                           return name + (one.param.integrator == Integrator::ssp_rk3 ? "_rk3" : one.param.local ? "_local" : "");
                         });

TEST_P(Falling, BurstsAsIfAtRest) {
  const auto [scheme, integrator, local] = GetParam();
  const Vec3 g(6e5, -4e6, 0);  // as fast as the burst within the twenty steps
  Fluid falls(blob(scheme, integrator, local, g)), rests(blob(scheme, integrator, local, Vec3::Zero()));
  const Ledger start = falls.ledger();
  const std::vector<Vec3> begin = by_id(falls, "position");
  for (int k = 0; k < 20; ++k) {
    const double dt = rests.step_limit().step;
    falls.step_limit();
    falls.step(dt);
    rests.step(dt);
  }
  EXPECT_EQ(falls.substeps() > 20, local);
  const double t = falls.time();
  const std::vector<Vec3> x = by_id(falls, "position"), v = by_id(falls, "velocity"), x0 = by_id(rests, "position"),
                          v0 = by_id(rests, "velocity");
  double fastest_at_rest = 0, off = 0, slower = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    fastest_at_rest = std::max(fastest_at_rest, v0[i].norm());
    off = std::max(off, (x[i] - x0[i] - 0.5 * t * t * g).norm());
    slower = std::max(slower, (v[i] - v0[i] - t * g).norm());
  }
  EXPECT_GT(fastest_at_rest, 5.0);
  // Not to the last digit: the predictor's earlier rates are in single precision, and some thousand times larger as it falls.
  EXPECT_LT(off, 1e-8 * 0.05);
  EXPECT_LT(slower, 1e-8 * fastest_at_rest);

  const Ledger end = falls.ledger(), unmoved = rests.ledger();
  EXPECT_LT((end.momentum - start.momentum - t * start.mass * g).norm(), 1e-11 * t * start.mass * g.norm());
  EXPECT_GT(end.gravity, 0.5 * end.kinetic);
  // Its work is all that the fall adds to the energy.
  EXPECT_NEAR(total(end) - end.gravity, total(unmoved), 1e-8 * end.kinetic);
}

/// A column of water on a wall: 1 m high, free at its top, at 1 Pa there.
constexpr double gravity = 1000, height = 1.0;

Settings column(double spacing, SchemeName scheme) {
  Settings s;
  s.dimension = 1;
  s.gravity = Vec3(-gravity, 0, 0);
  s.lattice.spacing = spacing;
  s.numerics.threads = 1;
  s.numerics.scheme = scheme;
  s.bodies = {body("water", box({0, -1, -1}, {height, 1, 1}), "water-tait")};
  s.bodies[0].pressure = 1.0;
  s.bodies[0].level = Vec3(height, 0, 0);
  return s;
}

double exact_pressure(const Settings& s, double x) { return hydrostatic_column(s.bodies[0], s.gravity, 1).pressure(height - x); }

/// Root mean square error of the pressure over its largest.
double error(const Fluid& fluid) {
  const std::vector<double> x = fluid.field("position"), p = fluid.field("pressure");
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += std::pow(p[i] - exact_pressure(fluid.settings(), x[3 * i]), 2);
  return std::sqrt(sum / double(p.size())) / (1000 * gravity * height);
}

class Column : public ::testing::TestWithParam<SchemeName> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Column,
                         ::testing::Values(SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan),
                         [](const auto& one) {
                           for (const auto& [name, scheme] : scheme_names)
                             if (scheme == one.param) return name;
                           return "";
                         });

TEST_P(Column, StartsInEquilibriumAwayFromItsEnds) {
  double most[2];
  for (const int fine : {0, 1}) {
    const Settings s = column(fine ? 0.01 : 0.02, GetParam());
    Fluid fluid(s);
    EXPECT_LT(error(fluid), 1e-12);  // each particle has the pressure of its place
    fluid.step(1e-9);
    const std::vector<Vec3> x = by_id(fluid, "position"), v = by_id(fluid, "velocity");
    most[fine] = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i][0] > 0.1 && x[i][0] < 0.9) most[fine] = std::max(most[fine], std::abs(v[i][0]) / 1e-9 / gravity);
  }
  std::printf("  unbalanced in the middle: %.2e, %.2e of gravity\n", most[0], most[1]);
  EXPECT_LT(most[0], 1e-5);
}

TEST_P(Column, KeepsItsPressureOnASymmetryPlane) {
  double errors[3];
  const double spacings[] = {0.04, 0.02, 0.01};
  for (int k = 0; k < 3; ++k) {
    Settings s = column(spacings[k], GetParam());
    s.symmetry.axis[0] = true;
    Fluid fluid(s);
    const Ledger start = fluid.ledger();
    while (fluid.time() < 3e-3) fluid.step(fluid.step_limit().step);  // two ways up and down
    errors[k] = error(fluid);
    const Ledger end = fluid.ledger();
    EXPECT_LT(std::abs(total(end) - end.gravity - total(start)), 1e-3 * start.internal);
  }
  std::printf("  pressure %.2e, %.2e, %.2e of the largest; orders %.2f, %.2f\n", errors[0], errors[1], errors[2],
              std::log2(errors[0] / errors[1]), std::log2(errors[1] / errors[2]));
  EXPECT_LT(errors[2], 0.01);
  EXPECT_GT(std::log2(errors[0] / errors[2]) / 2, 1.0);
}

TEST_P(Column, WeighsWhatItWeighs) {
  Fluid fluid(column(0.05, GetParam()));
  const auto bottom = fluid.add_wall(layers_beyond(0.0, -1, 0.0));
  const Ledger start = fluid.ledger();
  const double weight = start.mass * gravity;
  double received = 0;
  while (fluid.time() < 8e-3) fluid.step(fluid.step_limit().step);
  for (const Vec3& impulse : fluid.wall(bottom).impulse) received += impulse[0];
  const double momentum = fluid.ledger().momentum[0];
  // What it does not weigh it gains in momentum, to round-off; and that is little.
  EXPECT_NEAR(-received, weight * fluid.time() + momentum, 1e-11 * weight * fluid.time());
  std::printf("  impulse on the bottom %.5f of the weight's\n", -received / (weight * fluid.time()));
  EXPECT_NEAR(-received, weight * fluid.time(), 0.01 * weight * fluid.time());
}

}  // namespace
}  // namespace undex::sph::testing
