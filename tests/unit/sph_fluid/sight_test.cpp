// Thin walls with water on both sides: who sees whom, what passes, and that nothing is lost at their edges.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.hpp"
#include "sph_fluid/walls/sheets.hpp"

namespace undex::sph::testing {
namespace {

/// A plate x across z from `low` to `high`, `cells` along x and y: below and above wet, its end in x where asked for.
MirrorWall plate(const Vec3& low, const Vec3& high, int cells, bool end) {
  MirrorWall wall;
  const auto node = [&](int i, int j, int k) { return (k * (cells + 1) + j) * (cells + 1) + i; };
  for (const double z : {low[2], high[2]})
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i)
        wall.position.push_back({low[0] + (high[0] - low[0]) * i / cells, low[1] + (high[1] - low[1]) * j / cells, z});
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      wall.faces.push_back({node(i, j, 0), node(i + 1, j, 0), node(i + 1, j + 1, 0), node(i, j + 1, 0)});
      wall.faces.push_back({node(i, j, 1), node(i, j + 1, 1), node(i + 1, j + 1, 1), node(i + 1, j, 1)});
    }
  for (int k = 0; k < cells && end; ++k) {
    wall.faces.push_back({node(cells, k, 0), node(cells, k, 1), node(cells, k + 1, 1), node(cells, k + 1, 0)});
  }
  wall.velocity.assign(wall.position.size(), Vec3::Zero());
  wall.impulse = wall.velocity;
  return wall;
}

constexpr double dx = 0.05;

/// Water below a plate that spans its duct and above it, under pressures of their own.
Settings two_waters(double thickness, double below, double above, FaceCondition condition = FaceCondition::free_slip) {
  Settings settings;
  settings.lattice.spacing = dx;
  settings.lattice.fit = "below";
  settings.numerics.threads = 1;
  settings.symmetry.axis = {true, false, false};
  const double wide = 4 * dx, high = 0.5 + thickness;
  settings.bodies = {body("below", box(Vec3(-wide, 0, -0.5), Vec3(wide, wide, 0)), "water-tait"),
                     body("above", box(Vec3(-wide, 0, thickness), Vec3(wide, wide, high)), "water-tait")};
  settings.bodies[0].pressure = below;
  settings.bodies[1].pressure = above;
  settings.walls = {box_wall(Vec3(-wide, 0, -0.5), Vec3(wide, wide, high), condition)};
  return settings;
}

/// Whatever its thickness: the water above a held plate does not feel what is below.
TEST(Sight, NothingPassesAHeldPlate) {
  for (const SchemeName scheme : {SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan})
    for (const Precision precision : {Precision::full, Precision::mixed})
      for (const FaceCondition condition : {FaceCondition::free_slip, FaceCondition::no_slip, FaceCondition::radiating})
        for (const double spacings : {0.2, 1.0, 2.0, 4.0}) {
          // A radiating face follows what both waters do where a plate of less than its mesh ends at it.
          if (condition == FaceCondition::radiating && spacings < 2.0) continue;
          std::vector<double> pressure[2];
          for (const int loaded : {0, 1}) {
            Settings settings = two_waters(spacings * dx, loaded ? 1.1e9 : 1e9, 1e7, condition);
            settings.numerics.scheme = scheme;
            settings.numerics.precision = precision;
            Fluid fluid(settings);
            fluid.add_wall(plate(Vec3(0, 0, 0), Vec3(4 * dx, 4 * dx, spacings * dx), 3, false));
            for (int k = 0; k < 20; ++k) fluid.step(1e-6);
            const std::vector<double> id = fluid.field("id"), all = fluid.field("pressure"), place = fluid.field("position");
            pressure[loaded].assign(id.size(), 0.0);
            for (std::size_t i = 0; i < id.size(); ++i)
              if (place[3 * i + 2] > 0.5 * spacings * dx) pressure[loaded][std::size_t(id[i])] = all[i];
          }
          for (std::size_t i = 0; i < pressure[0].size(); ++i)
            ASSERT_NEAR(pressure[1][i], pressure[0][i], precision == Precision::full ? 1e-2 : 1e2)
                << int(scheme) << " " << spacings << " " << int(condition);
        }
}

