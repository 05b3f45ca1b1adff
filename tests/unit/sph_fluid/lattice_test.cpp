// The start: how bodies are filled with particles and walls lined with dummies.
#include "sph_fluid/lattice.hpp"

#include "sph_fluid/walls/lattice_warnings.hpp"
#include "sph_fluid/walls/line_walls.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <set>

#include "scenes.hpp"

namespace undex::sph::testing {
namespace {

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

Settings scene(int dimension, double spacing, const Shape& shape) {
  Settings settings;
  settings.dimension = dimension;
  settings.lattice.spacing = spacing;
  settings.bodies = {body("water", shape, "water-tait")};
  return settings;
}

TEST(Lattice, BoxIsFilledCellByCell) {
  for (int d = 1; d <= 3; ++d) {
    const Settings settings = scene(d, 0.1, box(Vec3(0, 0, 0), Vec3(1.0, 0.5, 0.3)));
    const BodyParticles filled = fill_bodies(settings).at(0);
    EXPECT_EQ(filled.position.size(), d == 1 ? 10u : d == 2 ? 50u : 150u);
    EXPECT_NEAR(sum(filled.volume), d == 1 ? 1.0 : d == 2 ? 0.5 : 0.15, 1e-12);
    for (const Vec3& x : filled.position)
      for (int a = 0; a < 3; ++a) {
        if (a >= d) {
          EXPECT_EQ(x[a], 0.0);
        } else {
          EXPECT_NEAR(x[a] / 0.1 - 0.5, std::round(x[a] / 0.1 - 0.5), 1e-9);
        }
      }
  }
}

/// Mass is exact whatever the lattice cuts off; the body's outline is met as well as the spacing allows.
TEST(Lattice, MassIsExact) {
  const double pi = std::numbers::pi;
  for (const double spacing : {0.1, 0.0637}) {
    Settings settings = scene(3, spacing, Shape{Sphere{Vec3(0.02, 0.01, 0), 0.45}, {}});
    settings.bodies[0].density = 1234.0;
    settings.numerics.threads = 1;
    EXPECT_NEAR(Fluid(settings).ledger().mass, 1234.0 * 4.0 / 3.0 * pi * std::pow(0.45, 3), 2e-5 * 470);
    const BodyParticles filled = fill_bodies(settings).at(0);
    // Each particle's volume is about a cell's.
    EXPECT_NEAR(filled.volume[0] / std::pow(spacing, 3), 1.0, 0.06);
  }
}

TEST(Lattice, SymmetryKeepsAnOctant) {
  Settings settings = scene(3, 0.1, Shape{Sphere{Vec3::Zero(), 0.5}, {}});
  const BodyParticles full = fill_bodies(settings).at(0);
  settings.symmetry.axis = {true, true, true};
  const BodyParticles octant = fill_bodies(settings).at(0);
  EXPECT_EQ(8 * octant.position.size(), full.position.size());
  EXPECT_NEAR(8 * sum(octant.volume), sum(full.volume), 1e-5 * sum(full.volume));
  for (const Vec3& x : octant.position) EXPECT_GT(x.minCoeff(), 0.0);
}

/// Neighbouring bodies on one lattice: no gap, no particle twice.
TEST(Lattice, BodiesShareTheLattice) {
  const Sphere ball{Vec3(0.03, 0, 0), 0.27};
  Settings settings = scene(3, 0.1, Shape{Box{Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)}, {ball}});
  settings.bodies.push_back(body("bubble", Shape{ball, {}}, "bubble-gas"));
  const std::vector<BodyParticles> filled = fill_bodies(settings);
  EXPECT_EQ(filled[0].position.size() + filled[1].position.size(), 1000u);
}

/// The same with jitter: a lattice point is jittered once, not once per body.
TEST(Lattice, BodiesShareTheJitter) {
  const Sphere ball{Vec3(0.03, 0, 0), 0.27};
  for (const double jitter : {0.1, 0.3, 0.5}) {
    Settings settings = scene(3, 0.05, Shape{Box{Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)}, {ball}});
    settings.bodies.push_back(body("bubble", Shape{ball, {}}, "bubble-gas"));
    settings.lattice.jitter = jitter;
    const std::vector<BodyParticles> filled = fill_bodies(settings);
    EXPECT_EQ(filled[0].position.size() + filled[1].position.size(), 8000u) << "jitter " << jitter;
  }
}

