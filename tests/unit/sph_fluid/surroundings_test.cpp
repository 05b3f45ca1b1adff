// The pressure of the surroundings: what is at rest under it stays at rest, its work closes the ledger, and water under gravity
// beside walls does not fall.
#include <algorithm>

#include "scenes.hpp"

namespace undex::sph::testing {
namespace {

constexpr double atmosphere = 1e5;

double fastest(const Fluid& fluid) { return fluid.maximum_speed(); }

class Surroundings : public ::testing::TestWithParam<SchemeName> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Surroundings,
                         ::testing::Values(SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan,
                                           SchemeName::monaghan_switch, SchemeName::paper),
                         [](const auto& one) {
                           for (const auto& [name, scheme] : scheme_names)
                             if (scheme == one.param) return name;
                           return "";
                         });

/// A drop whose particles have lost their lattice, of a law with an energy field or without.
Settings drop(SchemeName scheme, const char* material, double pressure) {
  Settings s;
  s.dimension = 2;
  s.lattice.spacing = 0.05;
  s.lattice.jitter = 0.2;
  s.numerics.threads = 1;
  s.numerics.scheme = scheme;
  s.surroundings.pressure = atmosphere;
  s.bodies = {body("drop", Shape{Sphere{Vec3::Zero(), 0.5}, {}}, material)};
  s.bodies[0].pressure = pressure;
  return s;
}

TEST_P(Surroundings, ADropUnderTheirPressureIsAtRest) {
  for (const char* material : {"water-tait", "water-steinberg"}) {
    Fluid fluid(drop(GetParam(), material, atmosphere));
    for (const double p : fluid.field("pressure")) ASSERT_NEAR(p, atmosphere, 1e-3);
    for (int k = 0; k < 10; ++k) fluid.step(fluid.step_limit().step);
    EXPECT_LT(fastest(fluid), 1e-9) << material;
    // Without them it bursts.
    Settings alone = drop(GetParam(), material, atmosphere);
    alone.surroundings.pressure = 0.0;
    Fluid bursts(alone);
    for (int k = 0; k < 10; ++k) bursts.step(bursts.step_limit().step);
    EXPECT_GT(fastest(bursts), 0.01) << material;
  }
}

TEST_P(Surroundings, TheirWorkClosesTheLedger) {
  for (const char* material : {"water-tait", "water-steinberg"}) {
    Settings s = drop(GetParam(), material, 4e7);
    s.surroundings.pressure = 5e7;
    s.lattice.jitter = 0.0;
    Fluid fluid(s);
    const Ledger start = fluid.ledger();
    for (int k = 0; k < 40; ++k) fluid.step(0.5 * fluid.step_limit().step);
    const Ledger end = fluid.ledger();
    EXPECT_GT(end.surroundings, 0.1 * end.kinetic) << material;
    EXPECT_NEAR(total(end) - end.surroundings, total(start), 2e-3 * end.surroundings) << material;
    EXPECT_LT(end.momentum.norm(), 1e-9 * std::sqrt(2 * end.kinetic * end.mass)) << material;
  }
}

/// A tank of water 1 m wide and high under a thousand times gravity, free above.
Settings tank(SchemeName scheme, FaceCondition side) {
  Settings s;
  s.dimension = 2;
  s.lattice.spacing = 1.0 / 16;
  s.numerics.threads = 1;
  s.numerics.scheme = scheme;
  s.gravity = Vec3(0, -1000, 0);
  s.surroundings.pressure = atmosphere;
  s.bodies = {body("water", box({0, 0, -1}, {1, 1, 1}), "water-tait")};
  s.bodies[0].pressure = atmosphere;
  s.bodies[0].level = Vec3(0, 1, 0);
  s.walls = {{.name = "tank", .container = Box{Vec3(0, 0, -1), Vec3(1, 2, 1)}, .faces = {}}};
  for (const char* face : {"x_low", "x_high", "y_low"}) s.walls[0].faces[face] = side;
  s.walls[0].faces["y_high"] = FaceCondition::open;
  return s;
}

/// At rest it is, but for the waves of a lattice that settles (the free surface's kernel is half empty).
TEST_P(Surroundings, WaterInATankDoesNotFall) {
  for (const FaceCondition side : {FaceCondition::free_slip, FaceCondition::no_slip}) {
    if (GetParam() == SchemeName::paper && side == FaceCondition::free_slip) continue;  // its dummies carry no weight
    const Settings s = tank(GetParam(), side);
    Fluid fluid(s);
    const Ledger start = fluid.ledger();
    while (fluid.time() < 2e-3) fluid.step(fluid.step_limit().step);
    const Ledger end = fluid.ledger();
    const double fallen = 1000 * fluid.time();  // [m/s]
    std::printf("  %s: fastest %.4f of a fall\n", side == FaceCondition::no_slip ? "no slip" : "slip", fastest(fluid) / fallen);
    EXPECT_LT(fastest(fluid), 0.1 * fallen);
    EXPECT_LT(std::abs(end.momentum[1]), 0.005 * end.mass * fallen);
    EXPECT_NEAR(total(end) - end.gravity - end.surroundings, total(start), 1e-3 * start.internal);
    const auto p = fluid.field("pressure"), x = fluid.field("position");
    for (std::size_t i = 0; i < p.size(); ++i)
      EXPECT_NEAR(p[i], atmosphere + 1e6 * (1 - x[3 * i + 1]), 0.04e6) << x[3 * i] << " " << x[3 * i + 1];
  }
}

}  // namespace
}  // namespace undex::sph::testing
