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

TEST(SignedDistance, EllipsoidHasTheNearestPoint) {
  const Ellipsoid ball{Vec3(1, 0, 0), Vec3(2, 2, 2)};
  EXPECT_NEAR(distance(ball, 1, 3, 4), 3, 1e-12);
  EXPECT_NEAR(distance(ball, 1, 0, 0), -2, 1e-9);
  EXPECT_NEAR(distance(ball, 0, 99, 99, 1), -1, 1e-12);
  const Ellipsoid egg{Vec3::Zero(), Vec3(1, 2, 3)};
  EXPECT_NEAR(distance(egg, 0, 0, 0), -1, 1e-9);
  std::mt19937 any(7);
  std::uniform_real_distribution<double> at(-4, 4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x(at(any), at(any), at(any));
    double nearest = 1e300;
    for (int j = 0; j <= 400; ++j)
      for (int k = 0; k < 800; ++k) {
        const double up = pi * j / 400, round = pi * k / 400;
        const Vec3 there(std::sin(up) * std::cos(round), 2 * std::sin(up) * std::sin(round), 3 * std::cos(up));
        nearest = std::min(nearest, (x - there).norm());
      }
    // The nearest of places up to 0.012 m apart from that sought.
    const bool within = x.cwiseQuotient(egg.semi_axes).norm() < 1;
    const double d = (within ? -1 : 1) * distance(egg, x[0], x[1], x[2]);
    EXPECT_LE(d, nearest + 1e-12);
    EXPECT_GT(d * d + 0.02 * 0.02 * (1 + d), nearest * nearest);
  }
}

TEST(SignedDistance, HalfSpaceAndRevolution) {
  const HalfSpace half{Vec3(1, 0, 0), Vec3(3, 4, 0)};
  EXPECT_DOUBLE_EQ(distance(half, 1, 5, 9), 4);
  EXPECT_DOUBLE_EQ(distance(half, -4, 0, 9), -3);
  const Cone cone{2, Vec3(1, 1, 0), 0.5, 0.0, -1, 2};
  const Revolution same{2, Vec3(1, 1, 0), {{0, -1}, {0.5, -1}, {0, 2}}};
  const TubeShape tube{0, Vec3(0, 1, 2), 0.5, 1, -1, 2};
  const Revolution ring{0, Vec3(0, 1, 2), {{0.5, -1}, {1, -1}, {1, 2}, {0.5, 2}}};
  std::mt19937 any(7);
  std::uniform_real_distribution<double> at(-3, 3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x(at(any), at(any), at(any));
    EXPECT_NEAR(signed_distance(same, x, 3), signed_distance(cone, x, 3), 1e-12);
    EXPECT_NEAR(signed_distance(ring, x, 3), signed_distance(tube, x, 3), 1e-12);
  }
}

TEST(SignedDistance, OfComposedShapes) {
  const Primitive one = Sphere{Vec3(0, 0, 0), 1}, other = Sphere{Vec3(1, 0, 0), 1};
  EXPECT_DOUBLE_EQ(distance(Union{{one, other}}, 4, 0, 0), 2);
  EXPECT_DOUBLE_EQ(distance(Intersection{{one, other}}, 0.5, 0, 0), -0.5);
  EXPECT_DOUBLE_EQ(distance(Difference{{one, other}}, -0.5, 0, 0), -0.5);
  EXPECT_GT(distance(Difference{{one, other}}, 0.5, 0, 0), 0);
  // A lens: two caps of height 1/2.
  EXPECT_NEAR(volume({Intersection{{one, other}}, {}}, everything, 3), 2 * pi * 0.25 * (3 - 0.5) / 3, 1e-4);
  EXPECT_NEAR(volume({Union{{one, other}}, {}}, everything, 3), 8 * pi / 3 - 2 * pi * 0.25 * (3 - 0.5) / 3, 1e-3);
}