TEST(Lattice, JitterIsReproducibleAndSmall) {
  Settings settings = scene(3, 0.1, box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  const BodyParticles still = fill_bodies(settings).at(0);
  settings.lattice.jitter = 0.2;
  const BodyParticles first = fill_bodies(settings).at(0), second = fill_bodies(settings).at(0);
  ASSERT_EQ(first.position.size(), still.position.size());
  double largest = 0;
  Vec3 mean = Vec3::Zero();
  for (std::size_t k = 0; k < first.position.size(); ++k) {
    EXPECT_EQ(first.position[k], second.position[k]);
    const Vec3 moved = first.position[k] - still.position[k];
    largest = std::max(largest, moved.cwiseAbs().maxCoeff());
    mean += moved / double(first.position.size());
  }
  EXPECT_LE(largest, 0.5 * 0.2 * 0.1 * (1 + 1e-12));
  EXPECT_GT(largest, 0.4 * 0.2 * 0.1);
  EXPECT_LT(mean.norm(), 1e-3);
}

/// A spacing that does not divide the body: the lattice is stretched to it where the scene asks for a fit.
TEST(Lattice, FitStretchesTheSpacing) {
  Settings settings = scene(1, 0.3, box(Vec3(0.2, 0, 0), Vec3(1.2, 1, 1)));
  settings.lattice.fit = "water";
  const BodyParticles filled = fill_bodies(settings).at(0);
  ASSERT_EQ(filled.position.size(), 3u);
  EXPECT_NEAR(filled.position[0][0], 0.2 + 1.0 / 6, 1e-12);
  EXPECT_NEAR(filled.position[2][0], 1.2 - 1.0 / 6, 1e-12);
  // Unfitted: the cells lie where they lie, the mass is exact all the same.
  settings.lattice.fit.clear();
  EXPECT_NEAR(sum(fill_bodies(settings).at(0).volume), 1.0, 1e-12);
}

TEST(Lattice, SymmetricBodyGetsACellFaceAtZero) {
  Settings settings = scene(1, 0.3, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
  settings.lattice.fit = "water";
  const BodyParticles filled = fill_bodies(settings).at(0);
  ASSERT_EQ(filled.position.size() % 2, 0u);
  for (std::size_t k = 0; k < filled.position.size(); ++k)
    EXPECT_NEAR(filled.position[k][0], -filled.position[filled.position.size() - 1 - k][0], 1e-12);
}

Settings rings(double spacing) {
  Settings settings =
      scene(3, spacing, Shape{Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = 0.4445, .low = -0.2, .high = 0.2}, {}});
  settings.lattice.type = LatticeType::rings;
  settings.lattice.fit = "water";
  return settings;
}

/// A body that the plane does not halve: its lattice is fitted to the plane and to its far end.
TEST(Lattice, FitHasACellFaceOnASymmetryPlane) {
  Settings settings = scene(2, 0.1, box(Vec3(-0.23, 0, 0), Vec3(0.97, 0.5, 0)));
  settings.lattice.fit = "water";
  settings.symmetry.axis = {true, true, false};
  double nearest = 1, farthest = 0;
  const BodyParticles filled = fill_bodies(settings).at(0);
  for (const Vec3& x : filled.position) {
    nearest = std::min(nearest, x[0]);
    farthest = std::max(farthest, x[0]);
  }
  EXPECT_NEAR(nearest, 0.0485, 1e-12);
  EXPECT_NEAR(farthest, 0.97 - 0.0485, 1e-12);
  EXPECT_TRUE(lattice_warnings(settings).empty());
}

TEST(Lattice, WarnsOfAPlaneBetweenItsCellFaces) {
  Settings settings = scene(2, 0.1, box(Vec3(0, 0, 0), Vec3(1, 0.5, 0)));
  settings.lattice.settle = false;
  settings.symmetry.axis = {true, false, false};
  EXPECT_TRUE(lattice_warnings(settings).empty());
  settings.lattice.origin = Vec3(0.3, 0.05, 0);
  EXPECT_TRUE(lattice_warnings(settings).empty());
  settings.lattice.origin = Vec3(0.33, 0, 0);
  ASSERT_EQ(lattice_warnings(settings).size(), 1u);
  EXPECT_NE(lattice_warnings(settings)[0].find("0.3 spacings off) the symmetry plane x = 0"), std::string::npos)
      << lattice_warnings(settings)[0];
  settings.lattice.origin = Vec3::Zero();
  settings.lattice.rotation = Vec3(0, 0, 90);
  EXPECT_TRUE(lattice_warnings(settings).empty());
  settings.lattice.rotation = Vec3(0, 0, 17);
  ASSERT_EQ(lattice_warnings(settings).size(), 1u);
  EXPECT_NE(lattice_warnings(settings)[0].find("is turned against the symmetry plane x"), std::string::npos);
  settings.bodies[0].shape = box(Vec3(0.3, 0, 0), Vec3(1, 0.5, 0));  // does not come near
  EXPECT_TRUE(lattice_warnings(settings).empty());
}

TEST(Lattice, WarnsOfASlipWallBetweenItsCellFaces) {
  Settings settings = scene(2, 0.1, box(Vec3(0, 0, 0), Vec3(1, 0.55, 0)));
  settings.lattice.settle = false;
  settings.walls = {box_wall(Vec3(0, 0, 0), Vec3(1, 0.55, 0))};
  ASSERT_EQ(lattice_warnings(settings).size(), 1u);
  EXPECT_NE(lattice_warnings(settings)[0].find("slip wall y = 0.55 m (the nearest is 0.5 spacings off)"), std::string::npos)
      << lattice_warnings(settings)[0];
  settings.lattice.fit = "box";
  EXPECT_TRUE(lattice_warnings(settings).empty());
  settings.lattice.fit.clear();
  settings.walls[0].faces["y_high"] = FaceCondition::no_slip;  // lined with the lattice itself
  EXPECT_TRUE(lattice_warnings(settings).empty());

  settings = rings(0.05);
  settings.lattice.settle = false;
  Wall wall;
  wall.name = "side";
  wall.container = Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = 0.4445, .low = -0.2, .high = 0.2};
  wall.faces = {{"low", FaceCondition::open}, {"high", FaceCondition::open}};
  settings.walls = {wall};
  EXPECT_TRUE(lattice_warnings(settings).empty());
  settings.lattice.type = LatticeType::cartesian;
  ASSERT_EQ(lattice_warnings(settings).size(), 1u);
  EXPECT_NE(lattice_warnings(settings)[0].find("round slip wall of radius 0.4445 m"), std::string::npos)
      << lattice_warnings(settings)[0];
  settings.lattice.settle = true;
  EXPECT_TRUE(lattice_warnings(settings).empty());
}

