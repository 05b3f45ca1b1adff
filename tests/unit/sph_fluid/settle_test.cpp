// Settled starts: uniform pressure leaves the particles at rest, and what was at rest stays as it is.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes.hpp"
#include "sph_fluid/water/settle.hpp"

namespace undex::sph::testing {
namespace {

constexpr double pressure = 1e7, rest = 5e-3, settled = 3e-4;

/// Water under pressure in a box of 16 spacings an edge, shifted against its lattice by `off` spacings.
Settings box(int dimension, double off = 0.0) {
  Settings s;
  s.dimension = dimension;
  s.lattice.spacing = 0.0625;
  s.lattice.origin = off * s.lattice.spacing * Vec3(1, 0.4, 0.7);
  s.numerics.threads = 1;
  s.numerics.signal = 0;
  const Box inside{Vec3::Zero(), Vec3(1, dimension > 1 ? 1 : 0, dimension > 2 ? 0.5 : 0)};
  Body water = body("water", Shape{inside, {}}, "water-tait");
  water.pressure = pressure;
  s.bodies = {water};
  s.walls = {box_wall(inside.low, inside.high)};
  s.walls[0].name = "tank";
  return s;
}

/// The same on rings in a round tank of 11 spacings' radius.
Settings rings(int dimension) {
  Settings s = box(dimension);
  const Cylinder inside{.axis = 2, .radius = 0.6875, .low = 0, .high = 0.5};
  s.bodies[0].shape.base = inside;
  s.walls[0].container = inside;
  for (const char* face : {"side", "low", "high"}) s.walls[0].faces[face] = FaceCondition::free_slip;
  s.lattice.type = LatticeType::rings;
  s.lattice.fit = "tank";
  return s;
}

/// The largest |g| h of the particles that `counts` holds, from the speeds after a step so short that it moves nobody.
template <class Counts>
double unrest(Fluid& fluid, Counts counts) {
  constexpr double dt = 1e-12;
  fluid.step(dt);
  const std::vector<double> rho = fluid.field("density"), h = fluid.field("smoothing_length"), x = fluid.field("position"),
                            v = fluid.field("velocity");
  double most = 0;
  for (std::size_t i = 0; i < rho.size(); ++i)
    if (counts(Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2])))
      most = std::max(most, Vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]).norm() / dt * rho[i] * h[i] / (2.0 * pressure));
  return most;
}
double unrest(Fluid& fluid) {
  return unrest(fluid, [](const Vec3&) { return true; });
}

struct Scene {
  std::string name;
  Settings settings;
  double rest = testing::rest;
};
std::ostream& operator<<(std::ostream& out, const Scene& scene) { return out << scene.name; }

std::vector<Scene> uneasy_scenes() {
  std::vector<Scene> all{
      {"line_off_its_lattice", box(1, 0.3)}, {"square_off_its_lattice", box(2, 0.3)}, {"box_off_its_lattice", box(3, 0.3)}};
  for (const SchemeName scheme : {SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan, SchemeName::paper}) {
    Settings s = box(2);
    s.lattice.jitter = 0.3;
    s.numerics.scheme = scheme;
    // A Gaussian ends in a step, which nothing settles on.
    all.push_back({"jitter_scheme_" + std::to_string(int(scheme)), s, scheme == SchemeName::paper ? 5.0 * rest : rest});
  }
  Settings round = rings(2);
  round.lattice.type = LatticeType::cartesian;
  all.push_back({"steps_at_a_round_wall", round});
  Settings quarter = round;
  quarter.symmetry.axis = {true, true, false};
  all.push_back({"steps_at_a_quarter", quarter});
  Settings ring = box(2, 0.3);
  ring.axisymmetric = true;
  ring.symmetry.axis[0] = true;
  all.push_back({"about_an_axis", ring, settled});
  Settings vessel = ring;
  vessel.bodies[0].shape.base = vessel.walls[0].container = Sphere{.radius = 0.6};
  vessel.walls[0].faces = {{"surface", FaceCondition::free_slip}};
  all.push_back({"sphere_about_an_axis", vessel, 1e-3});  // of few spacings
  vessel.axisymmetric = false;
  vessel.dimension = 3;
  vessel.symmetry.axis = {true, true, true};
  vessel.numerics.precision = Precision::full;
  all.push_back({"octant_of_a_sphere", vessel, 1.2 * descended_residual});
  return all;
}

class Settling : public ::testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Settling, ::testing::ValuesIn(uneasy_scenes()), [](const auto& one) { return one.param.name; });