/// A plate with an edge in a tank.
Fluid tank(double spacings, double jitter, Vec3 speed, FaceCondition condition = FaceCondition::free_slip) {
  Settings settings;
  settings.lattice.spacing = dx;
  settings.lattice.jitter = jitter;
  settings.numerics.threads = 1;
  const double t = spacings * dx;
  const Box all{Vec3(-8 * dx, -4 * dx, -6 * dx), Vec3(8 * dx, 4 * dx, 6 * dx + t)};
  const Box solid{Vec3(-12 * dx, -8 * dx, 0), Vec3(2 * dx, 8 * dx, t)};
  settings.bodies = {body("water", Shape{all, {solid}}, "water-tait")};
  settings.bodies[0].pressure = 1e8;
  settings.walls = {box_wall(all.low, all.high, condition)};
  settings.lattice.settle = false;
  Fluid fluid(settings);
  MirrorWall wall = plate(Vec3(-8 * dx, -4 * dx, 0), Vec3(2 * dx, 4 * dx, t), 4, true);
  for (Vec3& v : wall.velocity) v = speed;
  fluid.add_wall(wall);
  return fluid;
}

/// In every direction there is water or a mirror, and never both: water on a lattice that fits the plate is in equilibrium at the
/// plate's edge, to 1e-4 of what it would feel beside nothing.
TEST(Sight, WaterAtAnEdgeIsAtRest) {
  for (const FaceCondition condition : {FaceCondition::free_slip, FaceCondition::no_slip, FaceCondition::radiating})
    for (const double spacings : {1.0, 2.0, 3.0, 6.0}) {
      Fluid fluid = tank(spacings, 0.0, Vec3::Zero(), condition);
      const double dt = fluid.step_limit().step;
      fluid.step(dt);
      double fastest = 0;
      for (const Vec3& v : by_id(fluid, "velocity")) fastest = std::max(fastest, v.norm());
      EXPECT_LT(fastest, 1e-4 * 1e8 / (1000.0 * dx) * dt) << spacings << " " << int(condition);
    }
}

/// A double bottom: three waters, that in the middle `gap` spacings thick, and two plates of one spacing. Each of them is at rest
/// under its own pressure.
TEST(Sight, WaterInADoubleBottomIsAtRest) {
  for (const int gap : {1, 2, 3, 4})
    for (const FaceCondition condition : {FaceCondition::free_slip, FaceCondition::no_slip, FaceCondition::radiating}) {
      Settings settings;
      settings.lattice.spacing = dx;
      settings.lattice.settle = false;
      settings.numerics.threads = 1;
      const double wide = 4 * dx, low = dx, high = (1 + gap) * dx;
      settings.bodies = {body("below", box(Vec3(0, 0, -6 * dx), Vec3(wide, wide, 0)), "water-tait"),
                         body("between", box(Vec3(0, 0, low), Vec3(wide, wide, high)), "water-tait"),
                         body("above", box(Vec3(0, 0, high + dx), Vec3(wide, wide, high + 7 * dx)), "water-tait")};
      settings.bodies[0].pressure = 1e8;
      settings.bodies[1].pressure = 2e8;
      settings.bodies[2].pressure = 3e8;
      settings.walls = {box_wall(Vec3(0, 0, -6 * dx), Vec3(wide, wide, high + 7 * dx), condition)};
      Fluid fluid(settings);
      fluid.add_wall(plate(Vec3(0, 0, 0), Vec3(wide, wide, low), 3, false));
      fluid.add_wall(plate(Vec3(0, 0, high), Vec3(wide, wide, high + dx), 3, false));
      const double dt = fluid.step_limit().step;
      fluid.step(dt);
      double fastest = 0;
      for (const Vec3& v : by_id(fluid, "velocity")) fastest = std::max(fastest, v.norm());
      EXPECT_LT(fastest, 1e-6 * 2e8 / (1000.0 * dx) * dt) << gap << " spacings " << int(condition);
    }
}

/// What a moving plate gives and takes, edges included, is what the water takes and gives.
TEST(Sight, AMovingPlateReceivesWhatTheFluidLoses) {
  double error[2];
  for (const int finer : {0, 1}) {
    Fluid fluid = tank(1.0, 0.2, Vec3(0, 0, 30));
    const double dt = (finer ? 0.15 : 0.3) * fluid.step_limit().step;
    const Ledger start = fluid.ledger();
    for (int k = 0; k < (finer ? 20 : 10); ++k) {
      MirrorWall& wall = fluid.wall(MirrorIndex{0});
      for (std::size_t n = 0; n < wall.position.size(); ++n) wall.position[n] += dt * wall.velocity[n];
      fluid.step(dt);
    }
    const Ledger end = fluid.ledger();
    EXPECT_NE(end.wall_work, 0.0);
    error[finer] = std::abs(total(end) - total(start)) / std::abs(end.wall_work - start.wall_work);
  }
  RecordProperty("error", std::to_string(error[0]) + " " + std::to_string(error[1]));
  EXPECT_LT(error[0], 5e-2);
  EXPECT_LT(error[1], 0.6 * error[0]);
}

