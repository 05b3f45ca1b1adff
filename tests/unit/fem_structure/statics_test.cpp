// Linear statics of thin shells against published numbers: what one layer of solid shells gives, and where hexahedra lock.
#include <Eigen/Sparse>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>
#include <memory>
#include <numbers>

#include "bodies.hpp"
#include "fem_structure/shell_elements.hpp"

namespace undex::fem::testing {
namespace {

std::unique_ptr<ElementSet> make(ElementKind kind, const Grid& grid, const materials::Solid& material) {
  if (kind == ElementKind::hexahedron) return std::make_unique<Elements>(grid, material, 0.0, 0.0);
  return std::make_unique<ShellElements>(grid, material, 0.0, 0.0, 2, 3);
}

struct Plate {
  Grid grid;
  materials::Solid material;
  std::function<std::array<bool, 3>(const Vec3& unit)> fixed;  ///< of a node, by its place in the unit sheet
  std::function<Vec3(const Vec3& unit, double volume)> load;   ///< on a node, by its place and its share of the volume
};

/// Displacements under the load: stiffness from unit displacements of single cells, sparse factorisation. (Conjugate
/// gradients need tens of thousands of steps here: a thin shell's condition grows with (length/thickness)^2.)
std::vector<Vec3> solve(const Plate& problem, const std::vector<Vec3>& unit, ElementKind kind) {
  const std::size_t n = problem.grid.nodes.size();
  std::vector<int> number(3 * n, -1);
  int free = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto fixed = problem.fixed(unit[i]);
    for (int d = 0; d < 3; ++d)
      if (!fixed[d]) number[3 * i + d] = free++;
  }
  std::vector<double> volume(n, 0.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < problem.grid.cells.size(); ++c) {
    Grid one;
    one.reference = problem.grid.reference;
    one.cells = {{0, 1, 2, 3, 4, 5, 6, 7}};
    one.nodal_volume = {problem.grid.nodal_volume[c]};
    const auto& cell = problem.grid.cells[c];
    for (int node = 0; node < 8; ++node) {
      one.nodes.push_back(problem.grid.nodes[cell[node]]);
      volume[cell[node]] += problem.grid.nodal_volume[c][node];
    }
    const auto element = make(kind, one, problem.material);
    std::vector<Vec3> u(8), f(8);
    for (int k = 0; k < 24; ++k) {
      for (Vec3& v : u) v.setZero();
      u[k / 3][k % 3] = 1.0;
      element->linear_force(one.nodes, u, f);
      const int column = number[3 * cell[k / 3] + k % 3];
      for (int l = 0; l < 24 && column >= 0; ++l)
        if (const int row = number[3 * cell[l / 3] + l % 3]; row >= 0) entries.emplace_back(row, column, f[l / 3][l % 3]);
    }
  }
  Eigen::SparseMatrix<double> stiffness(free, free);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(free);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 force = problem.load(unit[i], volume[i]);
    for (int d = 0; d < 3; ++d)
      if (number[3 * i + d] >= 0) right[number[3 * i + d]] = force[d];
  }
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(stiffness);
  EXPECT_EQ(factors.info(), Eigen::Success);
  Eigen::VectorXd solution = factors.solve(right);
  solution += factors.solve(right - stiffness * solution);
  std::vector<Vec3> displacement(n, Vec3::Zero());
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < 3; ++d)
      if (number[3 * i + d] >= 0) displacement[i][d] = solution[number[3 * i + d]];
  return displacement;
}

/// The unit sheet [0,1]^2 x [0,1] of n0 x n1 x 1 cells, mapped.
Plate mapped(std::array<int, 2> n, const std::function<Vec3(const Vec3&)>& map, std::vector<Vec3>& unit) {
  Plate problem;
  problem.grid = Mesher(plate(Vec3(0, 0, 0), Vec3(1, 1, 1), {n[0], n[1], 1}, elastic(1, 1, 0.3))).grid();
  unit = problem.grid.nodes;
  remap(problem.grid, map);
  return problem;
}

Vec3 mean_at(const std::vector<Vec3>& displacement, const std::vector<Vec3>& unit, double a, double b) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < unit.size(); ++i)
    if (std::abs(unit[i][0] - a) < 1e-9 && std::abs(unit[i][1] - b) < 1e-9) sum += 0.5 * displacement[i];
  return sum;
}

