// Gas that expands splits its particles: what that conserves, where the halves stand, and that nothing else depends on it.
#include "sph_fluid/water/split.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "scenes.hpp"

namespace undex::sph::testing {
namespace {

struct Sums {
  double mass = 0, kinetic = 0, internal = 0;
  Vec3 moment = Vec3::Zero(), momentum = Vec3::Zero(), angular = Vec3::Zero();
};

Sums sums_of(const ParticleSet& set, const Group& group) {
  const Particles& p = set.particles;
  Sums sums;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const Vec3 x = place_of(p, i), v(p.vx[i], p.vy[i], p.vz[i]);
    sums.mass += p.mass[i];
    sums.kinetic += 0.5 * p.mass[i] * v.squaredNorm();
    sums.internal += p.mass[i] * p.energy[i];
    sums.moment += p.mass[i] * x;
    sums.momentum += p.mass[i] * v;
    sums.angular += p.mass[i] * x.cross(v);
  }
  return sums;
}

/// Every total of every body, whoever splits; and what is not split is as it was.
TEST(Split, KeepsAllTotalsOfBodies) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const Body barotropic = body("bubble", box(Vec3(0, 0, 0), Vec3(1, 1, 1)), "bubble-gas");
  const Body with_energy = body("charge", box(Vec3(0, 0, 0), Vec3(1, 1, 1)), "tnt");
  ParticleSet set;
  Particles& p = set.particles;
  p.resize(300, true);
  for (std::uint32_t i = 0; i < 300; ++i) {
    for (auto* a : {&p.x, &p.y, &p.z, &p.vx, &p.vy, &p.vz}) (*a)[i] = any(engine);
    p.rho[i] = 2.0 + any(engine);
    p.mass[i] = 2.0 + any(engine);
    p.energy[i] = 1e5 * any(engine);
    p.id[i] = 299 - i;
  }
  p.make_room(SecondRow::gradient, 1.0, /*of_stages=*/true, /*rings=*/true);
  for (const auto& [begin, end] : {std::pair(0u, 100u), std::pair(100u, 180u), std::pair(180u, 300u)}) {
    Group group;
    group.body = begin == 0 ? &barotropic : &with_energy;
    group.begin = begin;
    group.end = end;
    set.groups.push_back(group);
  }
  std::vector<Sums> before;
  for (const Group& group : set.groups) before.push_back(sums_of(set, group));
  const Particles old = p;

  std::vector<Split> splits;
  for (const std::uint32_t i : {0u, 1u, 40u, 99u, 180u, 298u, 299u}) {
    const Vec3 offset(any(engine), any(engine), any(engine));
    splits.push_back({.particle = i, .offset = offset, .parting = any(engine) * offset});
  }
  const double owed = split(set, splits);

  ASSERT_EQ(p.size(), 307u);
  EXPECT_EQ(set.groups[0].end, 104u);
  EXPECT_EQ(set.groups[1].begin, 104u);
  EXPECT_EQ(set.groups[1].end, 184u);
  EXPECT_EQ(set.groups[2].end, 307u);
  for (std::size_t g = 0; g < 3; ++g) {
    const Sums after = sums_of(set, set.groups[g]);
    EXPECT_NEAR(after.mass, before[g].mass, 1e-12);
    if (g == 0) {
      EXPECT_GT(owed, 0.1);
      EXPECT_NEAR(after.kinetic, before[g].kinetic + owed, 1e-12);
      EXPECT_NEAR(after.internal, before[g].internal, 1e-7);
    } else {
      EXPECT_NEAR(after.kinetic + after.internal, before[g].kinetic + before[g].internal, 1e-7);
    }
    EXPECT_LT((after.moment - before[g].moment).norm(), 1e-12);
    EXPECT_LT((after.momentum - before[g].momentum).norm(), 1e-12);
    EXPECT_LT((after.angular - before[g].angular).norm(), 1e-12);
  }
  std::vector<std::uint32_t> ids = p.id;
  std::sort(ids.begin(), ids.end());
  for (std::uint32_t k = 0; k < ids.size(); ++k) EXPECT_EQ(ids[k], k);
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    const std::uint32_t id = p.id[i];
    if (id >= 300) continue;
    const std::uint32_t was = 299 - id;
    EXPECT_EQ(p.rho[i], old.rho[was]);
    const bool halved = std::any_of(splits.begin(), splits.end(), [&](const Split& each) { return each.particle == was; });
    EXPECT_EQ(p.mass[i], (halved ? 0.5 : 1.0) * old.mass[was]);
    // The state that a refused step goes back to moves along.
    EXPECT_NEAR(p.start.x[i] - old.start.x[was], p.x[i] - old.x[was], 1e-15);
  }
}

