// The map between a structure's wet surface and the dummy particles that ride on it.
#include "coupling/wet_wall.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "surfaces.hpp"

namespace undex::coupling::testing {
namespace {

constexpr std::array<bool, 3> no_planes{false, false, false};

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
Vec3 total(const std::vector<Vec3>& values) { return std::accumulate(values.begin(), values.end(), Vec3(Vec3::Zero())); }

/// Numbers that repeat nowhere.
Vec3 scattered(int k) { return {std::sin(1.3 * k + 0.2), std::cos(2.1 * k), std::sin(0.7 * k + 1)}; }

TEST(WetWall, LayersReachAsDeepAsAsked) {
  const WetSurface surface = plate(1.0, 0.6, 4, 3);
  EXPECT_EQ(WetWall(surface, 0.1, 0.3, no_planes).layer_count(), 3u);
  EXPECT_EQ(WetWall(surface, 0.1, 0.1, no_planes).layer_count(), 3u) << "at least three";
  const WetWall deep(surface, 0.1, 0.42, no_planes);
  EXPECT_EQ(deep.layer_count(), 5u);
  const sph::LinedWall wall = deep.particles(true);
  double shallow = 1, deepest = 0;
  for (const Vec3& x : wall.position) {
    shallow = std::min(shallow, x[2]);
    deepest = std::max(deepest, x[2]);
  }
  EXPECT_NEAR(shallow, 0.05, 1e-14);
  EXPECT_NEAR(deepest, 0.45, 1e-14);
}

TEST(WetWall, VolumeOfAPlateIsExact) {
  for (const double skew : {0.0, 0.03}) {
    const WetWall map(plate(1.0, 0.6, 4, 3, skew), 0.07, 0.2, no_planes);
    EXPECT_NEAR(total(map.particles(true).volume), 1.0 * 0.6 * 3 * 0.07, 1e-13);
  }
}

/// Behind a cylinder the layers grow with the radius; only the faceting is missing.
TEST(WetWall, VolumeBehindACylinder) {
  const double R = 0.0445, spacing = 0.002, pi = std::numbers::pi;
  double error[2];
  for (const int fine : {0, 1}) {
    const int around = fine ? 96 : 48;
    const WetWall map(cylinder(R, 0, 0.1, around, 10, 2 * pi), spacing, 3 * spacing, no_planes);
    const double outer = R + 3 * spacing, exact = pi * (outer * outer - R * R) * 0.1;
    const double facets = around / pi * std::sin(pi / around);  // the chord's share of the arc
    error[fine] = 1 - total(map.particles(true).volume) / exact;
    EXPECT_NEAR(error[fine], 1 - facets, 1e-6);
  }
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.1);
}

TEST(WetWall, NormalsPointAwayFromTheFluid) {
  const WetWall map(cylinder(0.0445, 0, 0.1, 64, 10, 2 * std::numbers::pi), 0.002, 0.006, no_planes);
  const sph::LinedWall wall = map.particles(true);
  for (std::size_t k = 0; k < wall.position.size(); ++k) {
    const Vec3 radial = Vec3(wall.position[k][0], wall.position[k][1], 0).normalized();
    EXPECT_GT(wall.normal[k].dot(radial), 1 - 1e-3);
    EXPECT_NEAR(wall.normal[k].norm(), 1.0, 1e-14);
    EXPECT_GT(std::hypot(wall.position[k][0], wall.position[k][1]), 0.0445);
    EXPECT_EQ(wall.velocity[k], Vec3(Vec3::Zero()));
    EXPECT_EQ(wall.impulse[k], Vec3(Vec3::Zero()));
  }
  EXPECT_TRUE(map.particles(true).free_slip);
  EXPECT_FALSE(map.particles(false).free_slip);
}

// ---- Motion --------------------------------------------------------------------------------------------------------

/// A rigid motion of the nodes is a rigid motion of the particles: positions, normals, and the normal velocity.
TEST(WetWall, RigidMotionArrivesAsItself) {
  for (const bool round : {false, true}) {
    const WetSurface surface = round ? cylinder(0.5, -0.3, 0.4, 24, 5, 1.1) : plate(1.0, 0.6, 4, 3, 0.03);
    const WetWall map(surface, 0.05, 0.15, no_planes);
    const sph::LinedWall start = map.particles(true);
    const Mat3 turn = Eigen::AngleAxisd(0.83, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    const Vec3 shift(0.3, -1.2, 0.7), v0(11, -7, 3), spin(2, 5, -4);
    std::vector<Vec3> position, velocity;
    for (const Vec3& x : surface.nodes) {
      position.push_back(turn * x + shift);
      velocity.push_back(v0 + spin.cross(position.back()));
    }
    sph::LinedWall wall = start;
    map.move(position, velocity, wall);
    for (std::size_t k = 0; k < wall.position.size(); ++k) {
      EXPECT_LT((wall.position[k] - (turn * start.position[k] + shift)).norm(), 1e-13);
      EXPECT_LT((wall.normal[k] - turn * start.normal[k]).norm(), 1e-13);
      // On a flat surface the particle lies on the normal through its foot, so the spin's share there is tangential.
      const double rigid = (v0 + spin.cross(wall.position[k])).dot(wall.normal[k]);
      EXPECT_NEAR(wall.velocity[k].dot(wall.normal[k]), rigid, 1e-12) << (round ? "cylinder" : "plate");
    }
  }
}

TEST(WetWall, TranslationIsExact) {
  const WetSurface surface = cylinder(0.5, -0.3, 0.4, 24, 5, 2 * std::numbers::pi);
  const WetWall map(surface, 0.05, 0.15, no_planes);
  const Vec3 v(3, -4, 5);
  sph::LinedWall wall = map.particles(true);
  map.move(surface.nodes, std::vector<Vec3>(surface.nodes.size(), v), wall);
  for (const Vec3& u : wall.velocity) EXPECT_LT((u - v).norm(), 1e-14);
}

/// Nodes on a symmetry plane: the normal stays in it, so that the particles of a quarter are those of the whole.
TEST(WetWall, SymmetryPlanesKeepNormalsInPlane) {
  const double pi = std::numbers::pi;
  const WetWall whole(cylinder(0.0445, -0.1, 0.1, 64, 20, 2 * pi), 0.002, 0.006, no_planes);
  const WetWall octant(cylinder(0.0445, 0, 0.1, 16, 10, 0.5 * pi), 0.002, 0.006, {true, true, true});
  const sph::LinedWall part = octant.particles(true), all = whole.particles(true);
  ASSERT_EQ(8 * part.position.size(), all.position.size());
  EXPECT_NEAR(8 * total(part.volume), total(all.volume), 1e-12 * total(all.volume));
  for (std::size_t k = 0; k < part.position.size(); ++k) {
    double nearest = 1;
    std::size_t twin = 0;
    for (std::size_t q = 0; q < all.position.size(); ++q) {
      const double away = (all.position[q] - part.position[k]).norm();
      if (away < nearest) {
        nearest = away;
        twin = q;
      }
    }
    EXPECT_LT(nearest, 1e-14);
    EXPECT_LT((all.normal[twin] - part.normal[k]).norm(), 1e-12);
  }
  // Without the planes the normals at the cut lean over.
  const WetWall cut(cylinder(0.0445, 0, 0.1, 16, 10, 0.5 * pi), 0.002, 0.006, no_planes);
  double leaning = 0;
  const sph::LinedWall lean = cut.particles(true);
  for (std::size_t k = 0; k < part.position.size(); ++k) leaning = std::max(leaning, (lean.normal[k] - part.normal[k]).norm());
  EXPECT_GT(leaning, 0.01);
}

// ---- Force ---------------------------------------------------------------------------------------------------------

/// Sums arrive whole, and so does virtual work: sum of nodal impulse times nodal velocity is that of the particles.
TEST(WetWall, TransferIsConservative) {
  for (const bool round : {false, true}) {
    const WetSurface surface = round ? cylinder(0.5, -0.3, 0.4, 24, 5, 2 * std::numbers::pi) : plate(1.0, 0.6, 4, 3, 0.03);
    const WetWall map(surface, 0.03, 0.1, no_planes);
    sph::LinedWall wall = map.particles(true);
    std::vector<Vec3> velocity;
    for (std::size_t n = 0; n < surface.nodes.size(); ++n) velocity.push_back(30 * scattered(int(n)));
    map.move(surface.nodes, velocity, wall);
    double given = 0, given_size = 0, received = 0;
    for (std::size_t k = 0; k < wall.impulse.size(); ++k) {
      wall.impulse[k] = 5 * scattered(int(3 * k + 1));
      given += wall.impulse[k].dot(wall.velocity[k]);
      given_size += wall.impulse[k].norm() * wall.velocity[k].norm();
    }
    const Vec3 sum = total(wall.impulse);
    std::vector<Vec3> nodal(surface.nodes.size(), Vec3::Constant(0.0));
    map.collect_impulse(wall, nodal);
    for (std::size_t n = 0; n < nodal.size(); ++n) received += nodal[n].dot(velocity[n]);
    EXPECT_LT((total(nodal) - sum).norm(), 1e-14 * 5 * double(wall.impulse.size()));
    EXPECT_NEAR(received, given, 1e-14 * given_size);
    for (const Vec3& left : wall.impulse) EXPECT_EQ(left, Vec3(Vec3::Zero())) << "handed over twice";
    // What the nodes held before stays.
    const std::vector<Vec3> before = nodal;
    map.collect_impulse(wall, nodal);
    EXPECT_EQ(nodal, before);
  }
}

/// Patch test: uniform pressure on a flat wall gives the consistent nodal forces of bilinear faces, the integrals of the
/// shape functions, exactly on rectangles (the midpoint rule is exact for each), whatever the number of particles a face.
TEST(WetWall, UniformPressureGivesConsistentNodalForces) {
  const double p = 3e7, a = 1.0, b = 0.6;
  const int nx = 4, ny = 3;
  const WetSurface surface = plate(a, b, nx, ny);
  for (const double spacing : {0.3, 0.1, 0.023}) {
    const WetWall map(surface, spacing, 3 * spacing, no_planes);
    sph::LinedWall wall = map.particles(true);
    // Each column of layers carries the pressure on its share of the surface.
    for (std::size_t k = 0; k < wall.impulse.size(); ++k)
      wall.impulse[k] = p * wall.volume[k] / (double(map.layer_count()) * spacing) * wall.normal[k];
    std::vector<Vec3> nodal(surface.nodes.size(), Vec3::Zero());
    map.collect_impulse(wall, nodal);
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const double share = (i == 0 || i == nx ? 0.5 : 1.0) * (j == 0 || j == ny ? 0.5 : 1.0);
        const Vec3 wanted(0, 0, p * share * a / nx * b / ny);
        EXPECT_LT((nodal[j * (nx + 1) + i] - wanted).norm(), 1e-12 * p) << i << " " << j << " spacing " << spacing;
      }
  }
}

/// On a closed cylinder under uniform pressure nothing is left over, and each ring of nodes pushes outwards alike.
TEST(WetWall, UniformPressureInACylinder) {
  const int around = 32, along = 6;
  const WetSurface surface = cylinder(0.0445, -0.05, 0.05, around, along, 2 * std::numbers::pi);
  const WetWall map(surface, 0.003, 0.009, no_planes);
  sph::LinedWall wall = map.particles(true);
  for (std::size_t k = 0; k < wall.impulse.size(); ++k) wall.impulse[k] = 1e6 * wall.volume[k] * wall.normal[k];
  std::vector<Vec3> nodal(surface.nodes.size(), Vec3::Zero());
  map.collect_impulse(wall, nodal);
  EXPECT_LT(total(nodal).norm(), 1e-12 * nodal[around * 3].norm() * around);
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const int n = j * around + i;
      const Vec3 radial = Vec3(surface.nodes[n][0], surface.nodes[n][1], 0).normalized();
      EXPECT_NEAR(nodal[n].dot(radial), nodal[j * around].dot(Vec3(1, 0, 0)), 1e-12 * nodal[around * 3].norm());
      EXPECT_NEAR((nodal[n] - nodal[n].dot(radial) * radial).norm(), 0.0, 1e-12 * nodal[around * 3].norm());
    }
}

}  // namespace
}  // namespace undex::coupling::testing