/// Water on both sides of a plate in a shock: no particle goes through it.
TEST(Sight, NoParticleCrossesAPlate) {
  for (const double spacings : {0.2, 1.0}) {
    Fluid fluid(two_waters(spacings * dx, 3e9, 1e7));
    fluid.add_wall(plate(Vec3(0, 0, 0), Vec3(4 * dx, 4 * dx, spacings * dx), 3, false));
    const auto above = [&] {
      std::vector<bool> side;
      for (const Vec3& x : by_id(fluid, "position")) side.push_back(x[2] > 0.5 * spacings * dx);
      return side;
    };
    const std::vector<bool> before = above();
    for (int k = 0; k < 100; ++k) fluid.step(fluid.step_limit().step);
    EXPECT_EQ(above(), before);
  }
}

/// Walls of the plane, in spacings: lines of points with the wall on their right, in pieces of two spacings at most.
MirrorWall outline(const std::vector<std::vector<Vec3>>& lines) {
  MirrorWall wall;
  for (const auto& points : lines) {
    wall.position.push_back(dx * points[0]);
    for (std::size_t k = 1; k < points.size(); ++k) {
      const int pieces = int(std::ceil(0.5 * (points[k] - points[k - 1]).norm()));
      for (int m = 1; m <= pieces; ++m) {
        const int last = int(wall.position.size()) - 1;
        wall.position.push_back(dx * (points[k - 1] + (points[k] - points[k - 1]) * m / pieces));
        wall.faces.push_back({last, last + 1, last + 1, last});
      }
    }
  }
  wall.velocity.assign(wall.position.size(), Vec3::Zero());
  wall.impulse = wall.velocity;
  return wall;
}

/// A tank of the plane, sixteen spacings wide and high, full of water at 100 MPa but for the solids.
Settings tank_of_the_plane(const std::vector<Primitive>& solids) {
  Settings settings;
  settings.dimension = 2;
  settings.lattice.spacing = dx;
  settings.lattice.settle = false;
  settings.numerics.threads = 1;
  const Vec3 low(-8 * dx, -8 * dx, 0), high(8 * dx, 8 * dx, 0);
  settings.bodies = {body("water", Shape{Box{low, high}, solids}, "water-tait")};
  settings.bodies[0].pressure = 1e8;
  settings.walls = {box_wall(low, high)};
  return settings;
}

/// The largest speed after one step, over what the water would reach beside nothing.
double unrest(Fluid& fluid) {
  const double dt = fluid.step_limit().step;
  fluid.step(dt);
  double fastest = 0;
  for (const Vec3& v : by_id(fluid, "velocity")) fastest = std::max(fastest, v.norm());
  return fastest / (1e8 / (1000.0 * dx) * dt);
}

/// A stiffener on a plate from wall to wall, of one mesh and of two walls that touch, and a plate that ends near its stiffener.
TEST(Sight, WaterInCornersIsAtRest) {
  for (const double t : {1.0, 2.0, 6.0})
    for (const double end : {8.0, t + 1, t + 2}) {
      if (end < 8.0 && t > 2.0) continue;
      const Settings settings = tank_of_the_plane(
          {Box{dx * Vec3(-9, -t, 0), dx * Vec3(end < 8 ? end : 9, 0, 0)}, Box{dx * Vec3(0, 0, 0), dx * Vec3(t, 4, 0)}});
      const std::vector<Vec3> web{{0, 0, 0}, {0, 4, 0}, {t, 4, 0}, {t, 0, 0}};
      std::vector<Vec3> top{{-8, 0, 0}, {end, 0, 0}}, below{{end, -t, 0}, {-8, -t, 0}};
      if (end < 8.0) top.insert(top.end(), below.begin(), below.end()), below.clear();
      const auto with = [&](std::vector<Vec3> first) {
        return below.empty() ? std::vector<std::vector<Vec3>>{first} : std::vector<std::vector<Vec3>>{first, below};
      };
      Fluid two(settings);
      two.add_wall(outline(with(top)));
      two.add_wall(outline({web}));
      EXPECT_LT(unrest(two), 5e-4) << t << " " << end;
      std::vector<Vec3> around{top[0]};
      around.insert(around.end(), web.begin(), web.end());
      around.insert(around.end(), top.begin() + 1, top.end());
      Fluid one(settings);
      one.add_wall(outline(with(around)));
      EXPECT_LT(unrest(one), 5e-4) << t << " " << end << " one mesh";
    }
}

