// Distances and volumes of shapes against their formulas.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "core/shapes.hpp"

namespace {

using namespace undex;
using std::numbers::pi;

const Bounds everything{Vec3::Constant(-1e300), Vec3::Constant(1e300)};
const Bounds octant{Vec3::Zero(), Vec3::Constant(1e300)};

double distance(const Primitive& shape, double x, double y = 0, double z = 0, int dimension = 3) {
  return signed_distance(shape, Vec3(x, y, z), dimension);
}

TEST(SignedDistance, Box) {
  const Box box{Vec3(0, 0, 0), Vec3(1, 2, 3)};
  EXPECT_DOUBLE_EQ(distance(box, 0.5, 1, 1.5), -0.5);
  EXPECT_DOUBLE_EQ(distance(box, 0.9, 1, 1.5), 0.9 - 1);
  EXPECT_DOUBLE_EQ(distance(box, 4, 1, 1), 3);
  EXPECT_DOUBLE_EQ(distance(box, 4, 6, 1), 5);
  EXPECT_DOUBLE_EQ(distance(box, -2, -3, 9), 7);
  EXPECT_DOUBLE_EQ(distance(box, 0.5, 1, 99, 2), -0.5) << "z does not count in two dimensions";
  EXPECT_DOUBLE_EQ(distance(box, -1, 99, 99, 1), 1);
}

TEST(SignedDistance, Slab) {
  const Slab slab{1, -1, 2};
  EXPECT_DOUBLE_EQ(distance(slab, 1e9, 0, -1e9), -1);
  EXPECT_DOUBLE_EQ(distance(slab, 0, 5, 0), 3);
  EXPECT_LT(distance(slab, 0, 5, 0, 1), 0) << "an axis beyond the dimension bounds nothing";
}

TEST(SignedDistance, Sphere) {
  const Sphere ball{Vec3(1, 0, 0), 2};
  EXPECT_DOUBLE_EQ(distance(ball, 1, 3, 4), 3);
  EXPECT_DOUBLE_EQ(distance(ball, 1, 3, 99, 2), 1);
  EXPECT_DOUBLE_EQ(distance(ball, 0, 99, 99, 1), -1);
}

TEST(SignedDistance, Cylinder) {
  const Cylinder rod{2, Vec3(1, 1, 77), 2, -3, 3};
  EXPECT_DOUBLE_EQ(distance(rod, 1, 1, 0), -2);
  EXPECT_DOUBLE_EQ(distance(rod, 1, 1, 2.5), -0.5);
  EXPECT_DOUBLE_EQ(distance(rod, 6, 1, 0), 3);
  EXPECT_DOUBLE_EQ(distance(rod, 6, 1, 7), 5) << "to the rim";
  EXPECT_DOUBLE_EQ(distance(rod, 6, 1, 7, 2), 3) << "a disc";
  const Cylinder lying{0, Vec3(0, 1, 0), 2, -3, 3};
  EXPECT_DOUBLE_EQ(distance(lying, 0, 4, 99, 2), 1) << "a strip";
  EXPECT_DOUBLE_EQ(distance(lying, 5, 99, 99, 1), 2) << "an interval";
}

TEST(SignedDistance, Tube) {
  const TubeShape tube{2, Vec3::Zero(), 2, 3, -1, 1};
  EXPECT_DOUBLE_EQ(distance(tube, 0, 0, 0), 2);
  EXPECT_DOUBLE_EQ(distance(tube, 2.25, 0, 0), -0.25);
  EXPECT_DOUBLE_EQ(distance(tube, 0, 4, 0), 1);
  EXPECT_DOUBLE_EQ(distance(tube, 0, 2.5, 3), 2);
  EXPECT_DOUBLE_EQ(distance(tube, 0, 6, 5), 5);
}

TEST(SignedDistance, SubtractionIsALowerBoundOutside) {
  const Shape shell{Sphere{Vec3::Zero(), 2}, {Sphere{Vec3::Zero(), 1}}};
  EXPECT_DOUBLE_EQ(signed_distance(shell, Vec3(0.25, 0, 0), 3), 0.75);
  EXPECT_DOUBLE_EQ(signed_distance(shell, Vec3(1.75, 0, 0), 3), -0.25);
  EXPECT_DOUBLE_EQ(signed_distance(shell, Vec3(3, 0, 0), 3), 1);
}

TEST(SignedDistance, IsOneLipschitz) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-3, 3);
  const std::vector<Primitive> shapes{Box{Vec3(-1, 0, 0), Vec3(1, 2, 1)}, Slab{2, 0, 1}, Sphere{Vec3(1, 0, 0), 1},
                                      Cylinder{.axis = 1, .center = Vec3(0, 0, 1), .radius = 1, .low = -1, .high = 2},
                                      TubeShape{.axis = 0, .center = Vec3::Zero(), .inner = 1, .outer = 2, .low = -1, .high = 1}};
  for (const Primitive& shape : shapes)
    for (int dimension = 1; dimension <= 3; ++dimension)
      for (int i = 0; i < 500; ++i) {
        Vec3 a(at(random), at(random), at(random)), b = a + 0.1 * Vec3(at(random), at(random), at(random));
        const double moved = (a - b).head(dimension).norm();
        EXPECT_LE(std::abs(signed_distance(shape, a, dimension) - signed_distance(shape, b, dimension)), moved + 1e-12);
      }
}

