// Faces through which waves leave: against the same water in a longer basin, at rest, and their meshes.
#include <Eigen/Geometry>

#include "core/surface.hpp"
#include "scenes.hpp"
#include "sph_fluid/walls/radiating_mesh.hpp"

namespace undex::sph {
namespace {

using testing::body, testing::box, testing::box_wall, testing::total;

constexpr double dx = 1e-3, rest = 1e5;

double sound(const Body& water) {
  return std::visit([&](const auto& law) { return law.evaluate(start_density(water), 0.0).sound_speed; }, water.material.law);
}

/// A strip of water, four spacings wide, with an exponential wave of 40 spacings that runs along x from 30 spacings on.
Settings strip(double peak, int length, FaceCondition end, SchemeName scheme) {
  Settings settings;
  settings.dimension = 2;
  settings.numerics.scheme = scheme;
  settings.numerics.threads = 1;
  settings.lattice.spacing = dx;
  const Vec3 low(0, 0, 0), high(length * dx, 4 * dx, 1);
  Body water = body("water", box(low, high), "water-tait");
  water.pressure = rest;
  const double rho0 = start_density(water), z0 = rho0 * sound(water);
  const auto start = std::make_shared<StartField>();
  start->state = [=, law = water.material.law](const Vec3& x, double) {
    const double behind = (30 * dx - x[0]) / (40 * dx), over = behind > 0 ? peak * std::exp(-behind) : 0.0;
    const double rho = over > 0 ? materials::density_at(law, rest + over, 0.0) : rho0;
    const double z = rho * std::visit([&](const auto& each) { return each.evaluate(rho, 0.0).sound_speed; }, law);
    return StartState{.density = rho, .energy = 0.0, .velocity = 2.0 * over / (z + z0) * Vec3::UnitX()};
  };
  water.start = start;
  settings.bodies = {water};
  settings.walls = {box_wall(low, high)};
  settings.walls[0].faces["x_high"] = end;
  return settings;
}

/// Particles settle before a face at rest, whatever wave stands at it, and the run begins with the face at its first places.
TEST(Radiating, FacesRestWhileParticlesSettle) {
  const Settings settings = strip(1e7, 24, FaceCondition::radiating, SchemeName::riemann);
  Fluid as_laid(settings), settled(settings);
  settled.settle();
  EXPECT_EQ(testing::by_id(settled, "position"), testing::by_id(as_laid, "position"));
  for (int k = 0; k < 5; ++k)
    for (Fluid* fluid : {&as_laid, &settled}) fluid->step(1e-7);
  EXPECT_EQ(testing::by_id(settled, "velocity"), testing::by_id(as_laid, "velocity"));
  EXPECT_EQ(settled.ledger().radiated, as_laid.ledger().radiated);
}

/// A plane wave that meets the face at right angles leaves: what comes back is less than 1 % of its peak at any strength.
TEST(Radiating, PlaneWaveLeaves) {
  for (const double peak : {1e5, 1e7, 1e8}) {
    Fluid here(strip(peak, 80, FaceCondition::radiating, SchemeName::riemann));
    Fluid longer(strip(peak, 130, FaceCondition::free_slip, SchemeName::riemann));
    const Ledger start = here.ledger();
    const Vec3 probe(70 * dx, 2 * dx, 0);
    double difference = 0;
    for (const double end = 95 * dx / 1500; here.time() < end;) {
      const double step = std::min(here.step_limit().step, longer.step_limit().step);
      here.step(step);
      longer.step(step);
      difference = std::max(difference, std::abs(here.at(probe).pressure - longer.at(probe).pressure));
    }
    EXPECT_LT(difference, 1e-2 * peak) << peak;
    const Ledger end = here.ledger();
    EXPECT_GT(end.radiated, 0.5 * start.kinetic);
    EXPECT_NEAR((total(end) + end.radiated - total(start)) / start.kinetic, 0.0, 0.02) << peak;
    EXPECT_EQ(end.wall_work, 0.0);
  }
}

/// Pressures push at the strip's other end and at its sides; where all faces radiate momentum is booked to round-off.
TEST(Radiating, MomentumLeavesThroughTheFaces) {
  for (const SchemeName scheme : {SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan}) {
    Settings settings = strip(1e7, 40, FaceCondition::radiating, scheme);
    settings.numerics.signal = 0;  // no one is left out, which would cost momentum of that share
    for (auto& [face, condition] : settings.walls[0].faces) condition = FaceCondition::radiating;
    Fluid fluid(settings);
    const Ledger start = fluid.ledger();
    for (int k = 0; k < 60; ++k) fluid.step(fluid.step_limit().step);
    const Ledger end = fluid.ledger();
    EXPECT_LT((end.momentum + end.radiated_momentum - start.momentum).norm(), 1e-11 * start.momentum.norm());
    EXPECT_LT(end.kinetic, 0.9 * start.kinetic);
  }
}

/// Under pressure, with its edges and corners, and under gravity: nothing behind the faces is other than before them.
TEST(Radiating, RestStaysRest) {
  Settings cube;
  cube.lattice.spacing = 0.1;
  cube.numerics.threads = 1;
  cube.bodies = {body("water", box(Vec3::Zero(), Vec3::Ones()), "water-tait")};
  cube.bodies[0].pressure = 1e7;
  cube.walls = {box_wall(Vec3::Zero(), Vec3::Ones(), FaceCondition::radiating)};
  Fluid under_pressure(cube);
  for (int k = 0; k < 10; ++k) under_pressure.step(under_pressure.step_limit().step);
  EXPECT_LT(under_pressure.maximum_speed(), 1e-9);

  Settings column;
  column.dimension = 2;
  column.lattice.spacing = 0.1;
  column.numerics.threads = 1;
  column.gravity = Vec3(0, -9.81, 0);
  const Vec3 low(0, 0, 0), high(1, 2, 1);
  column.bodies = {body("water", box(low, high), "water-tait")};
  column.bodies[0].pressure = rest;
  column.bodies[0].level = Vec3(0, 2, 0);
  column.walls = {box_wall(low, high, FaceCondition::radiating)};
  Fluid under_gravity(column);
  while (under_gravity.time() < 2e-3) under_gravity.step(under_gravity.step_limit().step);
  EXPECT_LT(under_gravity.maximum_speed(), 1e-3);  // falling, it would have 2e-2 m/s
}

double area(const RadiatingMesh& mesh) {
  double sum = 0;
  for (const auto& face : mesh.wall.faces) {
    const auto x = corners_of(face, mesh.wall.position);
    const Vec3 of_face = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]);
    sum += of_face.norm();
    Vec3 outward = Vec3::Zero();
    for (const int n : face) outward += mesh.normal[n];
    EXPECT_GT(of_face.dot(outward), 0.0) << mesh.name;
  }
  return sum;
}

