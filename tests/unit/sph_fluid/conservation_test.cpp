// What the space discretisation conserves to round-off, and how fast the time integrator's error falls.
#include <gtest/gtest.h>

#include "pair_sample.hpp"
#include "scenes.hpp"

namespace undex::sph::testing {
namespace {

/// A closed blob: water, a gas a thousand times thinner whose h varies, a third body with an h of its own.
Sample blob(int dimension, SchemeName scheme, KernelName kernel) {
  Dice dice(11);
  Sample sample;
  sample.dimension = dimension;
  sample.scheme = scheme;
  sample.kernel = kernel;
  const double dx = 0.1, h = 1.5 * dx;
  Set water{{}, false, 2 * dx}, gas{{}, true, 3 * dx}, metal{{}, false, 3 * dx};
  const double side = dimension == 1 ? 20.0 : dimension == 2 ? 1.5 : 0.7;
  const auto anywhere = [&] {
    Vec3 x = Vec3::Zero();
    for (int a = 0; a < dimension; ++a) x[a] = dice.between(-side / 2, side / 2);
    return x;
  };
  for (int k = 0; k < 250; ++k) water.particles.push_back(random_particle(dice, anywhere(), dimension, h, dx, 1000, 1e8, 1500));
  for (int k = 0; k < 150; ++k)
    gas.particles.push_back(random_particle(dice, anywhere(), dimension, h * dice.between(0.7, 2), dx, 1, 1e6, 700));
  for (int k = 0; k < 50; ++k)
    metal.particles.push_back(random_particle(dice, anywhere(), dimension, 1.4 * h, dx, 3000, 1e9, 5000));
  sample.sets = {water, gas, metal};
  return sample;
}

void add_walls(Sample& sample, double slip, bool moving) {
  Dice dice(5);
  for (int k = 0; k < 80; ++k) {
    Vec3 x = Vec3::Zero(), n = Vec3::Zero(), v = Vec3::Zero();
    for (int a = 0; a < sample.dimension; ++a) {
      x[a] = dice.between(-0.3, 0.3);
      n[a] = dice.between(-1, 1);
      if (moving) v[a] = dice.between(-80, 80);
    }
    n.normalize();
    const double volume = std::pow(0.1, sample.dimension) * dice.between(0.5, 1.5);
    sample.walls.push_back(wall_particle(x, v, n, volume, slip));
  }
}

struct Balance {
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  double energy = 0;
  double momentum_scale = 0, angular_scale = 0, energy_scale = 0;
};

Balance balance(const Result& r) {
  Balance b;
  for (std::size_t i = 0; i < r.particles.size(); ++i) {
    const Particle& q = r.particles[i];
    const Rate& rate = r.rates[i];
    const double m = q.rho * q.volume;
    b.momentum += m * rate.a;
    b.momentum_scale += m * rate.a.norm();
    const Vec3 x = place(q);
    b.angular +=
        m * Vec3(x[1] * rate.a[2] - x[2] * rate.a[1], x[2] * rate.a[0] - x[0] * rate.a[2], x[0] * rate.a[1] - x[1] * rate.a[0]);
    b.angular_scale += m * x.norm() * rate.a.norm();
    const double kinetic = m * speed(q).dot(rate.a), internal = m * q.p / q.rho * rate.compression, heat = m * rate.heat;
    b.energy += kinetic + internal + heat;
    b.energy_scale += std::abs(kinetic) + std::abs(internal) + std::abs(heat);
  }
  for (std::size_t k = 0; k < r.walls.size(); ++k) {
    b.momentum += r.wall_forces[k].a;
    const double power = r.wall_forces[k].a.dot(speed(r.walls[k]));
    b.energy += power;
    b.energy_scale += std::abs(power);
  }
  return b;
}

struct Scheme {
  SchemeName scheme;
  KernelName kernel;
  std::string name;
};
void PrintTo(const Scheme& s, std::ostream* out) { *out << s.name; }

class Conservation : public ::testing::TestWithParam<Scheme> {
 protected:
  Sample make(int dimension) const { return blob(dimension, GetParam().scheme, GetParam().kernel); }
};

TEST_P(Conservation, ClosedBlob) {
  for (const char* level : {"x86-64-v2", "x86-64-v3", "x86-64-v4"})
    for (int d = 1; d <= 3; ++d) {
      SCOPED_TRACE(std::string(level) + ", dimensions: " + std::to_string(d));
      const AtLevel at(level);
      const Balance b = balance(run(make(d)));
      ASSERT_GT(b.momentum_scale, 0.0);
      EXPECT_LT(b.momentum.norm(), 1e-12 * b.momentum_scale);
      EXPECT_LT(b.angular.norm(), 1e-12 * b.angular_scale);
      EXPECT_LT(std::abs(b.energy), 1e-12 * b.energy_scale);
    }
}

/// What the fluid loses the wall receives: momentum, and the work at the wall's own velocity.
TEST_P(Conservation, MovingWalls) {
  for (int d = 1; d <= 3; ++d)
    for (const double slip : {1.0, 0.0}) {
      SCOPED_TRACE(std::string(slip > 0 ? "free slip" : "no slip") + ", dimensions: " + std::to_string(d));
      Sample sample = make(d);
      add_walls(sample, slip, true);
      const Result result = run(sample);
      const Balance b = balance(result);
      EXPECT_LT(b.momentum.norm(), 1e-12 * b.momentum_scale);
      EXPECT_LT(std::abs(b.energy), 1e-12 * b.energy_scale);
      double power = 0, fluid = 0;
      for (std::size_t k = 0; k < result.walls.size(); ++k) power += result.wall_forces[k].a.dot(speed(result.walls[k]));
      EXPECT_GT(std::abs(power), 1e-4 * b.energy_scale) << "a wall that takes no work shows nothing";
      for (std::size_t i = 0; i < result.rates.size(); ++i) fluid += std::abs(result.rates[i].a.norm());
      EXPECT_GT(fluid, 0.0);
    }
}

/// Walls at rest take no energy, whatever the slip.
TEST_P(Conservation, WallsAtRestTakeNoEnergy) {
  for (const double slip : {1.0, 0.0}) {
    Sample sample = make(3);
    add_walls(sample, slip, false);
    const Balance b = balance(run(sample));
    EXPECT_LT(std::abs(b.energy), 1e-12 * b.energy_scale) << slip;
  }
}

/// Symmetry planes do no work: kept particles and their images exchange none.
TEST_P(Conservation, SymmetryPlanesDoNoWork) {
  for (const bool walls : {false, true}) {
    Sample sample = make(3);
    for (Set& set : sample.sets)
      for (Particle& q : set.particles) {
        q.x = std::abs(q.x);
        q.z = std::abs(q.z);
      }
    sample.mirror[0] = sample.mirror[2] = true;
    if (walls) {
      add_walls(sample, 1.0, true);
      for (WallParticle& w : sample.walls) {
        w.x = std::abs(w.x);
        w.z = std::abs(w.z);
      }
    }
    const Balance b = balance(run(sample));
    EXPECT_LT(std::abs(b.energy), 1e-12 * b.energy_scale) << (walls ? "with walls" : "without walls");
    // Momentum along the plane only: the planes carry the rest.
    EXPECT_LT(std::abs(b.momentum[1]), 1e-12 * b.momentum_scale);
    EXPECT_GT(std::abs(b.momentum[0]), 1e-6 * b.momentum_scale);
  }
}

/// Viscosity heats every particle; of a pairwise flux only the sum must be positive.
TEST_P(Conservation, HeatIsPositive) {
  const double least = is_viscous(GetParam().scheme) ? 0.0 : -std::numeric_limits<double>::infinity();
  const Result r = run(make(3));
  double total = 0;
  for (const Rate& rate : r.rates) {
    EXPECT_GE(rate.heat, least);
    total += rate.heat;
  }
  EXPECT_GT(total, 0.0);
}

/// A solid rotation is no compression and calls for no viscosity.
TEST_P(Conservation, RotationIsFree) {
  Sample sample = make(3);
  sample.sets.resize(1);
  for (Particle& q : sample.sets[0].particles) {
    q.vx = -30.0 * q.y;
    q.vy = 30.0 * q.x;
    q.vz = 0.0;
    q.p = 0.0;
  }
  for (const Rate& rate : run(sample).rates) {
    EXPECT_NEAR(rate.compression, 0.0, 1e-10);
    EXPECT_NEAR(rate.heat, 0.0, 1e-6);
    EXPECT_NEAR(rate.a.norm(), 0.0, 1e-3);
  }
}

const std::vector<Scheme> schemes{{SchemeName::monaghan, KernelName::wendland_c2, "monaghan_wendland"},
                                  {SchemeName::monaghan, KernelName::gaussian, "monaghan_gaussian"},
                                  {SchemeName::riemann, KernelName::wendland_c2, "riemann_wendland"},
                                  {SchemeName::riemann, KernelName::gaussian, "riemann_gaussian"},
                                  {SchemeName::riemann, KernelName::quintic_spline, "riemann_quintic"},
                                  {SchemeName::paper, KernelName::gaussian, "paper_gaussian"},
                                  {SchemeName::monaghan_switch, KernelName::wendland_c2, "switch_wendland"},
                                  {SchemeName::riemann_corrected, KernelName::wendland_c2, "corrected_wendland"},
                                  {SchemeName::riemann_corrected, KernelName::wendland_c6, "corrected_wendland_c6"}};
const auto name_of = [](const auto& c) { return c.param.name; };
INSTANTIATE_TEST_SUITE_P(, Conservation, ::testing::ValuesIn(schemes), name_of);

/// The gradients that the Riemann scheme reconstructs from are exact for linear fields, even among scattered neighbours.
TEST(Reconstruction, LinearFieldsAreExact) {
  for (int d = 1; d <= 3; ++d) {
    Dice dice(2);
    Sample sample;
    sample.dimension = d;
    sample.scheme = SchemeName::riemann;
    const double dx = 0.1;
    Set set{{}, false, 2 * dx};
    Mat3 slope;
    slope << 3, -7, 2, 5, 11, -4, 6, 1, -9;
    const Vec3 climb(1e6, -3e6, 2e6);
    const int n = d == 1 ? 40 : 8;
    for (int k = 0; k < (d > 2 ? n : 1); ++k)
      for (int j = 0; j < (d > 1 ? n : 1); ++j)
        for (int i = 0; i < n; ++i) {
          Vec3 x = Vec3::Zero();
          const int at[3] = {i, j, k};
          for (int a = 0; a < d; ++a) x[a] = dx * (at[a] + dice.between(-0.2, 0.2));
          Particle q = random_particle(dice, x, d, 1.5 * dx, dx, 1000, 1, 1500);
          const Vec3 v = slope.topLeftCorner(3, 3) * x;
          q.vx = v[0];
          q.vy = d > 1 ? v[1] : 0.0;
          q.vz = d > 2 ? v[2] : 0.0;
          q.p = 1e9 + climb.dot(x);
          set.particles.push_back(q);
        }
    sample.sets.push_back(set);
    const Result r = run(sample);
    const int pair[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    for (std::size_t i = 0; i < r.gradients.size(); ++i) {
      const GradientRow& g = r.gradients[i];
      // At the blob's corners neighbours are too few, and the sums stand uncorrected.
      bool inside = true;
      for (int a = 0; a < d; ++a)
        inside = inside && place(r.particles[i])[a] > 0.9 * dx && place(r.particles[i])[a] < (n - 1.9) * dx;
      if (!inside) continue;
      for (int a = 0; a < d; ++a) {
        EXPECT_NEAR(g.strain[a], slope(a, a), 1e-4);
        EXPECT_NEAR(g.pressure[a], climb[a], 20.0);
      }
      for (int s = 0; s < 3; ++s)
        if (pair[s][0] < d && pair[s][1] < d) {
          EXPECT_NEAR(g.strain[3 + s], 0.5 * (slope(pair[s][0], pair[s][1]) + slope(pair[s][1], pair[s][0])), 1e-4);
        }
    }
  }
}

/// Gas whose volumes claim `excess` times the space that it has, in a uniform expansion: where the filling is divided out,
/// volumes change as the surroundings do and not `excess` times as fast, the one error that would feed on itself.
TEST(Filling, WrongVolumesExpandAsTheirSurroundings) {
  for (int d = 1; d <= 3; ++d)
    for (const double excess : {0.7, 1.0, 3.0, 50.0})
      for (const bool gas : {true, false}) {
        Dice dice(3);
        Sample sample;
        sample.dimension = d;
        sample.scheme = SchemeName::riemann;
        const double dx = 0.1;
        Set set{{}, gas, 2 * dx};
        const int n = 15;  // what the middle's neighbours see is whole
        for (int k = 0; k < (d > 2 ? n : 1); ++k)
          for (int j = 0; j < (d > 1 ? n : 1); ++j)
            for (int i = 0; i < n; ++i) {
              const Vec3 x = dx * Vec3(i, j, k);
              Particle q = random_particle(dice, x, d, 1.5 * dx, dx, 1, 1, 700);
              q.vx = 2.0 * x[0];
              q.vy = 2.0 * x[1];
              q.vz = 2.0 * x[2];
              q.p = 1e5;
              q.rho = 1.0;
              q.volume = excess * std::pow(dx, d);
              set.particles.push_back(q);
            }
        sample.sets.push_back(set);
        const Result r = run(sample);
        std::size_t inside = 0;
        for (std::size_t i = 0; i < r.particles.size(); ++i) {
          if ((place(r.particles[i]).head(d) - 7 * dx * Vec3::Ones().head(d)).norm() > 0.5 * dx) continue;
          ++inside;
          EXPECT_NEAR(r.rates[i].compression, -2.0 * d * (gas ? 1.0 : excess), (gas ? 1e-6 : 0.02 * excess) * 2.0 * d)
              << d << "D, " << excess;
        }
        EXPECT_EQ(inside, 1u);
      }
}

// ---- Runs ----------------------------------------------------------------------------------------------------------

/// A free blob of water at high pressure with gas inside: nothing outside to exchange with.
TEST_P(Conservation, FreeBlobRun) {
  double error[2];
  for (const int fine : {0, 1}) {
    Settings settings;
    settings.dimension = 2;
    settings.lattice.spacing = 0.05;
    const Sphere bubble{Vec3(0.1, 0.05, 0), 0.3};
    Body water = body("water", Shape{Sphere{Vec3::Zero(), 0.8}, {bubble}}, "water-tait");
    water.pressure = 5e7;
    water.velocity = {20, -10, 0};
    Body gas = body("gas", Shape{bubble, {}}, "bubble-gas");
    gas.density = 300.0;
    gas.variable_h = true;
    settings.bodies = {water, gas};
    settings.numerics.threads = 1;
    settings.numerics.scheme = GetParam().scheme;
    settings.numerics.kernel = GetParam().kernel;
    settings.numerics.courant = fine ? 0.15 : 0.3;
    Fluid fluid(settings);
    const Ledger start = fluid.ledger();
    while (fluid.time() < 4e-4) fluid.step(fluid.step_limit().step);
    const Ledger end = fluid.ledger();
    const std::vector<double> m = fluid.field("mass"), v = fluid.field("velocity");
    double speed_sum = 0;
    for (std::size_t i = 0; i < m.size(); ++i) speed_sum += m[i] * vector_of(v, i).norm();
    EXPECT_NEAR(end.mass, start.mass, 1e-14 * start.mass);
    EXPECT_LT((end.momentum - start.momentum).norm(), 1e-12 * speed_sum);
    error[fine] = std::abs(total(end) - total(start)) / end.kinetic;
  }
  // Measured at the usual Courant number: 3e-4 to 1.3e-3 of the kinetic energy, less than a quarter of it at half the step.
  // Corrected gradients are stiffer at free surfaces: 2.5e-3 and 6e-3 (Wendland C2, C6), an eighth or less at half the step.
  const bool corrected = GetParam().scheme == SchemeName::riemann_corrected;
  EXPECT_LT(error[0], corrected ? 1e-2 : 2e-3);
  EXPECT_LT(error[1], (corrected ? 0.2 : 0.4) * error[0]);
  RecordProperty("energy_error_of_kinetic",
                 std::to_string(error[0] * 1e6) + "e-6, half step " + std::to_string(error[1] * 1e6) + "e-6");
}

/// Kinetic, internal and dissipated energy together drift by the integrator's error alone, of second order in dt.
TEST_P(Conservation, EnergyDriftIsOfSecondOrder) {
  std::vector<double> drift;
  const double end = 0.08;
  for (const int steps : {40, 80, 160}) {
    Settings settings;
    settings.dimension = 1;
    settings.lattice.spacing = 0.02;
    settings.numerics.threads = 1;
    settings.numerics.scheme = GetParam().scheme;
    settings.numerics.kernel = GetParam().kernel;
    Body left = body("left", box(Vec3(0, 0, 0), Vec3(0.5, 1, 1)), "sjogreen-gas");
    Body right = body("right", box(Vec3(0.5, 0, 0), Vec3(1, 1, 1)), "sjogreen-gas");
    left.density = 1.4;
    right.density = 1.0;
    settings.bodies = {left, right};
    settings.walls = {box_wall(Vec3(0, -9, -9), Vec3(1, 9, 9))};
    Fluid fluid(settings);
    const double start = total(fluid.ledger());
    for (int k = 0; k < steps; ++k) fluid.step(end / steps);
    drift.push_back(std::abs(total(fluid.ledger()) - start));
  }
  const double order = std::log2(drift[0] / drift[2]) / 2;
  RecordProperty("drift", std::to_string(drift[0] * 1e9) + "e-9 " + std::to_string(drift[2] * 1e9) + "e-9");
  RecordProperty("order", std::to_string(order));
  // The limiter's kinks cost the Riemann scheme its second order.
  EXPECT_GT(order, is_viscous(GetParam().scheme) ? 1.7 : 1.0) << drift[0] << " " << drift[1] << " " << drift[2];
}

}  // namespace
}  // namespace undex::sph::testing