TEST(BoundsOfShapes, AreTight) {
  const Bounds tube =
      bounds(Primitive(TubeShape{.axis = 0, .center = Vec3(9, 1, 2), .inner = 1, .outer = 3, .low = -4, .high = 5}), 3);
  EXPECT_EQ(tube.low, Vec3(-4, -2, -1));
  EXPECT_EQ(tube.high, Vec3(5, 4, 5));
  const Bounds slab = bounds(Primitive(Slab{1, 0, 1}), 2);
  EXPECT_EQ(slab.low, Vec3(-1e300, 0, 0));
  EXPECT_EQ(slab.high, Vec3(1e300, 1, 0));
  const Bounds disc = bounds(Shape{Cylinder{.axis = 2, .center = Vec3(1, 1, 0), .radius = 1, .low = 0, .high = 9}, {}}, 2);
  EXPECT_EQ(disc.low, Vec3(0, 0, 0));
  EXPECT_EQ(disc.high, Vec3(2, 2, 0));
}

struct VolumeCase {
  const char* what;
  Shape shape;
  Bounds window;
  int dimension;
  double exact;
};

TEST(Volume, AgreesWithTheFormulas) {
  const double r = 0.04445, half = 0.1143, charge = 0.0072;
  const Vec3 c(0.3, -0.2, 0.1);
  const std::vector<VolumeCase> cases{
      {"ball", {Sphere{c, 0.7}, {}}, everything, 3, 4 * pi / 3 * std::pow(0.7, 3)},
      {"octant of a ball", {Sphere{Vec3::Zero(), 0.015}, {}}, octant, 3, pi / 6 * std::pow(0.015, 3)},
      {"disc", {Sphere{c, 0.7}, {}}, everything, 2, pi * 0.49},
      {"interval", {Sphere{c, 0.7}, {}}, everything, 1, 1.4},
      {"cylinder",
       {Cylinder{.axis = 2, .center = c, .radius = r, .low = -half, .high = half}, {}},
       everything,
       3,
       pi * r * r * 2 * half},
      {"octant of a cylinder",
       {Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = r, .low = -half, .high = half}, {}},
       octant,
       3,
       pi * r * r * half / 4},
      {"thin tube",
       {TubeShape{.axis = 1, .center = c, .inner = 0.05, .outer = 0.051, .low = 0, .high = 1}, {}},
       everything,
       3,
       pi * (0.051 * 0.051 - 0.0025)},
      {"water round a charge",
       {Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = r, .low = -half, .high = half}, {Sphere{Vec3::Zero(), charge}}},
       octant,
       3,
       pi * r * r * half / 4 - pi / 6 * std::pow(charge, 3)},
      {"box with a bite", {Box{Vec3(0, 0, 0), Vec3(1, 1, 1)}, {Sphere{Vec3(1, 1, 1), 0.5}}}, everything, 3, 1 - pi / 6 * 0.125},
      {"square with a hole",
       {Box{Vec3(0, 0, 0), Vec3(1, 1, 0)},
        {Cylinder{.axis = 2, .center = Vec3(0.5, 0.5, 0), .radius = 0.3, .low = 0, .high = 1}}},
       everything,
       2,
       1 - pi * 0.09},
      {"half a ball by a slab", {Sphere{Vec3::Zero(), 1}, {Slab{0, 0, 5}}}, everything, 3, 2 * pi / 3},
  };
  for (const VolumeCase& each : cases) {
    const auto start = std::chrono::steady_clock::now();
    const double found = volume(each.shape, each.window, each.dimension);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_NEAR(found / each.exact, 1, 1e-5) << each.what;
    RecordProperty(each.what, std::to_string(found / each.exact - 1) + " in " + std::to_string(seconds) + " s");
  }
}

