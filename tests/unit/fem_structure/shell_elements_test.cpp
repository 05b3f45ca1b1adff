// The solid shell by itself: patch tests, rigid motion, zero modes, energy, highest frequency, locking of the thickness.
#include "fem_structure/shell_elements.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>

#include "bodies.hpp"
#include "matrices.hpp"

namespace undex::fem::testing {
namespace {

using Nodes = std::vector<Vec3>;

/// A sheet of nx x ny cells in the plane across `through`, 1 m wide each, `thickness` thick.
Grid sheet(int through, std::array<int, 2> cells, double thickness) {
  Vec3 high;
  std::array<int, 3> n;
  n[through] = 1;
  high[through] = thickness;
  for (int d = 1; d < 3; ++d) high[(through + d) % 3] = n[(through + d) % 3] = cells[d - 1];
  return Mesher(plate(Vec3::Zero(), high, n, elastic(1, 1, 0.3))).grid();
}

/// Displaced in the plane only, alike at both faces.
void distort_in_plane(Grid& grid, int through, double size) {
  remap(grid, [&](Vec3 x) {
    const double a = x[(through + 1) % 3], b = x[(through + 2) % 3];
    x[(through + 1) % 3] += size * std::sin(3.1 * a + 5.3 * b + 1);
    x[(through + 2) % 3] += size * std::sin(4.7 * a - 2.9 * b + 2);
    return x;
  });
}

template <class Map>
void move(ElementSet& elements, const Grid& grid, Nodes& x, Nodes& force, const Map& map) {
  Nodes u(grid.nodes.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Vec3 to = map(grid.nodes[i]);
    u[i] = to - x[i];
    x[i] = to;
  }
  ASSERT_EQ(elements.advance(x, u, 1.0, force), -1);
}

Mat3 rotation(double angle) { return Eigen::AngleAxisd(angle, Vec3(1, 2, -2).normalized()).toRotationMatrix(); }

double largest(const Nodes& values) {
  double most = 0.0;
  for (const Vec3& v : values) most = std::max(most, v.norm());
  return most;
}

ShellElements shells(const Grid& grid, const materials::Solid& material, int through, int layers = 5) {
  return ShellElements(grid, material, 0.0, 0.0, through, layers);
}

TEST(ShellElements, MembranePatch) {
  // Any uniform strain of a flat sheet of distorted cells, in any orientation of the sheet and number of layers.
  for (int through = 0; through < 3; ++through)
    for (int layers : {2, 3, 5, 8}) {
      Grid grid = sheet(through, {3, 3}, 0.02);
      distort_in_plane(grid, through, 0.15);
      auto elements = shells(grid, elastic(1.0, 1.0, 0.3), through, layers);
      Mat3 slope;
      slope << 0.3, -0.7, 0.2, 0.5, 0.9, -0.1, 0.4, 0.6, -0.8;
      slope *= 1e-7;
      Nodes x = grid.nodes, force(x.size());
      move(elements, grid, x, force, [&](const Vec3& r) { return Vec3(r + slope * r); });
      const Mat3 strain = 0.5 * (slope + slope.transpose());
      const Mat3 hooke = 2.0 * elastic(1, 1, 0.3).shear_modulus * strain + 0.3 / (1.3 * 0.4) * strain.trace() * Mat3::Identity();
      for (std::size_t c = 0; c < grid.cells.size(); ++c)
        for (int q = 0; q < elements.points_per_cell(); ++q)
          EXPECT_LT((elements.stress(c, q) - hooke).norm(), 1e-6 * hooke.norm());
    }
}

TEST(ShellElements, LargeUniformStretchInOneStep) {
  Grid grid = sheet(2, {3, 3}, 0.02);
  distort_in_plane(grid, 2, 0.15);
  auto elements = shells(grid, elastic(1.0, 1.0, 0.3), 2);
  Mat3 slope;
  slope << 0.03, -0.07, 0.02, 0.05, 0.09, -0.01, 0.04, 0.06, -0.08;
  Nodes x = grid.nodes, force(x.size());
  move(elements, grid, x, force, [&](const Vec3& r) { return Vec3(r + slope * r); });
  const Mat3 first = elements.stress(0, 0);
  EXPECT_GT(first.norm(), 0.05);
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    for (int q = 0; q < elements.points_per_cell(); ++q) EXPECT_LT((elements.stress(c, q) - first).norm(), 1e-12);
}

TEST(ShellElements, BendingPatch) {
  // Uniform bending of a rectangular sheet of any cells: w = -(kx x^2 + ky y^2 + 2 kxy x y)/2 with plane stress. Moments
  // are those of Kirchhoff's plate to the thickness squared; one layer of hexahedra would be far too stiff.
  for (double poisson : {0.0, 0.3, 0.499}) {
    const double t = 0.05, kx = 1e-7, ky = 0.3e-7;  // slopes so small that they stretch nothing
    Grid grid = sheet(2, {4, 4}, t);
    auto elements = shells(grid, elastic(1.0, 1.0, poisson), 2);
    Nodes x = grid.nodes, force(x.size());
    // Thickness strain is left to the element.
    move(elements, grid, x, force, [&](Vec3 r) {
      const double z = r[2] - 0.5 * t;
      return Vec3(r[0] + kx * r[0] * z, r[1] + ky * r[1] * z, r[2] - 0.5 * (kx * r[0] * r[0] + ky * r[1] * r[1]));
    });
    double moment = 0.0, through = 0.0;
    const double exact = (kx + poisson * ky) / (1.0 - poisson * poisson) * t * t * t / 12.0;
    const double gauss[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640};
    for (int q = 0; q < 20; ++q) {
      const Mat3 s = elements.stress(5, q);
      moment += elements.mean_share(q) * t * s(0, 0) * 0.5 * t * gauss[q / 4];
      through = std::max(through, std::abs(s(2, 2)));
    }
    RecordProperty("moment_error_nu_" + std::to_string(poisson), std::to_string(moment / exact - 1.0));
    EXPECT_NEAR(moment / exact, 1.0, 2e-4) << poisson;
    // Thickness stress: that of the slopes' squares alone, which stretch the sheet at constant thickness.
    EXPECT_LT(through, 1e-6 * 0.5 * t * kx + (materials::bulk_modulus(elastic(1, 1, poisson)) + 1.0) * std::pow(4.0 * kx, 2));
  }
}

TEST(ShellElements, RigidMotionMakesNoStress) {
  Grid grid = sheet(1, {2, 2}, 0.3);
  distort(grid, 0.05);
  ShellElements elements(grid, elastic(1.0, 1.0, 0.3), 0.06, 1.2, 1, 5);
  Nodes x = grid.nodes, force(x.size());
  const int steps = 400;
  for (int step = 1; step <= steps; ++step)
    move(elements, grid, x, force, [&](const Vec3& r) {
      return Vec3(rotation(6.0 * std::numbers::pi * step / steps) * r + Vec3(100, 50, -30) * step / steps);
    });
  double most = 0.0;
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    for (int q = 0; q < 20; ++q) most = std::max(most, elements.stress(c, q).norm());
  RecordProperty("stress_over_E", std::to_string(1e12 * most) + "e-12");
  EXPECT_LT(most, 1e-11);
  EXPECT_LT(largest(force), 1e-11);
}

TEST(ShellElements, StressTurnsWithTheBody) {
  Grid grid = sheet(2, {2, 2}, 0.2);
  distort(grid, 0.03);
  auto elements = shells(grid, elastic(1.0, 1.0, 0.3), 2);
  Nodes x = grid.nodes, force(x.size());
  const auto strained = [](const Vec3& r) {
    return Vec3(r[0] + 0.02 * r[1] + 0.01 * r[0] * r[2], r[1] * 1.01, r[2] - 0.01 * r[0] * r[0]);
  };
  move(elements, grid, x, force, strained);
  const Nodes before = force;
  const double energy = elements.elastic_energy();
  const Mat3 stress = elements.stress(3, 18);
  const int steps = 50;
  for (int step = 1; step <= steps; ++step)
    move(elements, grid, x, force, [&](const Vec3& r) { return Vec3(rotation(2.0 * step / steps) * strained(r)); });
  const Mat3 turn = rotation(2.0);
  // The enhanced strain relaxes what the one large first step left of its residual; then nothing changes.
  EXPECT_LT((elements.stress(3, 18) - turn * stress * turn.transpose()).norm(), 1e-3 * stress.norm());
  const double settled = elements.elastic_energy();
  const Nodes now = force;
  for (int step = 1; step <= steps; ++step)
    move(elements, grid, x, force, [&](const Vec3& r) { return Vec3(rotation(2.0 + 2.0 * step / steps) * strained(r)); });
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_LT((force[i] - turn * now[i]).norm(), 1e-11 * largest(force));
  EXPECT_NEAR(elements.elastic_energy(), settled, 1e-11 * energy);
}

TEST(ShellElements, ForceIsTheDerivativeOfTheWork) {
  Grid grid = sheet(2, {2, 2}, 0.2);
  distort(grid, 0.03);
  auto elements = shells(grid, elastic(1.0, 1.0, 0.3), 2, 3);
  Nodes x = grid.nodes, force(x.size(), Vec3::Zero());
  double work = 0.0;
  const int steps = 200;
  const auto shape = [](const Vec3& r) { return Vec3(0.3 * r[1] * r[2], std::sin(r[0]), 0.2 * r[0] * r[0] - r[1]); };
  for (int step = 1; step <= steps; ++step) {
    const Nodes old_force = force, old_x = x;
    move(elements, grid, x, force, [&](const Vec3& r) { return Vec3(r + 0.05 * step / steps * shape(r)); });
    for (std::size_t i = 0; i < x.size(); ++i) work += 0.5 * (old_force[i] + force[i]).dot(x[i] - old_x[i]);
  }
  RecordProperty("energy_over_work", std::to_string(1e6 * (elements.elastic_energy() / work - 1.0)) + "e-6");
  EXPECT_NEAR(elements.elastic_energy(), work, 1e-5 * work);
  for (int step = steps - 1; step >= 0; --step)
    move(elements, grid, x, force, [&](const Vec3& r) { return Vec3(r + 0.05 * step / steps * shape(r)); });
  EXPECT_LT(std::abs(elements.elastic_energy()), 1e-5 * work);
}

TEST(ShellElements, OneCellHasSixZeroModes) {
  for (int layers : {2, 3, 5}) {
    Grid grid = sheet(0, {1, 1}, 0.3);
    distort(grid, 0.05);
    const Matrices m(shells(grid, elastic(1.0, 1.0, 0.3), 0, layers), grid);
    EXPECT_LT((m.stiffness - m.stiffness.transpose()).norm(), 1e-14 * m.stiffness.norm());
    const Eigen::VectorXd values = eigenvalues(m.stiffness);
    EXPECT_LT(std::abs(values[5]), 1e-13 * values[23]);
    EXPECT_GT(values[0], -1e-13 * values[23]);
    EXPECT_GT(values[6], 1e-4 * values[23]) << "a mechanism";
  }
}

TEST(ShellElements, NearlyIncompressibleCellHasOneStiffMode) {
  Grid grid = sheet(2, {1, 1}, 0.5);
  distort(grid, 0.02);
  const Matrices m(shells(grid, elastic(1.0, 1.0, 0.49999), 2), grid);
  const Eigen::VectorXd values = eigenvalues(m.stiffness);
  RecordProperty("second", std::to_string(values[22]));
  EXPECT_LT(values[22], 3.0);
  EXPECT_GT(values[23], 1e3);
}

TEST(ShellElements, LinearForceIsTheTangent) {
  Grid grid = sheet(2, {2, 2}, 0.2);
  distort(grid, 0.03);
  auto elements = shells(grid, elastic(1.0, 1.0, 0.3), 2);
  Nodes u(grid.nodes.size()), x = grid.nodes, force(u.size()), linear(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    u[i] = 1e-7 * Vec3(std::sin(i), std::cos(2.0 * i), std::sin(3.0 * i + 1));
    x[i] += u[i];
  }
  elements.linear_force(grid.nodes, u, linear);
  ASSERT_EQ(elements.advance(x, u, 1.0, force), -1);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_LT((force[i] - linear[i]).norm(), 1e-5 * largest(linear));
}

TEST(ShellElements, StableStepIsSafe) {
  for (double poisson : {0.0, 0.3, 0.45}) {
    Grid one = sheet(2, {1, 1}, 0.3), many = sheet(2, {3, 3}, 0.3);
    distort(one, 0.05);
    distort(many, 0.05);
    const auto single = shells(one, elastic(1.0, 1.0, poisson), 2), assembly = shells(many, elastic(1.0, 1.0, poisson), 2);
    EXPECT_NEAR(single.critical_step() * Matrices(single, one).highest_frequency(), 2.0, 2e-3);
    const double share = assembly.critical_step() * Matrices(assembly, many).highest_frequency() / 2.0;
    RecordProperty("share_of_true_limit_" + std::to_string(poisson), std::to_string(share));
    EXPECT_LE(share, 1.0);
    EXPECT_GT(share, 0.6);
  }
}

/// A free sheet that is hit so hard that it yields.
Settings free_sheet() {
  Settings settings = plate(Vec3(0.01, 0.02, -0.03), Vec3(0.05, 0.06, -0.028), {5, 5, 1}, hardening(2700, 71e9, 0.33, 50e6, 1e9));
  settings.element = ElementKind::shell;
  settings.wet_faces = {"z_low"};
  settings.initial_velocity = Vec3(3, -20, 10);
  return settings;
}

std::vector<Vec3> kicks(std::size_t count, double size) {
  std::vector<Vec3> impulse(count);
  for (std::size_t i = 0; i < count; ++i)
    impulse[i] = size * Vec3(std::sin(1.0 + 3.0 * i), std::cos(2.0 * i), std::sin(5.0 * i) + 0.5);
  return impulse;
}

TEST(ShellElements, FreeSheetKeepsBothMomentaAndEnergy) {
  for (bool viscous : {false, true}) {
    Settings settings = free_sheet();
    if (!viscous) settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
    Structure body(settings);
    const double start = body.ledger().balance();
    double time = 0.0;
    for (int window = 1; window <= 20; ++window) body.advance(time += 0.4e-6, kicks(body.wet_surface().nodes.size(), 3e-4));
    const Vec3 linear = body.ledger().momentum, angular = body.ledger().angular_momentum;
    while (body.steps() < 600) body.advance(body.time() + body.stable_step(), {});
    const BodyLedger energies = body.ledger();
    RecordProperty(viscous ? "balance_viscous" : "balance", std::to_string((energies.balance() - start) / energies.received));
    EXPECT_GT(energies.plastic, 0.05 * energies.received);
    EXPECT_EQ(energies.viscous > 0.0, viscous);
    EXPECT_LT((body.ledger().momentum - linear).norm(), 1e-12 * linear.norm());
    EXPECT_LT((body.ledger().angular_momentum - angular).norm(), 1e-12 * angular.norm());
    EXPECT_NEAR(energies.balance(), start, 2e-4 * energies.received);
  }
}

TEST(ShellElements, PointValuesAreInterpolated) {
  // Shares sum to one, stay within [0, 1] and give back a linear field between the outermost points.
  for (int through = 0; through < 3; ++through) {
    const Grid grid = sheet(through, {1, 1}, 0.5);
    const auto elements = shells(grid, elastic(1.0, 1.0, 0.3), through, 5);
    const double gauss[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640};
    for (double a : {0.0, 0.3, 0.6, 1.0})
      for (double b : {0.25, 0.5, 0.75})
        for (double c : {0.0, 0.06, 0.2, 0.5, 0.8, 0.94}) {
          std::array<double, 3> unit;
          unit[through] = c;
          unit[(through + 1) % 3] = a;
          unit[(through + 2) % 3] = b;
          const auto shares = elements.shares_at(unit);
          ASSERT_EQ(shares.size(), 20u);
          double total = 0.0, height = 0.0, across = 0.0;
          for (int q = 0; q < 20; ++q) {
            EXPECT_GE(shares[q], 0.0);
            total += shares[q];
            height += shares[q] * gauss[q / 4];
            across += shares[q] * (q & 2 ? 1.0 : -1.0) / std::numbers::sqrt3;
          }
          EXPECT_NEAR(total, 1.0, 1e-14);
          EXPECT_NEAR(height, std::max(2.0 * c - 1.0, gauss[0]), 1e-14);
          EXPECT_NEAR(across, 2.0 * b - 1.0, 1e-14);
        }
    double whole = 0.0;
    for (int q = 0; q < 20; ++q) whole += elements.mean_share(q);
    EXPECT_NEAR(whole, 1.0, 1e-14);
  }
}

TEST(ShellElements, RodsAreRefused) {
  Settings settings;
  settings.mesh =
      RodMesh{.axis = 2, .center = Vec3::Zero(), .radius = 0.1, .low = 0.0, .high = 1.0, .cells_radial = 4, .cells_along = 8};
  settings.material = elastic(1, 1, 0.3);
  settings.element = ElementKind::shell;
  try {
    Structure rod(settings);
    FAIL();
  } catch (const std::invalid_argument& mistake) {
    EXPECT_NE(std::string(mistake.what()).find("thickness direction"), std::string::npos) << mistake.what();
  }
}

}  // namespace
}  // namespace undex::fem::testing