/// A ball does not see how its lattice lies: its particles, and all that becomes of them, are those of the lattice as it is,
/// turned.
TEST(Lattice, TurnedInABall) {
  for (const int dimension : {2, 3}) {
    Settings straight = scene(dimension, 0.1, Shape{Sphere{Vec3::Zero(), 0.5}, {}});
    straight.bodies[0].pressure = 5e7;
    straight.numerics.threads = 1;
    Settings turned = straight;
    turned.lattice.rotation = dimension == 2 ? Vec3(0, 0, 17) : Vec3(10, -20, 30);
    const double angle = turned.lattice.rotation.norm();
    const Mat3 R = Eigen::AngleAxisd(angle * std::numbers::pi / 180, turned.lattice.rotation / angle).toRotationMatrix();
    Fluid a(straight), b(turned);
    ASSERT_EQ(a.particle_count(), b.particle_count());
    for (int k = 0; k < 20; ++k) {
      const double dt = a.step_limit().step;
      a.step(dt);
      b.step(dt);
    }
    const std::vector<Vec3> x = by_id(a, "position"), y = by_id(b, "position");
    std::vector<Vec3> left;
    for (const Vec3& each : x) left.push_back(R * each);
    const auto before = [](const Vec3& p, const Vec3& q) {
      for (int c = 0; c < 3; ++c)
        if (std::abs(p[c] - q[c]) > 1e-6) return p[c] < q[c];
      return false;
    };
    std::vector<Vec3> right = y;
    std::sort(left.begin(), left.end(), before);
    std::sort(right.begin(), right.end(), before);
    double moved = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      EXPECT_LT((left[i] - right[i]).norm(), 1e-8 * 0.1) << i;  // the predictor's earlier rates are in single precision
      moved = std::max(moved, left[i].norm() - 0.5);
    }
    EXPECT_GT(moved, -0.05);  // its free surface has moved
  }
}

