// The hexahedron by itself: patch test, rigid motion, zero modes, highest frequency.
#include "fem_structure/elements.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>

#include "bodies.hpp"
#include "matrices.hpp"

namespace undex::fem::testing {
namespace {

using Nodes = std::vector<Vec3>;

struct Moved {
  Nodes x, force;
};

/// Takes the cells from x to map(reference) in one step.
template <class Map>
void move(Elements& elements, const Grid& grid, Moved& at, const Map& map) {
  Nodes u(grid.nodes.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Vec3 to = map(grid.nodes[i]);
    u[i] = to - at.x[i];
    at.x[i] = to;
  }
  ASSERT_EQ(elements.advance(at.x, u, 1.0, at.force), -1);
}

Mat3 rotation(double angle) { return Eigen::AngleAxisd(angle, Vec3(1, 2, -2).normalized()).toRotationMatrix(); }

double largest(const Nodes& values) {
  double most = 0.0;
  for (const Vec3& v : values) most = std::max(most, v.norm());
  return most;
}

TEST(Elements, LinearDisplacementGivesUniformStressAndNoForceInside) {
  const Grid grid = distorted_block({3, 3, 3}, 0.15);
  for (double size : {1e-7, 0.1}) {
    Elements elements(grid, elastic(1.0, 1.0, 0.3), 0.0, 0.0);
    Mat3 slope;
    slope << 0.3, -0.7, 0.2, 0.5, 0.9, -0.1, 0.4, 0.6, -0.8;
    slope *= size;
    Moved at{grid.nodes, Nodes(grid.nodes.size(), Vec3::Zero())};
    move(elements, grid, at, [&](const Vec3& x) { return Vec3(x + slope * x); });
    const Mat3 first = elements.stress(0, 0);
    for (std::size_t c = 0; c < grid.cells.size(); ++c)
      for (int q = 0; q < 8; ++q) EXPECT_LT((elements.stress(c, q) - first).norm(), 1e-8 * 1e-7 + 1e-13);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
      const Vec3 inside = (grid.nodes[i] - Vec3::Constant(1.5)).cwiseAbs();
      if (inside.maxCoeff() < 1.0) {
        EXPECT_LT(at.force[i].norm(), 1e-13);
      }
    }
    EXPECT_GT(largest(at.force), 0.1 * size);
    if (size < 1e-3) {
      const Mat3 strain = 0.5 * (slope + slope.transpose());
      const Mat3 hooke = 2.0 * elastic(1, 1, 0.3).shear_modulus * strain + 0.3 / (1.3 * 0.4) * strain.trace() * Mat3::Identity();
      EXPECT_LT((first - hooke).norm(), 1e-6 * hooke.norm());
    }
  }
}

TEST(Elements, RigidMotionMakesNoStress) {
  const Grid grid = distorted_block({2, 2, 2}, 0.15);
  Elements elements(grid, elastic(1.0, 1.0, 0.3), 0.06, 1.2);
  Moved at{grid.nodes, Nodes(grid.nodes.size(), Vec3::Zero())};
  const int steps = 400;
  for (int step = 1; step <= steps; ++step)  // three turns, a hundred cell sizes away
    move(elements, grid, at, [&](const Vec3& x) {
      return Vec3(rotation(6.0 * std::numbers::pi * step / steps) * x + Vec3(100, 50, -30) * step / steps);
    });
  double most = 0.0;
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    for (int q = 0; q < 8; ++q) most = std::max(most, elements.stress(c, q).norm());
  RecordProperty("stress_over_E", std::to_string(most));
  EXPECT_LT(most, 1e-11);
  EXPECT_LT(largest(at.force), 1e-11);
}

TEST(Elements, StressTurnsWithTheBody) {
  const Grid grid = distorted_block({2, 2, 2}, 0.15);
  Elements elements(grid, elastic(1.0, 1.0, 0.3), 0.0, 0.0);
  Moved at{grid.nodes, Nodes(grid.nodes.size(), Vec3::Zero())};
  const auto strained = [](const Vec3& x) {
    return Vec3(x[0] + 0.02 * x[1] + 0.01 * x[0] * x[2], x[1] * 1.01, x[2] - 0.01 * x[0]);
  };
  move(elements, grid, at, strained);
  std::vector<Mat3> before;
  for (int q = 0; q < 8; ++q) before.push_back(elements.stress(3, q));
  const Nodes force = at.force;
  const double energy = elements.elastic_energy();
  const int steps = 50;
  for (int step = 1; step <= steps; ++step)
    move(elements, grid, at, [&](const Vec3& x) { return Vec3(rotation(2.0 * step / steps) * strained(x)); });
  const Mat3 turn = rotation(2.0);
  for (int q = 0; q < 8; ++q)
    EXPECT_LT((elements.stress(3, q) - turn * before[q] * turn.transpose()).norm(), 1e-11 * before[q].norm());
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_LT((at.force[i] - turn * force[i]).norm(), 1e-11 * largest(force));
  EXPECT_NEAR(elements.elastic_energy(), energy, 1e-11 * energy);
}

TEST(Elements, ForceIsTheDerivativeOfTheWork) {
  // The energy of a small closed loop of displacements is zero, and its work equals force times displacement.
  const Grid grid = distorted_block({2, 1, 1}, 0.1);
  Elements elements(grid, elastic(1.0, 1.0, 0.3), 0.0, 0.0);
  Moved at{grid.nodes, Nodes(grid.nodes.size(), Vec3::Zero())};
  double work = 0.0;
  const int steps = 200;
  const auto shape = [](const Vec3& x) { return Vec3(0.3 * x[1] * x[2], std::sin(x[0]), 0.2 * x[0] * x[0] - x[1]); };
  for (int step = 1; step <= steps; ++step) {
    const Nodes old_force = at.force, old_x = at.x;
    move(elements, grid, at, [&](const Vec3& x) { return Vec3(x + 0.05 * step / steps * shape(x)); });
    for (std::size_t i = 0; i < at.x.size(); ++i) work += 0.5 * (old_force[i] + at.force[i]).dot(at.x[i] - old_x[i]);
  }
  EXPECT_NEAR(elements.elastic_energy(), work, 1e-5 * work);
  for (int step = steps - 1; step >= 0; --step)
    move(elements, grid, at, [&](const Vec3& x) { return Vec3(x + 0.05 * step / steps * shape(x)); });
  EXPECT_LT(std::abs(elements.elastic_energy()), 1e-5 * work);
}

TEST(Elements, OneCellHasSixZeroModes) {
  const Grid grid = distorted_block({1, 1, 1}, 0.15);
  const Elements elements(grid, elastic(1.0, 1.0, 0.3), 0.0, 0.0);
  const Matrices m(elements, grid);
  EXPECT_LT((m.stiffness - m.stiffness.transpose()).norm(), 1e-14 * m.stiffness.norm());
  const Eigen::VectorXd values = eigenvalues(m.stiffness);
  EXPECT_LT(std::abs(values[5]), 1e-14 * values[23]);
  EXPECT_GT(values[0], -1e-14 * values[23]);
  EXPECT_GT(values[6], 0.01 * values[23]) << "an hourglass mode";
}

TEST(Elements, NearlyIncompressibleCellStaysSoftInBending) {
  // Ten hourglass-like modes of a nearly incompressible cell must stay of the order of the shear modulus, not of the
  // bulk modulus: only one volumetric constraint per cell.
  const Grid grid = distorted_block({1, 1, 1}, 0.1);
  const Elements elements(grid, elastic(1.0, 1.0, 0.49999), 0.0, 0.0);
  const Matrices m(elements, grid);
  const Eigen::VectorXd values = eigenvalues(m.stiffness);
  EXPECT_LT(values[22], 2.0);
  EXPECT_GT(values[23], 1e3);
}

TEST(Elements, LinearForceIsTheTangent) {
  const Grid grid = distorted_block({2, 2, 1}, 0.15);
  Elements elements(grid, elastic(1.0, 1.0, 0.3), 0.0, 0.0);
  Nodes u(grid.nodes.size()), x = grid.nodes, force(u.size()), linear(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    u[i] = 1e-7 * Vec3(std::sin(i), std::cos(2.0 * i), std::sin(3.0 * i + 1));
    x[i] += u[i];
  }
  elements.linear_force(grid.nodes, u, linear);
  ASSERT_EQ(elements.advance(x, u, 1.0, force), -1);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_LT((force[i] - linear[i]).norm(), 1e-5 * largest(linear));
}

TEST(Elements, StableStepOfOneCellIsItsHighestFrequency) {
  for (double poisson : {0.0, 0.3, 0.45}) {
    const Grid grid = distorted_block({1, 1, 1}, 0.2);
    const Elements elements(grid, elastic(1.0, 1.0, poisson), 0.0, 0.0);
    const Matrices m(elements, grid);
    EXPECT_NEAR(elements.critical_step() * m.highest_frequency(), 2.0, 2e-3);
  }
}

TEST(Elements, StableStepIsSafeForAnAssembly) {
  for (double poisson : {0.0, 0.3, 0.45}) {
    const Grid grid = distorted_block({3, 3, 2}, 0.15);
    const Elements elements(grid, elastic(1.0, 1.0, poisson), 0.0, 0.0);
    const Matrices m(elements, grid);
    const double share = elements.critical_step() * m.highest_frequency() / 2.0;
    RecordProperty("share_of_true_limit_" + std::to_string(poisson), std::to_string(share));
    EXPECT_LE(share, 1.0);
    EXPECT_GT(share, 0.6);
  }
}

TEST(Elements, StableStepFollowsTheStrainedCells) {
  const Grid grid = distorted_block({2, 2, 2}, 0.1);
  Elements elements(grid, elastic(1.0, 1.0, 0.3), 0.0, 0.0);
  Moved at{grid.nodes, Nodes(grid.nodes.size(), Vec3::Zero())};
  for (int step = 1; step <= 150; ++step) {
    move(elements, grid, at, [&](const Vec3& x) { return Vec3(x[0] * (1 - 0.003 * step), x[1], x[2] + 0.002 * step * x[1]); });
    if (step % 15) continue;
    Grid now = grid;
    now.nodes = at.x;
    const Matrices m(elements, now);
    const double share = elements.critical_step() * m.highest_frequency() / 2.0;
    EXPECT_LE(share, 1.0) << step;
    EXPECT_GT(share, 0.6) << step;
  }
}

/// Largest velocity after central differences of a free bar, started with noise of size 1.
double shaken_bar(double share_of_limit) {
  const Grid grid = Mesher(plate(Vec3(0, 0, 0), Vec3(4, 4, 40), {1, 1, 40}, elastic(1.0, 1.0, 0.0))).grid();
  Elements elements(grid, elastic(1.0, 1.0, 0.0), 0.0, 0.0);
  const double dt = share_of_limit * elements.critical_step();
  Nodes x = grid.nodes, v(x.size()), u(x.size()), force(x.size(), Vec3::Zero());
  for (std::size_t i = 0; i < x.size(); ++i) v[i] = 1e-6 * Vec3(0, 0, std::sin(7.0 * (i / 4) * (i / 4)));
  for (int step = 0; step < 300; ++step) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      v[i] -= dt / elements.nodal_mass()[i] * force[i];
      u[i] = dt * v[i];
      x[i] += u[i];
    }
    if (elements.advance(x, u, dt, force) >= 0) return 1e300;
  }
  return 1e6 * largest(v);
}

TEST(Elements, BarBlowsUpJustBeyondTheStableStep) {
  EXPECT_LT(shaken_bar(0.95), 10.0);
  EXPECT_LT(shaken_bar(0.999), 100.0);
  EXPECT_GT(shaken_bar(1.05), 1e5);
}

}  // namespace
}  // namespace undex::fem::testing