/// Radial displacement under the load of the pinched cylinder with end diaphragms, over 1.8248e-5.
double pinched_cylinder(ElementKind kind, int n) {
  const double radius = 300, half_length = 300, t = 3;
  std::vector<Vec3> unit;
  Plate problem = mapped(
      {n, n},
      [&](const Vec3& s) {
        const double angle = 0.5 * std::numbers::pi * s[0], r = radius + t * (s[2] - 0.5);
        return Vec3(r * std::sin(angle), half_length * s[1], r * std::cos(angle));
      },
      unit);
  problem.material = elastic(1.0, 3e6, 0.3);
  problem.fixed = [](const Vec3& s) {  // load at angle 0, y = 0 (mid-length); diaphragm at y = half_length
    const bool diaphragm = s[1] == 1.0;
    return std::array<bool, 3>{diaphragm || s[0] == 0.0, s[1] == 0.0, diaphragm || s[0] == 1.0};
  };
  problem.load = [](const Vec3& s, double) {  // a quarter of the load, on both faces
    return s[0] == 0.0 && s[1] == 0.0 ? Vec3(0, 0, -0.125) : Vec3(0, 0, 0);
  };
  return -mean_at(solve(problem, unit, kind), unit, 0.0, 0.0)[2] / 1.8248e-5;
}

/// Vertical displacement of the mid-side of the free edge of the Scordelis-Lo roof, over 0.3024.
double scordelis_lo(ElementKind kind, int n) {
  const double radius = 25, half_length = 25, t = 0.25, opening = 40.0 / 180.0 * std::numbers::pi;
  std::vector<Vec3> unit;
  Plate problem = mapped(
      {n, n},
      [&](const Vec3& s) {
        const double angle = opening * s[0], r = radius + t * (s[2] - 0.5);
        return Vec3(r * std::sin(angle), half_length * s[1], r * std::cos(angle));
      },
      unit);
  problem.material = elastic(1.0, 4.32e8, 0.0);
  problem.fixed = [](const Vec3& s) {
    const bool diaphragm = s[1] == 1.0;
    return std::array<bool, 3>{diaphragm || s[0] == 0.0, s[1] == 0.0, diaphragm};
  };
  problem.load = [&](const Vec3&, double volume) { return Vec3(0, 0, -90.0 / t * volume); };
  return -mean_at(solve(problem, unit, kind), unit, 1.0, 0.0)[2] / 0.3024;
}

/// Deflection of the middle of a clamped square plate under uniform load, over 0.00126532 q a^4/D (Timoshenko and
/// Woinowsky-Krieger); a quarter of it. `skew` distorts the cells.
double clamped_plate(ElementKind kind, int n, double slenderness, double poisson, double skew = 0.0) {
  const double a = 1.0, t = a / slenderness, young = 1e7;
  std::vector<Vec3> unit;
  Plate problem = mapped(
      {n, n},
      [&](const Vec3& s) {
        const double bump = skew * std::sin(std::numbers::pi * s[0]) * std::sin(std::numbers::pi * s[1]);
        return Vec3(0.5 * a * (s[0] + bump), 0.5 * a * (s[1] - bump), t * s[2]);
      },
      unit);
  problem.material = elastic(1.0, young, poisson);
  problem.fixed = [](const Vec3& s) {  // centre at (0, 0), clamped at s = 1
    const bool clamped = s[0] == 1.0 || s[1] == 1.0;
    return std::array<bool, 3>{clamped || s[0] == 0.0, clamped || s[1] == 0.0, clamped};
  };
  problem.load = [&](const Vec3&, double volume) { return Vec3(0, 0, volume / t); };
  const double rigidity = young * t * t * t / (12.0 * (1.0 - poisson * poisson));
  return mean_at(solve(problem, unit, kind), unit, 0.0, 0.0)[2] / (0.00126532 * std::pow(a, 4) / rigidity);
}