/// Where the body is not round the lattice cuts it elsewhere; masses are exact all the same, and bodies share the lattice.
TEST(Lattice, TurnedMassIsExactAndNothingIsTwice) {
  const Sphere ball{Vec3(0.03, 0, 0), 0.27};
  Settings settings = scene(3, 0.05, Shape{Box{Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)}, {ball}});
  settings.bodies.push_back(body("bubble", Shape{ball, {}}, "bubble-gas"));
  settings.lattice.rotation = Vec3(5, 12, -31);
  settings.lattice.origin = Vec3(0.01, 0.02, 0.03);
  const std::vector<BodyParticles> filled = fill_bodies(settings);
  const double of_ball = 4.0 / 3.0 * std::numbers::pi * std::pow(0.27, 3);
  EXPECT_NEAR(sum(filled[0].volume), 1.0 - of_ball, 2e-5);
  EXPECT_NEAR(sum(filled[1].volume), of_ball, 2e-5 * of_ball);
  std::vector<Vec3> all = filled[0].position;
  all.insert(all.end(), filled[1].position.begin(), filled[1].position.end());
  EXPECT_NEAR(double(all.size()), 8000, 200);
  for (std::size_t i = 0; i < all.size(); i += 97) {  // everyone's nearest neighbour is a spacing away
    double nearest = 1;
    for (std::size_t j = 0; j < all.size(); ++j)
      if (j != i) nearest = std::min(nearest, (all[i] - all[j]).norm());
    EXPECT_NEAR(nearest, 0.05, 1e-12);
    EXPECT_LE(all[i].cwiseAbs().maxCoeff(), 0.5);
  }
}

TEST(Lattice, RingsFitTheRadius) {
  for (const double spacing : {0.05, 0.03}) {
    Settings settings = rings(spacing);
    const BodyParticles settled = fill_bodies(settings).at(0);
    settings.lattice.settle = false;
    const BodyParticles filled = fill_bodies(settings).at(0);
    EXPECT_EQ(settled.volume, filled.volume);
    const double rings_wanted = std::round(0.4445 / spacing), width = 0.4445 / rings_wanted;
    std::set<long> radii, layers;
    for (const Vec3& x : filled.position) {
      const double ring = std::hypot(x[0], x[1]) / width - 0.5;
      EXPECT_NEAR(ring, std::round(ring), 1e-9);
      radii.insert(std::lround(ring));
      layers.insert(std::lround(x[2] * 1e9));
    }
    for (std::size_t k = 0; k < filled.position.size(); ++k)
      EXPECT_LT((settled.position[k] - filled.position[k]).norm(), 0.25 * width);
    EXPECT_EQ(radii.size(), std::size_t(rings_wanted));
    EXPECT_EQ(*radii.rbegin(), std::lround(rings_wanted) - 1);
    EXPECT_EQ(layers.size(), std::size_t(2 * std::round(0.2 / spacing)));
    const double volume = std::numbers::pi * 0.4445 * 0.4445 * 0.4;
    EXPECT_NEAR(sum(filled.volume), volume, 2e-5 * volume);
    const double cell = volume / filled.volume.size();
    EXPECT_GT(*std::min_element(filled.volume.begin(), filled.volume.end()), 0.7 * cell);
    EXPECT_LT(*std::max_element(filled.volume.begin(), filled.volume.end()), 1.3 * cell);
  }
}

TEST(Lattice, RingsAreSymmetricInQuadrants) {
  Settings settings = rings(0.05);
  const std::size_t full = fill_bodies(settings).at(0).position.size();
  settings.symmetry.axis = {true, true, true};
  EXPECT_EQ(8 * fill_bodies(settings).at(0).position.size(), full);
}