/// A plate of two spacings whose middle is a symmetry plane.
TEST(Sight, HalfAPlateIsAsTheWhole) {
  Settings settings = tank_of_the_plane({Box{dx * Vec3(-9, -1, 0), dx * Vec3(9, 1, 0)}});
  settings.symmetry.axis = {false, true, false};
  Fluid fluid(settings);
  fluid.add_wall(outline({{{-8, 1, 0}, {8, 1, 0}}}));
  EXPECT_LT(unrest(fluid), 1e-4);
}

/// Water that flies past an edge keeps its way.
TEST(Sight, NothingTurnsWaterBesideAWall) {
  Settings settings = tank_of_the_plane({});
  settings.bodies[0].shape = box(dx * Vec3(3, 2, 0), dx * Vec3(5, 4, 0));
  settings.bodies[0].pressure = 1.0;
  settings.bodies[0].velocity = Vec3(0, -50, 0);
  Fluid fluid(settings);
  fluid.add_wall(outline({{{-8, 1, 0}, {2, 1, 0}, {2, 0, 0}, {-8, 0, 0}}}));
  for (int k = 0; k < 700; ++k) fluid.step(1e-5);
  double fastest = 0;
  for (const Vec3& v : by_id(fluid, "velocity")) fastest = std::max(fastest, (v - Vec3(0, -50, 0)).norm());
  EXPECT_LT(fastest, 1.0);
  for (const Vec3& x : by_id(fluid, "position")) EXPECT_LT(x[1], 0.0);
}

TEST(Sheets, EndAtSharpEdgesAndAtTheMeshsEnd) {
  const MirrorWall open = plate(Vec3::Zero(), Vec3(1, 1, 0.1), 2, false), closed = plate(Vec3::Zero(), Vec3(1, 1, 0.1), 2, true);
  const Sheets two(open.faces, open.position, {.tolerance = 1e-6}), three(closed.faces, closed.position, {.tolerance = 1e-6}),
      held(open.faces, open.position, {.symmetry = {true, false, false}, .tolerance = 1e-6});
  EXPECT_EQ(two.count(), 2);
  EXPECT_EQ(three.count(), 3);
  const auto edges = [](const MirrorWall& wall, const Sheets& sheets, bool sharp) {
    int count = 0;
    for (int f = 0; f < int(wall.faces.size()); ++f) count += __builtin_popcount(sharp ? sheets.sharp(f) : sheets.open(f));
    return count;
  };
  EXPECT_EQ(edges(open, two, false), 16);
  EXPECT_EQ(edges(open, two, true), 0);
  EXPECT_EQ(edges(open, held, false), 12) << "an edge in a symmetry plane is none";
  SlipFaces radiating;
  radiating.plane.push_back({.axis = 1, .low = 0.0, .high = 1e300, .symmetric = false, .window = {}});
  const Sheets on(open.faces, open.position, {.radiating = radiating, .tolerance = 1e-6});
  EXPECT_EQ(edges(open, on, false), 12);
  EXPECT_EQ(on.goes_on(0), 1u) << "the edge at y = 0";
  Settings settings;
  settings.walls = {box_wall(Vec3(-1, -1, -1), Vec3(1, 1, 1), FaceCondition::radiating)};
  settings.symmetry.axis = {true, false, false};
  EXPECT_TRUE(radiating_faces(settings).hold(Vec3(0, -1, 0), Vec3(0, -1, 1), 1e-6));
  EXPECT_FALSE(radiating_faces(settings).hold(Vec3(0, 0, 0), Vec3(0, 0, 1), 1e-6)) << "nothing radiates at a symmetry plane";
  EXPECT_EQ(edges(closed, three, true), 8) << "two faces an edge, at the end in x";
  // At a sharp edge each side has its own normal.
  std::array<Vec3, 4> normal;
  normal.fill(Vec3(1, 1, 1).normalized());
  three.part_normals(2, closed.faces, closed.position, normal);
  EXPECT_NEAR((normal[1] - Vec3(0, 0, 1)).norm(), 0.0, 1e-14);
  EXPECT_EQ(normal[0], Vec3(1, 1, 1).normalized());
}

}  // namespace
}  // namespace undex::sph::testing