TEST(SignedDistance, OfTurnedShapes) {
  const Box box{Vec3(0, 0, 0), Vec3(2, 1, 1)};
  const Placed turned = placed(box, {.rotate = {0, 0, 90}, .about = Vec3::Zero(), .move = Vec3(0, 0, 5)}, 3);
  EXPECT_NEAR(distance(turned, -0.5, 1, 5.5), -0.5, 1e-12);
  EXPECT_NEAR(distance(turned, 1, 1, 5.5), 1, 1e-12);
  const Bounds extent = bounds(Primitive(turned), 3);
  EXPECT_LT((extent.low - Vec3(-1, 0, 5)).norm() + (extent.high - Vec3(0, 2, 6)).norm(), 1e-12);
  const Bounds tilted = bounds(
      Primitive(placed(Cylinder{2, Vec3::Zero(), 1, -2, 2}, {.rotate = {0, 30, 0}, .about = {}, .move = Vec3::Zero()}, 3)), 3);
  EXPECT_NEAR(tilted.high[0], std::cos(pi / 6) + 2 * std::sin(pi / 6), 1e-12);
  EXPECT_NEAR(tilted.high[1], 1, 1e-12);
  EXPECT_FALSE(is_bounded(HalfSpace{}, 3));
  EXPECT_TRUE(is_bounded(Intersection{{HalfSpace{}, box}}, 3));
  EXPECT_TRUE(same_shape(turned, turned));
  EXPECT_FALSE(same_shape(turned, placed(box, {.rotate = {0, 0, 91}, .about = Vec3::Zero(), .move = Vec3(0, 0, 5)}, 3)));
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

TEST(SignedDistance, Cone) {
  const Cone cone{.axis = 1, .center = Vec3(1, 77, 0), .low_radius = 1, .high_radius = 4, .low = 0, .high = 4};  // 3, 4, 5
  EXPECT_DOUBLE_EQ(distance(cone, 1, 0.5, 0), -0.5) << "to the low end";
  EXPECT_DOUBLE_EQ(distance(cone, 1, -2, 0.5), 2);
  EXPECT_DOUBLE_EQ(distance(cone, 1, 4, 6), 2) << "to the rim";
  // From the side's middle, (2.5, 2), along its normal (4, -3)/5.
  for (const double off : {-1.0, 0.5, 1.0}) {
    EXPECT_NEAR(distance(cone, 1, 2 - 0.6 * off, 2.5 + 0.8 * off), off, 1e-14);
    EXPECT_NEAR(distance(cone, 1 + 2.5 + 0.8 * off, 2 - 0.6 * off, 99, 2), off, 1e-14) << "a trapezium";
    EXPECT_NEAR(distance(cone, 1 - 2.5 - 0.8 * off, 2 - 0.6 * off, 99, 2), off, 1e-14);
  }
  const Cone tip{.axis = 2, .center = Vec3::Zero(), .low_radius = 0, .high_radius = 1, .low = -1, .high = 0};
  EXPECT_DOUBLE_EQ(distance(tip, 0, 0, -3), 2);
}

/// The gradient of the distance is the normal: of unit length, everywhere but where two faces are as near.
TEST(SignedDistance, GradientOfAConeIsItsNormal) {
  const Cone cone{.axis = 2, .center = Vec3(0.1, 0, 0), .low_radius = 2, .high_radius = 0.5, .low = -1, .high = 1};
  const double length = std::hypot(2.0, 1.5), sine = -1.5 / length, cosine = 2.0 / length;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(-0.4, 0.4), turn(0, 2 * pi);
  for (int i = 0; i < 200; ++i) {
    const double z = share(random), angle = turn(random), off = 0.2 * share(random), r = cone.radius_at(z);
    const Vec3 normal(cosine * std::cos(angle), cosine * std::sin(angle), -sine);
    const Vec3 x = cone.center + Vec3(r * std::cos(angle), r * std::sin(angle), z) + off * normal;
    EXPECT_NEAR(signed_distance(Primitive(cone), x, 3), off, 1e-13);
    for (int a = 0; a < 3; ++a) {
      const double step = 1e-5;
      const Vec3 by = step * Vec3::Unit(a);
      const double slope =
          (signed_distance(Primitive(cone), x + by, 3) - signed_distance(Primitive(cone), x - by, 3)) / (2 * step);
      EXPECT_NEAR(slope, normal[a], 1e-8);
    }
  }
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
  const std::vector<Primitive> shapes{
      Box{Vec3(-1, 0, 0), Vec3(1, 2, 1)},
      Slab{2, 0, 1},
      Sphere{Vec3(1, 0, 0), 1},
      Cylinder{.axis = 1, .center = Vec3(0, 0, 1), .radius = 1, .low = -1, .high = 2},
      TubeShape{.axis = 0, .center = Vec3::Zero(), .inner = 1, .outer = 2, .low = -1, .high = 1},
      Cone{.axis = 0, .center = Vec3::Zero(), .low_radius = 0, .high_radius = 2, .low = -1, .high = 1}};
  for (const Primitive& shape : shapes)
    for (int dimension = std::holds_alternative<Cone>(shape) ? 2 : 1; dimension <= 3; ++dimension)
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
      {"truncated cone",
       {Cone{.axis = 0, .center = c, .low_radius = 0.2, .high_radius = 0.5, .low = -0.3, .high = 0.6}, {}},
       everything,
       3,
       pi * 0.9 / 3 * (0.04 + 0.1 + 0.25)},
      {"quarter of a cone",
       {Cone{.axis = 2, .center = Vec3::Zero(), .low_radius = 0.5, .high_radius = 0, .low = 0, .high = 0.6}, {}},
       octant,
       3,
       pi * 0.6 / 12 * 0.25},
      {"trapezium",
       {Cone{.axis = 1, .center = c, .low_radius = 0.2, .high_radius = 0.5, .low = -0.3, .high = 0.6}, {}},
       everything,
       2,
       0.7 * 0.9},
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
  const double cone = pi * 0.5 / 3 * (0.01 + 0.04 + 0.16);
  EXPECT_NEAR(volume_of_revolution(
                  {Cone{.axis = 1, .center = Vec3::Zero(), .low_radius = 0.1, .high_radius = 0.4, .low = 0, .high = 0.5}, {}},
                  everything),
              cone, 1e-5 * cone);
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