/// Halves of a ring have one area and density, however near the axis it is. Mass, momentum along the axis, the middle along it
/// and energy stay.
TEST(Split, HalvesOfARingHaveOneArea) {
  const Body charge = body("charge", box(Vec3(0, 0, 0), Vec3(1, 1, 1)), "tnt");
  ParticleSet set;
  Particles& p = set.particles;
  p.resize(1, true);
  p.x[0] = 0.5, p.y[0] = 2.0, p.vx[0] = 3.0, p.vy[0] = 4.0;
  p.rho[0] = 2.0, p.mass[0] = 5.0, p.energy[0] = 100.0;
  p.make_room(SecondRow::gradient, 1.0, /*of_stages=*/false, /*rings=*/true);
  Group group;
  group.body = &charge;
  group.end = 1;
  set.groups.push_back(group);
  const Sums before = sums_of(set, group);
  const Vec3 offset(0.2, 0.1, 0.0);
  split(set, {{.particle = 0, .offset = offset, .parting = 0.3 * offset, .share = 0.5 + 0.5 * 0.2 / 0.5}});
  const Sums after = sums_of(set, set.groups[0]);
  ASSERT_EQ(p.size(), 2u);
  EXPECT_NEAR(p.mass[0] / p.x[0], p.mass[1] / p.x[1], 1e-14 * p.mass[0] / p.x[0]);
  EXPECT_NEAR(after.mass, before.mass, 1e-14);
  EXPECT_NEAR(after.moment[1], before.moment[1], 1e-14);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13);
  EXPECT_NEAR(after.kinetic + after.internal, before.kinetic + before.internal, 1e-11);
  EXPECT_GT(after.kinetic, before.kinetic);
}

/// Gas that expands into nothing beside a wall and symmetry planes, in water's company.
Settings expanding(int dimension, bool rings, int threads = 1) {
  Settings settings;
  settings.dimension = dimension;
  settings.axisymmetric = rings;
  settings.lattice.spacing = dimension == 1 ? 0.002 : 0.01;
  settings.symmetry.axis = {true, dimension == 3, false};
  const double high = dimension > 1 ? 0.08 : 0.0, deep = dimension > 2 ? 0.08 : 0.0, low = dimension > 1 ? -0.02 : 0.0;
  const Shape ball = box(Vec3(0, low, 0), Vec3(0.04, high / 2, deep / 2));
  Shape water = box(Vec3(0, low, 0), Vec3(0.08, high, deep));
  water.removed = {ball.base};
  settings.bodies = {body("gas", ball, "bubble-gas"), body("water", water, "water-tait")};
  settings.bodies[0].variable_h = true;
  settings.bodies[0].split = 64;
  settings.bodies[0].pressure = 3e8;
  settings.bodies[0].density = 200;
  settings.bodies[1].pressure = 1e5;
  if (dimension > 1) {
    Wall wall = box_wall(Vec3(-1, -0.02, -1), Vec3(1, 1, 1), FaceCondition::open);
    wall.faces["y_low"] = FaceCondition::free_slip;
    settings.walls = {wall};
  }
  settings.numerics.threads = threads;
  return settings;
}

struct Scene {
  int dimension;
  bool rings;
};
/// In one dimension gas has only one way to grow.
int steps_of(int dimension) { return dimension == 1 ? 2000 : dimension == 2 ? 600 : 150; }
class Expanding : public ::testing::TestWithParam<Scene> {};

