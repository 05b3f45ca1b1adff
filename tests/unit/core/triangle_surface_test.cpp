// Closed surfaces of triangles from STL: geometry against formulas, and defects with their places.
#include "core/triangle_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "core/mass_properties.hpp"

namespace undex::testing {
namespace {

using Facet = std::array<Vec3, 3>;

std::vector<Facet> box(const Vec3& low, const Vec3& high) {
  std::vector<Facet> all;
  for (int a = 0; a < 3; ++a)
    for (const bool up : {false, true}) {
      const auto at = [&](double p, double q) {
        Vec3 x;
        x[a] = up ? high[a] : low[a];
        x[(a + 1) % 3] = low[(a + 1) % 3] + p * (high - low)[(a + 1) % 3];
        x[(a + 2) % 3] = low[(a + 2) % 3] + q * (high - low)[(a + 2) % 3];
        return x;
      };
      const Vec3 corner[4] = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
      for (const auto& [i, j] : {std::pair(1, 2), {2, 3}})
        all.push_back(up ? Facet{corner[0], corner[i], corner[j]} : Facet{corner[0], corner[j], corner[i]});
    }
  return all;
}

std::vector<Facet> ball(const Vec3& center, double radius, int n) {
  std::vector<Facet> all;
  const auto at = [&](int i, int j) {
    const double up = std::numbers::pi * i / n, round = std::numbers::pi * (j % (2 * n)) / n;
    return Vec3(center + radius * Vec3(i % n == 0 ? 0 : std::sin(up) * std::cos(round),
                                       i % n == 0 ? 0 : std::sin(up) * std::sin(round), std::cos(up)));
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      if (i + 1 < n) all.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) all.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return all;
}

std::string ascii(const std::vector<Facet>& facets) {
  std::string text = "solid made\n";
  char line[200];
  for (const Facet& facet : facets) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Vec3& x : facet) {
      std::snprintf(line, sizeof line, "vertex %.17g %.17g %.17g\n", x[0], x[1], x[2]);
      text += line;
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid made\n";
}

std::string binary(const std::vector<Facet>& facets) {
  std::string text(80, ' ');
  const auto put = [&](const auto& value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t(facets.size()));
  for (const Facet& facet : facets) {
    for (int k = 0; k < 3; ++k) put(0.0f);
    for (const Vec3& x : facet)
      for (const double each : x) put(float(each));
    put(std::uint16_t{0});
  }
  return text;
}

std::shared_ptr<const TriangleSurface> surface(const std::vector<Facet>& facets, double scale = 1) {
  return TriangleSurface::parse(ascii(facets), "a.stl", scale);
}

TEST(TriangleSurface, OfABoxIsTheBox) {
  const Box same{{-0.3, 0.1, -0.2}, {0.3, 0.5, 0.3}};
  const auto read = surface(box(1e3 * same.low, 1e3 * same.high), 1e-3);
  const MassProperties exact = mass_properties(same, 3);
  EXPECT_EQ(read->triangle_count(), 12u);
  EXPECT_NEAR(read->volume(), exact.volume, 1e-15);
  EXPECT_LT((read->centroid() - exact.centroid).norm(), 1e-15);
  EXPECT_LT((read->second_moment().trace() * Mat3::Identity() - read->second_moment() - exact.inertia).norm(), 1e-15);
  EXPECT_NEAR(read->reach(Vec3(1, 1, 0)), 0.8, 1e-15);
  std::mt19937 any(3);
  std::uniform_real_distribution<double> at(-0.7, 0.7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x(at(any), at(any), at(any));
    EXPECT_NEAR(read->signed_distance(x), signed_distance(same, x, 3), 1e-12);
  }
  // In the planes of its faces and edges, where rays graze.
  for (const double x : {-0.3, 0.0, 0.3, 0.4})
    for (const double y : {0.1, 0.3, 0.5, 0.6})
      EXPECT_NEAR(read->signed_distance({x, y, 0}), signed_distance(same, {x, y, 0}, 3), 1e-12);
}

TEST(TriangleSurface, AsciiAndBinaryAreOne) {
  const auto facets = ball({1, 2, 3}, 0.5, 24);
  const auto a = TriangleSurface::parse(ascii(facets), "a.stl", 1), b = TriangleSurface::parse(binary(facets), "b.stl", 1);
  EXPECT_EQ(a->triangle_count(), b->triangle_count());
  EXPECT_NEAR(a->volume(), b->volume(), 1e-6);
  const auto fine = surface(ball({1, 2, 3}, 0.5, 100));
  EXPECT_NEAR(fine->volume(), std::numbers::pi / 6, 1e-3 * std::numbers::pi / 6);
  EXPECT_NEAR(fine->signed_distance({1, 2, 3}), -0.5, 5e-4);
}

/// A window cuts a box, another box; a ball's octants make the ball.
TEST(TriangleSurface, VolumesOfWindowsAreExact) {
  const Box same{{-0.3, 0.1, -0.2}, {0.3, 0.5, 0.3}};
  const auto read = surface(box(same.low, same.high));
  std::mt19937 any(5);
  std::uniform_real_distribution<double> at(-0.5, 0.6);
  for (int i = 0; i < 500; ++i) {
    Bounds window;
    for (int k = 0; k < 2; ++k) window.include(Vec3(at(any), at(any), at(any)));
    const Vec3 size = (window.high.cwiseMin(same.high) - window.low.cwiseMax(same.low)).cwiseMax(0.0);
    EXPECT_NEAR(read->volume(window), size.prod(), 1e-15);
  }
  const auto round = surface(ball({0.1, 0, -0.02}, 0.5, 40));
  double sum = 0;
  for (int octant = 0; octant < 8; ++octant) {
    Bounds window{Vec3::Constant(-1e300), Vec3::Constant(1e300)};
    for (int a = 0; a < 3; ++a) (octant >> a & 1 ? window.low : window.high)[a] = 0.13;
    sum += round->volume(window);
  }
  EXPECT_NEAR(sum, round->volume(), 1e-14);
}

TEST(TriangleSurface, DistancesBeyondWhatIsAskedAreCutOff) {
  const auto read = surface(ball({0, 0, 0}, 0.5, 30));
  std::mt19937 any(7);
  std::uniform_real_distribution<double> at(-0.9, 0.9);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x(at(any), at(any), at(any));
    const double exact = read->signed_distance(x);
    for (const double beyond : {1e-3, 0.1, 0.4})
      EXPECT_NEAR(read->signed_distance(x, beyond), std::clamp(exact, -beyond, beyond), 1e-12);
  }
}

/// What is taken out of a body from STL counts once, wherever it lies.
TEST(TriangleSurface, VolumesLessOtherShapes) {
  const Stl stl{"a.stl", 1, surface(box({-0.3, 0.1, -0.2}, {0.3, 0.5, 0.3}))};
  const Bounds all{Vec3::Constant(-1e300), Vec3::Constant(1e300)};
  const double ball_volume = 4.0 / 3.0 * std::numbers::pi * 0.001;
  const double whole = volume({stl, {}}, all, 3);
  EXPECT_NEAR(volume({stl, {Sphere{{0, 0.3, 0}, 0.1}}}, all, 3), whole - ball_volume, 1e-5 * whole);
  EXPECT_NEAR(volume({stl, {Sphere{{0.3, 0.3, 0}, 0.1}}}, all, 3), whole - 0.5 * ball_volume, 1e-5 * whole);
  EXPECT_NEAR(volume({stl, {Sphere{{0, 0.3, 0}, 0.1}, Sphere{{0, 0.3, 0}, 0.05}}}, all, 3), whole - ball_volume, 1e-5 * whole);
  const Primitive moved = placed(stl, {Vec3(0, 0, 30), {}, Vec3(1, 0, 0)}, 3);
  EXPECT_NEAR(volume({moved, {}}, all, 3), whole, 1e-12 * whole);
}

/// A ball with a bore through its middle, in closed form.
TEST(MassProperties, OfADifferenceByOneSum) {
  const double R = 0.1, a = 0.04, long_ = std::sqrt(R * R - a * a);  // a napkin ring
  const Difference ring{
      {Sphere{{0.02, 0, 0}, R}, Cylinder{.axis = 2, .center = {0.02, 0, 0}, .radius = a, .low = -1, .high = 1}}};
  const MassProperties m = mass_properties(ring, 3);
  const double ring_volume = 4.0 / 3.0 * std::numbers::pi * long_ * long_ * long_;
  EXPECT_NEAR(m.volume, ring_volume, 1e-5 * ring_volume);
  EXPECT_LT((m.centroid - Vec3(0.02, 0, 0)).norm(), 1e-5 * R);
  // About its axis: integral of 2 pi r^3 2 sqrt(R^2 - r^2) dr from a to R = 4 pi (R^2 l^3/3 - l^5/5).
  const double about_axis = 4 * std::numbers::pi * (R * R * std::pow(long_, 3) / 3 - std::pow(long_, 5) / 5);
  EXPECT_NEAR(m.inertia(2, 2), about_axis, 3e-4 * about_axis);
}

std::string mistake(const std::string& text, double scale = 1) {
  try {
    TriangleSurface::parse(text, "a.stl", scale);
  } catch (const std::invalid_argument& why) {
    return why.what();
  }
  return "";
}
void expect(const std::string& text, const std::string& words, double scale = 1) {
  const std::string why = mistake(text, scale);
  EXPECT_NE(why.find(words), std::string::npos) << why << "\nshould say: " << words;
  EXPECT_EQ(why.substr(0, 7), "a.stl: ");
}

TEST(TriangleSurface, DefectsAreNamedWithTheirPlace) {
  const auto whole = box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(mistake(ascii(whole)), "");
  auto open = whole;
  open.pop_back();
  expect(ascii(open), "the surface is open: 3 edges have one triangle only, the first from (");
  auto turned = whole;
  for (Facet& facet : turned) std::swap(facet[0], facet[1]);
  expect(ascii(turned), "turned inside out");
  auto one = whole;
  std::swap(one[3][0], one[3][1]);
  expect(ascii(one), "turned against each other");
  auto flat = whole;
  flat.push_back({Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(1, 0, 0)});
  expect(ascii(flat), "triangle 13 is flat: its corners lie on one line, at (0, 0, 0) m");
  auto crossing = whole;
  for (const Facet& facet : box({0.5, 0.5, 0.5}, {1.5, 1.6, 1.7})) crossing.push_back(facet);
  expect(ascii(crossing), "the surface crosses itself at ");
  auto touching = whole;
  for (const Facet& facet : box({1, 1, 0}, {2, 2, 1})) touching.push_back(facet);
  expect(ascii(touching), "has 4 triangles, where a surface has two");
  auto cavity = whole;
  for (const Facet& facet : box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8})) cavity.push_back(facet);
  expect(ascii(cavity), "within another that is turned the same way");
  for (std::size_t t = 12; t < 24; ++t) std::swap(cavity[t][0], cavity[t][1]);
  EXPECT_NEAR(surface(cavity)->volume(), 1 - 0.216, 1e-12);
  EXPECT_GT(surface(cavity)->signed_distance({0.5, 0.5, 0.5}), 0);
  auto apart = whole;
  for (const Facet& facet : box({2, 0, 0}, {3, 1, 1})) apart.push_back(facet);
  EXPECT_NEAR(surface(apart)->volume(), 2, 1e-12);
  auto nowhere = whole;
  nowhere[0][0][1] = std::numeric_limits<double>::quiet_NaN();
  expect(binary(nowhere), "is no place within 1e5 m");
  expect(ascii(whole), "is no place within 1e5 m", 1e6);
}

TEST(TriangleSurface, BadFiles) {
  const std::string good = binary(box({0, 0, 0}, {1, 1, 1}));
  expect("", "it is no STL file");
  expect(good.substr(0, 300), "12 triangles it would have 684 bytes, not 300");
  std::string huge = good;
  const std::uint32_t many = 0xffffffffu;
  std::memcpy(huge.data() + 80, &many, 4);
  expect(huge, "4294967295 triangles it would have 214748364834 bytes");
  expect(std::string(84, '\0'), "it has no triangles");
  const std::string text = ascii(box({0, 0, 0}, {1, 1, 1}));
  expect(text.substr(0, text.size() / 2), "there is no 'endsolid'");
  expect("solid\nendsolid\n", "it has no triangles");
  EXPECT_NE(mistake("solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 zero\nendloop\nendfacet\nendsolid\n"), "");
  EXPECT_THROW(TriangleSurface::read("/nowhere/a.stl", 1), std::invalid_argument);
}

}  // namespace
}  // namespace undex::testing