TEST(Volume, OfBoxesIsExact) {
  const Shape shape{Box{Vec3(0, 0, 0), Vec3(1, 1, 1)},
                    {Box{Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2)}, Box{Vec3(0.75, 0, 0), Vec3(1, 1, 1)}, Slab{2, 0, 0.25}}};
  EXPECT_DOUBLE_EQ(volume(shape, everything, 3), 0.75 * 0.75 - 0.25 * 0.5 * 0.5);
  EXPECT_DOUBLE_EQ(volume({Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)}, {}}, octant, 3), 1);
  EXPECT_DOUBLE_EQ(volume({Box{Vec3(-1, 7, 7), Vec3(1, -7, 7)}, {}}, everything, 1), 2);
  EXPECT_EQ(volume({Box{Vec3(-2, -2, -2), Vec3(-1, 1, 1)}, {}}, octant, 3), 0);
}

/// Ball, torus, hollow cylinder, and a cylinder less a ball, all about x = 0.
TEST(Volume, OfBodiesOfRevolution) {
  const double pi = std::numbers::pi;
  const Bounds everything{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  const auto disc = [](double x, double y, double radius) { return Sphere{.center = Vec3(x, y, 0), .radius = radius}; };
  const double ball = 4.0 / 3.0 * pi * std::pow(0.3, 3);
  EXPECT_NEAR(volume_of_revolution({disc(0, 0.1, 0.3), {}}, everything), ball, 1e-5 * ball);
  const double torus = 2 * pi * pi * 0.5 * 0.2 * 0.2;
  EXPECT_NEAR(volume_of_revolution({disc(0.5, 0, 0.2), {}}, everything), torus, 1e-5 * torus);
  const double hollow = pi * (0.7 * 0.7 - 0.4 * 0.4) * 0.5;
  EXPECT_NEAR(volume_of_revolution({Box{Vec3(0.4, 0, 0), Vec3(0.7, 0.5, 0)}, {}}, everything), hollow, 1e-14);
  const double left = pi * 0.5 * 0.5 * 0.8 - ball;
  EXPECT_NEAR(volume_of_revolution({Box{Vec3(-0.5, -0.4, 0), Vec3(0.5, 0.4, 0)}, {disc(0, 0, 0.3)}}, everything), left,
              1e-5 * left);
}

TEST(Volume, OfNothingIsZeroAndOfASlabInfinite) {
  EXPECT_EQ(volume({Sphere{Vec3::Zero(), 1}, {Sphere{Vec3::Zero(), 2}}}, everything, 3), 0);
  EXPECT_EQ(volume({Sphere{Vec3::Constant(-5), 1}, {}}, octant, 3), 0);
  EXPECT_TRUE(std::isinf(volume({Slab{0, 0, 1}, {}}, everything, 3)));
  EXPECT_TRUE(std::isinf(volume({Slab{0, 0, 1}, {Sphere{Vec3::Zero(), 2}}}, everything, 3)));
  EXPECT_DOUBLE_EQ(volume({Slab{0, 0, 1}, {}}, everything, 1), 1);
}

}  // namespace