TEST_P(Expanding, ConservesAndStaysWhereItIs) {
  const auto [dimension, rings] = GetParam();
  Fluid fluid(expanding(dimension, rings));
  const std::vector<BodyTotals> before = fluid.totals();
  const Ledger start = fluid.ledger();
  const std::size_t laid = fluid.particle_count();
  for (int k = 0; k < steps_of(dimension); ++k) fluid.step(fluid.step_limit().step);
  const std::vector<BodyTotals> after = fluid.totals();
  EXPECT_GT(fluid.particle_count(), laid + 5) << "nothing has split";
  EXPECT_EQ(fluid.particles_by_body()[1], fluid.particles_by_body_at_start()[1]) << "water does not split";
  for (std::size_t b = 0; b < 2; ++b) EXPECT_NEAR(after[b].mass, before[b].mass, 1e-13 * before[b].mass);
  const Ledger end = fluid.ledger();
  EXPECT_NEAR(total(end), total(start), 3e-3 * total(start));
  for (const Vec3& x : by_id(fluid, "position")) {
    EXPECT_GT(x[0], 0.0);
    if (dimension > 1) {
      EXPECT_GT(x[1], dimension == 3 ? -1e-12 : -0.02);
    }
  }
  std::vector<double> ids = fluid.field("id");
  std::sort(ids.begin(), ids.end());
  for (std::size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(ids[k], double(k));
}

/// No particle of gas stays twice as wide as its cell, but for the last steps.
TEST_P(Expanding, KeepsItsSpacing) {
  const auto [dimension, rings] = GetParam();
  Settings settings = expanding(dimension, rings);
  settings.bodies[0].split = 8192;  // more than its thinnest gas, into nothing, can use
  Fluid fluid(settings);
  for (int k = 0; k < steps_of(dimension); ++k) fluid.step(fluid.step_limit().step);
  const std::vector<double> h = fluid.field("smoothing_length"), material = fluid.field("material");
  const double h0 = fluid.settings().numerics.eta * fluid.settings().lattice.spacing;
  for (std::size_t i = 0; i < h.size(); ++i)
    if (material[i] == 0.0) {
      EXPECT_LT(h[i], 1.1 * 2.0 * h0);
    }
}

INSTANTIATE_TEST_SUITE_P(InAllDimensions, Expanding,
                         ::testing::Values(Scene{1, false}, Scene{2, false}, Scene{2, true}, Scene{3, false}),
                         [](const auto& one) {
                           return std::to_string(one.param.dimension) + (one.param.rings ? "_rings" : "_dimensions");
                         });

/// Gas in a linear expansion v = x/t that is faster than its sound: nothing but the splitting can keep its particles apart. They
/// fill space evenly and move with it. Halves of one velocity would stay in pairs.
TEST(Split, FollowsALinearExpansion) {
  for (const int dimension : {1, 2, 3}) {
    Settings settings;
    settings.dimension = dimension;
    settings.lattice.spacing = dimension == 3 ? 0.1 : 0.05;
    settings.symmetry.axis = {true, dimension > 1, dimension > 2};
    const Vec3 corner(1, dimension > 1, dimension > 2);
    settings.bodies = {body("gas", box(Vec3::Zero(), corner), "tnt")};
    Body& gas = settings.bodies[0];
    gas.material.law = materials::IdealGas({.rho0 = 1.0, .gamma = 1.4});
    gas.material.rho0 = 1.0;
    gas.energy = 2e-3;  // c = 0.033
    gas.radial = RadialMotion{.speed = 1.0, .radius = 1.0, .power = 1.0};
    gas.variable_h = true;
    gas.split = 64;
    settings.numerics.courant = 0.02;  // a step is short against the expansion
    Fluid fluid(settings);
    const Ledger start = fluid.ledger();
    const double end = dimension == 1 ? 7.0 : dimension == 2 ? 3.5 : 2.0;  // it has grown (1 + end)^dimension
    while (fluid.time() < end) fluid.step(fluid.step_limit().step);
    EXPECT_NEAR(total(fluid.ledger()), total(start), 2e-3 * total(start));
    const std::vector<double> x = fluid.field("position"), v = fluid.field("velocity");
    EXPECT_GT(fluid.particle_count(), 4 * fluid.particles_by_body_at_start()[0]);
    const double edge = 0.6 * (1.0 + fluid.time());  // its surface expands by its own pressure
    const double cell = settings.lattice.spacing * std::pow(0.5 * full_growth(dimension), 1.0 / dimension);  // of a half
    double nearest = 1.0, farthest_off = 0.0;
    for (std::size_t i = 0; i < x.size() / 3; ++i) {
      const Vec3 at = vector_of(x, i);
      if (at.maxCoeff() > edge) continue;
      farthest_off = std::max(farthest_off, (vector_of(v, i) * (1.0 + fluid.time()) - at).norm() / cell);
      for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (at - vector_of(x, j)).norm() / cell);
    }
    EXPECT_GT(nearest, 0.5);
    EXPECT_LT(farthest_off, 0.75);
  }
}

/// Two streams torn apart: where volumes claim space that is not there, nobody splits. Otherwise halves stand on each other.
TEST(Split, WaitsForTheSpace) {
  Settings settings;
  settings.dimension = 1;
  settings.lattice.spacing = 0.0025;
  settings.bodies = {body("left", box(Vec3(0, 0, 0), Vec3(0.5, 0, 0)), "sjogreen-gas"),
                     body("right", box(Vec3(0.5, 0, 0), Vec3(1, 0, 0)), "sjogreen-gas")};
  for (Body& each : settings.bodies) {
    each.velocity[0] = each.name == "left" ? -2.0 : 2.0;
    each.variable_h = true;
    each.split = 64;
  }
  settings.numerics.courant = 0.1;
  Fluid fluid(settings);
  while (fluid.time() < 0.15) fluid.step(fluid.step_limit().step);
  const std::vector<double> places = fluid.field("position");
  std::vector<double> x;
  for (std::size_t i = 0; i < fluid.particle_count(); ++i) x.push_back(places[3 * i]);
  std::sort(x.begin(), x.end());
  double nearest = 1.0, farthest = 0.0;
  for (std::size_t k = 1; k < x.size(); ++k) {
    nearest = std::min(nearest, (x[k] - x[k - 1]) / 0.0025);
    if (std::abs(x[k] - 0.5) < 0.4) farthest = std::max(farthest, (x[k] - x[k - 1]) / 0.0025);
  }
  EXPECT_GT(nearest, 0.2);
  EXPECT_LT(farthest, 3.0);
}