/// Areas of boxes, cylinders and spheres, whole and between symmetry planes; edges have their nodes in common.
TEST(Radiating, MeshesCoverTheFaces) {
  const double pi = 3.14159265358979;
  for (const bool octant : {false, true}) {
    Settings settings;
    settings.lattice.spacing = 0.05;
    settings.symmetry.axis = {octant, octant, octant};
    const double share = octant ? 1.0 / 8.0 : 1.0;
    const auto sum = [&](const Primitive& shape, std::vector<std::string> faces) {
      Wall wall;
      wall.name = "wall";
      wall.container = shape;
      for (const std::string& face : faces) wall.faces[face] = FaceCondition::radiating;
      settings.walls = {wall};
      const RadiatingMeshes meshes = radiating_meshes(settings);
      if (faces.size() > 1) {
        EXPECT_FALSE(meshes.shared.empty());
      }
      double all = 0;
      for (const RadiatingMesh& mesh : meshes.faces) all += area(mesh);
      return all;
    };
    EXPECT_NEAR(sum(Box{-Vec3::Ones(), Vec3::Ones()}, {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"}), 24 * share,
                1e-9);
    EXPECT_NEAR(sum(Cylinder{2, Vec3::Zero(), 1.0, -1.0, 1.0}, {"side", "low", "high"}), 6 * pi * share, 0.03 * share);
    EXPECT_NEAR(sum(Sphere{Vec3::Zero(), 1.0}, {"side"}), 4 * pi * share, 0.03 * share);
  }
}

}  // namespace
}  // namespace undex::sph