TEST_P(Settling, LeavesAllAtRest) {
  Fluid as_laid(GetParam().settings), fluid(GetParam().settings);
  const Ledger before = fluid.ledger();
  fluid.settle();
  EXPECT_GT(unrest(as_laid), 8.0 * rest) << "nothing to settle";
  EXPECT_LT(unrest(fluid), GetParam().rest);
  const Ledger after = fluid.ledger();
  EXPECT_EQ(fluid.particle_count(), as_laid.particle_count());
  EXPECT_NEAR(after.mass / before.mass, 1.0, 1e-13);
  EXPECT_NEAR(after.internal / before.internal, 1.0, 1e-13);
  for (const double p : fluid.field("pressure")) EXPECT_NEAR(p / pressure, 1.0, 1e-9);
}

/// Forces of corrected gradients have no potential: a descent would wander.
TEST(Settle, TheCorrectedSchemeSettlesWithPlainGradients) {
  for (const int dimension : {2, 3}) {
    Settings plain = rings(dimension), corrected = plain;
    corrected.numerics.scheme = SchemeName::riemann_corrected;
    Fluid one(plain), other(corrected);
    one.settle();
    other.settle();
    EXPECT_EQ(by_id(one, "position"), by_id(other, "position"));
  }
}

TEST(Settled, LatticesStayAsTheyAre) {
  for (const int dimension : {1, 2, 3}) {
    Fluid as_laid(box(dimension)), fluid(box(dimension));
    fluid.settle();
    EXPECT_EQ(by_id(fluid, "position"), by_id(as_laid, "position")) << dimension;
    as_laid.step(1e-5);
    fluid.step(1e-5);
    EXPECT_EQ(by_id(fluid, "velocity"), by_id(as_laid, "velocity")) << dimension;
  }
}

TEST(Settled, RingsAreLaidAtRest) {
  for (const int dimension : {2, 3})
    for (const bool quarter : {false, true}) {
      Settings s = rings(dimension);
      s.symmetry.axis = {quarter, quarter, false};
      Fluid settled(s);
      EXPECT_LT(unrest(settled), 3e-4) << dimension << quarter;
      s.lattice.settle = false;
      Fluid circles(s);
      EXPECT_GT(unrest(circles), 0.05) << dimension << quarter;
    }
}

TEST(Settled, JitterKeepsItsPressure) {
  Settings s = box(2);
  s.lattice.jitter = 0.25;
  Fluid fluid(s);
  fluid.settle();
  while (fluid.time() < 2e-3) fluid.step(fluid.step_limit().step);  // sound crosses the box three times
  const std::vector<double> p = fluid.field("pressure");
  double mean = 0;
  for (const double one : p) mean += one / double(p.size());
  EXPECT_NEAR(mean / pressure, 1.0, 2e-3);
}

// What a free surface lets go is not held by its neighbours' places.
TEST(Settled, FreeSurfacesAreLeftAlone) {
  Settings s = box(2, 0.3);
  s.walls[0].faces["x_high"] = FaceCondition::open;
  const double spacing = s.lattice.spacing;
  Fluid as_laid(s), fluid(s);
  fluid.settle();
  const std::vector<Vec3> before = by_id(as_laid, "position"), after = by_id(fluid, "position");
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i][0] > 1.0 - 3.0 * spacing) {
      EXPECT_EQ(after[i], before[i]);
    }
  const auto inside = [&](const Vec3& x) { return x[0] < 1.0 - 8.0 * spacing; };
  EXPECT_GT(unrest(as_laid, inside), rest);
  EXPECT_LT(unrest(fluid, inside), rest);
}

// A wall that somebody else moves counts from the moment when it is there.
TEST(Settled, WallsOfStructuresCount) {
  Settings s = box(2);
  s.walls[0].faces["x_high"] = FaceCondition::open;
  MirrorWall plate;
  for (int k = 0; k <= 8; ++k) plate.position.push_back(Vec3(1.0 + 0.4 * s.lattice.spacing, k / 8.0, 0));
  plate.velocity.assign(plate.position.size(), Vec3::Zero());
  for (int k = 0; k < 8; ++k) plate.faces.push_back({k, k + 1, k + 1, k});
  Fluid as_laid(s), fluid(s);
  for (Fluid* one : {&as_laid, &fluid}) one->add_wall(plate);
  fluid.settle();
  EXPECT_GT(unrest(as_laid), rest);
  EXPECT_LT(unrest(fluid), rest);
}

TEST(Settled, OnlyIfAskedFor) {
  Settings s = box(2, 0.3);
  s.lattice.settle = false;
  Fluid as_laid(s), fluid(s);
  fluid.settle();
  EXPECT_EQ(by_id(fluid, "position"), by_id(as_laid, "position"));
}

}  // namespace
}  // namespace undex::sph::testing