/// Deflection of the end of a cantilever strip under a load at its end, held to bend as a plate does (no strain across),
/// over F l^3/(3 D).
double cantilever(ElementKind kind, int n, double slenderness, double poisson) {
  const double length = 1.0, t = length / slenderness, young = 1e7;
  std::vector<Vec3> unit;
  Plate problem = mapped(
      {n, 1}, [&](const Vec3& s) { return Vec3(length * s[0], length / n * s[1], t * s[2]); }, unit);
  problem.material = elastic(1.0, young, poisson);
  problem.fixed = [](const Vec3& s) {
    const bool clamped = s[0] == 0.0;
    return std::array<bool, 3>{clamped, true, clamped && s[2] == 0.0};
  };
  problem.load = [&](const Vec3& s, double) { return Vec3(0, 0, s[0] == 1.0 ? 0.25 * length / n : 0.0); };
  const double rigidity = young * t * t * t / (12.0 * (1.0 - poisson * poisson));
  return mean_at(solve(problem, unit, kind), unit, 1.0, 0.0)[2] / (1.0 / (3.0 * rigidity));
}

using Case = std::function<double(ElementKind, int)>;

/// Values for 8, 16, 32 cells a side, printed with the order of the differences.
std::array<double, 3> series(const char* name, ElementKind kind, const Case& one) {
  std::array<double, 3> values;
  for (int k = 0; k < 3; ++k) {
    values[k] = one(kind, 8 << k);
    ::testing::Test::RecordProperty(
        std::string(name) + (kind == ElementKind::shell ? "_shell_" : "_hexahedron_") + std::to_string(8 << k),
        std::to_string(values[k]));
  }
  std::printf("%-28s %-10s 8x8: %.5f  16x16: %.5f  32x32: %.5f  order %.2f\n", name,
              kind == ElementKind::shell ? "shell" : "hexahedron", values[0], values[1], values[2],
              std::log2(std::abs((values[1] - values[0]) / (values[2] - values[1]))));
  return values;
}

TEST(Statics, PinchedCylinder) {
  const auto shell = series("pinched_cylinder", ElementKind::shell, pinched_cylinder);
  EXPECT_NEAR(shell[2], 1.0, 0.02);
  EXPECT_NEAR(shell[1], 1.0, 0.08);
  EXPECT_LT(series("pinched_cylinder", ElementKind::hexahedron, pinched_cylinder)[2], 0.4) << "locks";
}

TEST(Statics, ScordelisLoRoof) {
  const auto shell = series("scordelis_lo", ElementKind::shell, scordelis_lo);
  EXPECT_NEAR(shell[2], 0.3006 / 0.3024, 0.01);
  EXPECT_NEAR(shell[0], 1.0, 0.05);
  EXPECT_LT(series("scordelis_lo", ElementKind::hexahedron, scordelis_lo)[2], 0.6) << "locks";
}

TEST(Statics, ClampedPlate) {
  for (double poisson : {0.3, 0.499}) {
    const Case slender = [&](ElementKind kind, int n) { return clamped_plate(kind, n, 1000.0, poisson); };
    const Case skewed = [&](ElementKind kind, int n) { return clamped_plate(kind, n, 1000.0, poisson, 0.15); };
    const std::string nu = "_nu_" + std::to_string(poisson).substr(0, 5);
    const auto shell = series(("clamped_plate" + nu).c_str(), ElementKind::shell, slender);
    EXPECT_NEAR(shell[2], 1.0, 0.005) << poisson;
    EXPECT_NEAR(shell[0], 1.0, 0.03) << poisson;
    EXPECT_NEAR(series(("skewed_plate" + nu).c_str(), ElementKind::shell, skewed)[2], 1.0, 0.005) << poisson;
    EXPECT_LT(series(("clamped_plate" + nu).c_str(), ElementKind::hexahedron, slender)[2], 0.05) << "locks";
  }
}

TEST(Statics, Cantilever) {
  // Nearly incompressible and a thousand times as long as thick, round-off of the stiffness alone is worth 3 %: a hundred
  // times there.
  for (const auto& [poisson, slenderness] : {std::pair{0.0, 1000.0}, {0.499, 100.0}}) {
    const Case slender = [&](ElementKind kind, int n) { return cantilever(kind, n, slenderness, poisson); };
    const std::string nu = "cantilever_nu_" + std::to_string(poisson).substr(0, 5);
    const auto shell = series(nu.c_str(), ElementKind::shell, slender);
    EXPECT_NEAR(shell[0], 1.0, 0.005) << poisson;
    EXPECT_NEAR(shell[2], 1.0, 0.001) << poisson;
    EXPECT_LT(series(nu.c_str(), ElementKind::hexahedron, slender)[2], 0.5) << "locks";
  }
}

}  // namespace
}  // namespace undex::fem::testing