TEST(Lattice, OwnSpacing) {
  Settings settings = scene(2, 0.1, box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  settings.bodies[0].spacing = 0.05;
  EXPECT_EQ(fill_bodies(settings).at(0).position.size(), 400u);
}

void expect_refusal(const Settings& settings, const std::string& word) {
  try {
    fill_bodies(settings);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(Lattice, MistakesAreNamed) {
  Settings settings = scene(3, 0.1, box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  settings.lattice.fit = "watr";
  expect_refusal(settings, "watr");
  settings = scene(3, 0.1, Shape{Sphere{Vec3(0, 0, 0), 0.01}, {}});
  expect_refusal(settings, "water");
  settings = scene(3, 0.1, box(Vec3(-2, 0, 0), Vec3(-1, 1, 1)));  // on the side that the plane cuts off
  settings.symmetry.axis = {true, false, false};
  expect_refusal(settings, "water");
  settings = scene(3, 0.1, box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  settings.lattice.type = LatticeType::rings;
  expect_refusal(settings, "rings");
}

// ---- Walls ---------------------------------------------------------------------------------------------------------

TEST(WallLining, IsAsDeepAsTheKernelReaches) {
  for (const KernelName kernel : {KernelName::wendland_c2, KernelName::gaussian}) {
    Settings settings = scene(1, 0.1, box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
    settings.numerics.kernel = kernel;
    settings.numerics.eta = 1.2;
    settings.walls = {box_wall(Vec3(0, 0, 0), Vec3(1, 1, 1), FaceCondition::no_slip)};
    const std::vector<LinedWall> walls = line_walls(settings);
    ASSERT_EQ(walls.size(), 1u);
    EXPECT_FALSE(walls[0].free_slip);
    double deepest = 0;
    for (std::size_t k = 0; k < walls[0].position.size(); ++k) {
      const double x = walls[0].position[k][0];
      EXPECT_TRUE(x < 0 || x > 1);
      EXPECT_EQ(walls[0].normal[k], Vec3(x < 0 ? -1 : 1, 0, 0));
      EXPECT_NEAR(walls[0].volume[k], 0.1, 1e-12);
      deepest = std::max(deepest, -x);
    }
    // The particle half a spacing inside must not see past the lining.
    EXPECT_GE(deepest + 0.05, kernel_support(kernel) * 0.12 - 0.05 - 1e-12);
    EXPECT_GE(walls[0].position.size(), 6u);
  }
}

TEST(WallLining, OpenFacesHaveNone) {
  Settings settings = scene(3, 0.1, box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  settings.walls = {box_wall(Vec3(0, 0, 0), Vec3(1, 1, 1))};
  settings.walls[0].faces["x_high"] = FaceCondition::open;
  settings.walls[0].faces["y_low"] = FaceCondition::no_slip;
  settings.numerics.scheme = SchemeName::paper;  // the others mirror the fluid in slip walls
  bool slip = false, stick = false;
  for (const LinedWall& wall : line_walls(settings))
    for (const Vec3& x : wall.position) {
      EXPECT_LT(x[0], 1.0) << "beyond the open face";
      EXPECT_EQ(wall.free_slip, x[1] > 0) << "only the face y_low holds the flow";
      (wall.free_slip ? slip : stick) = true;
    }
  EXPECT_TRUE(slip && stick);
}

TEST(WallLining, CylinderNormalsPointAway) {
  Settings settings = rings(0.05);
  Wall wall;
  wall.name = "side";
  wall.container = Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = 0.4445, .low = -0.2, .high = 0.2};
  wall.faces = {{"side", FaceCondition::free_slip}, {"low", FaceCondition::open}, {"high", FaceCondition::open}};
  settings.walls = {wall};
  EXPECT_TRUE(line_walls(settings).empty()) << "the fluid is mirrored in it";
  settings.numerics.scheme = SchemeName::paper;
  double volume = 0;
  for (const LinedWall& lining : line_walls(settings))
    for (std::size_t k = 0; k < lining.position.size(); ++k) {
      const Vec3& x = lining.position[k];
      const double r = std::hypot(x[0], x[1]);
      EXPECT_GT(r, 0.4445);
      EXPECT_LT(std::abs(x[2]), 0.2);
      EXPECT_NEAR((lining.normal[k] - Vec3(x[0] / r, x[1] / r, 0)).norm(), 0.0, 1e-12);
      volume += lining.volume[k];
    }
  const double width = 0.4445 / 9, outer = 0.4445 + 3 * width;
  EXPECT_NEAR(volume, std::numbers::pi * (outer * outer - 0.4445 * 0.4445) * 0.4, 1e-9);
}

}  // namespace
}  // namespace undex::sph::testing