/// The gap between two streams of ideal gas torn apart at five times their sound speed, at t = 0.03 [m].
double gap_of_streams(double spacing) {
  Settings settings;
  settings.dimension = 1;
  settings.lattice.spacing = spacing;
  settings.bodies = {body("left", box(Vec3(-0.5, 0, 0), Vec3(0, 0, 0)), "tnt"),
                     body("right", box(Vec3(0, 0, 0), Vec3(0.5, 0, 0)), "tnt")};
  for (Body& each : settings.bodies) {
    each.material.law = materials::IdealGas({.rho0 = 1.0, .gamma = 5.0 / 3.0});
    each.material.rho0 = 1.0;
    each.energy = 0.9;
    each.velocity[0] = each.name == "left" ? -5.0 : 5.0;
    each.variable_h = true;
    each.split = 64;
  }
  Fluid fluid(settings);
  while (fluid.time() < 0.03) fluid.step(std::min(fluid.step_limit().step, 0.03 * (1 + 1e-12) - fluid.time()));
  const std::vector<double> places = fluid.field("position");
  double left = -1.0, right = 1.0;
  for (std::size_t i = 0; i < fluid.particle_count(); ++i) {
    const double x = places[3 * i];
    if (x < 0.0) left = std::max(left, x);
    else right = std::min(right, x);
  }
  return right - left;
}

/// The gas escapes at three times its sound speed, so the vacuum grows at 2 to either side. Unsplit gas has a gap of 0.21, with
/// either spacing.
TEST(Split, VacuaConvergeToTheirWidth) {
  const double exact = 0.12, coarse = gap_of_streams(1.0 / 800) - exact, fine = gap_of_streams(1.0 / 1600) - exact;
  EXPECT_LT(std::abs(coarse), 0.3 * exact);
  EXPECT_LT(std::abs(fine), 0.5 * std::abs(coarse));
}

TEST(Split, DoesNotDependOnTheNumberOfThreads) {
  std::vector<double> places, ids;
  for (const int threads : {1, 3}) {
    Fluid fluid(expanding(2, false, threads));
    for (int k = 0; k < 600; ++k) fluid.step(fluid.step_limit().step);
    if (threads == 1) {
      places = fluid.field("position");
      ids = fluid.field("id");
      ASSERT_GT(ids.size(), fluid.particles_by_body_at_start()[0] + fluid.particles_by_body_at_start()[1]);
      continue;
    }
    EXPECT_EQ(fluid.field("position"), places);
    EXPECT_EQ(fluid.field("id"), ids);
  }
}

TEST(Split, EndsAtItsLimit) {
  Settings settings = expanding(2, false);
  settings.bodies[0].split = 2;
  Fluid fluid(settings);
  for (int k = 0; k < 600; ++k) fluid.step(fluid.step_limit().step);
  EXPECT_EQ(fluid.particles_by_body()[0], 2 * fluid.particles_by_body_at_start()[0]);
  // Each once: no part is lighter than a half.
  const std::vector<double> mass = fluid.field("mass"), material = fluid.field("material");
  double least = 1e300, most = 0;
  for (std::size_t i = 0; i < mass.size(); ++i)
    if (material[i] == 0.0) least = std::min(least, mass[i]), most = std::max(most, mass[i]);
  EXPECT_NEAR(least, most, 1e-12 * most);
  settings.bodies[0].split = 1;
  Fluid whole(settings);
  for (int k = 0; k < 600; ++k) whole.step(whole.step_limit().step);
  EXPECT_EQ(whole.particles_by_body()[0], whole.particles_by_body_at_start()[0]);
}

/// With the Runge-Kutta method and with steps of their own.
TEST(Split, HappensWithEveryIntegrator) {
  for (const bool local : {false, true}) {
    Settings settings = expanding(2, false);
    settings.numerics.integrator = local ? Integrator::leapfrog : Integrator::ssp_rk3;
    settings.numerics.local_steps = local;
    Fluid fluid(settings);
    const Ledger start = fluid.ledger();
    while (fluid.time() < 6e-4) fluid.step(fluid.step_limit().step);
    EXPECT_GT(fluid.particles_by_body()[0], fluid.particles_by_body_at_start()[0]);
    EXPECT_NEAR(total(fluid.ledger()), total(start), 3e-3 * total(start));
  }
}

}  // namespace
}  // namespace undex::sph::testing
