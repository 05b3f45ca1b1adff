// Surfaces of whole shapes, and what they weigh.
#include "core/closed_surface.hpp"
#include "core/mass_properties.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

namespace undex::testing {
namespace {

struct Example {
  Primitive shape;
  int dimension;
};

const Example examples[] = {
    {Box{{-0.3, 0.1, -0.2}, {0.3, 0.5, 0.3}}, 3},
    {Sphere{{0.1, 0, 0.2}, 0.4}, 3},
    {Cylinder{0, {0, 0.1, 0.2}, 0.4, -0.3, 0.5}, 3},
    {TubeShape{1, {0.1, 0, 0}, 0.3, 0.5, -0.2, 0.4}, 3},
    {Cone{2, {0.1, 0.2, 0}, 0.5, 0.2, -0.1, 0.6}, 3},
    {Cone{2, {0.1, 0.2, 0}, 0.0, 0.5, -0.1, 0.6}, 3},
    {Box{{-0.3, 0.1, -1}, {0.3, 0.5, 1}}, 2},
    {Sphere{{0.1, 0, 0}, 0.4}, 2},
    {TubeShape{2, {0.1, 0, 0}, 0.3, 0.5, -1, 1}, 2},
    {Cone{1, {0.1, 0, 0}, 0.5, 0.2, -0.1, 0.6}, 2},
    {Box{{-0.3, 0, 0}, {0.4, 1, 1}}, 1},
    {Ellipsoid{{0.1, 0, 0.2}, {0.3, 0.4, 0.6}}, 3},
    {Ellipsoid{{0.1, 0, 0}, {0.3, 0.5, 1}}, 2},
    {placed(Box{{-0.3, 0.1, -0.2}, {0.3, 0.5, 0.3}}, {.rotate = {10, 20, 30}, .about = {}, .move = {0.1, 0, 0}}, 3), 3},
    {placed(Ellipsoid{{0.1, 0, 0}, {0.3, 0.5, 1}}, {.rotate = {0, 0, 30}, .about = Vec3::Zero(), .move = Vec3::Zero()}, 2), 2},
};

/// Whose mesh is made for any signed distance: its nodes lie on smooth parts but may miss edges.
const Example composed[] = {
    {Revolution{2, {0.1, 0, 0}, {{0, -0.5}, {0.3, -0.5}, {0.3, 0.2}, {0, 0.6}}}, 3},
    {Revolution{0, {0, 0.1, 0}, {{0.2, -0.3}, {0.5, -0.3}, {0.5, 0.3}, {0.2, 0.3}}}, 3},
    {Revolution{1, {0.1, 0, 0}, {{0, -0.5}, {0.3, -0.5}, {0.3, 0.2}, {0, 0.6}}}, 2},
    {Union{{Sphere{{-0.2, 0, 0}, 0.3}, Sphere{{0.2, 0, 0}, 0.3}}}, 3},
    {Intersection{{Sphere{{0, 0, 0}, 0.5}, HalfSpace{{0.1, 0, 0}, {1, 0.3, 0}}}}, 3},
    {Difference{{Box{{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}}, Cylinder{2, {0, 0, 0}, 0.2, -1, 1}}}, 3},
    {Difference{{Box{{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}}, Sphere{{0.4, 0.4, 0}, 0.3}}}, 2},
    {placed(Box{{-0.3, -0.3, -0.2}, {0.3, 0.3, 0.2}}, {.rotate = {0, 0, 45}, .about = {}, .move = Vec3::Zero()}, 3), 3},
};

/// Twice the area vector of a face, into the body.
Vec3 area_of(const std::array<int, 4>& face, const WetSurface& surface) {
  const std::array<Vec3, 4> x = corners_of(face, surface.nodes);
  return 0.5 * (x[2] - x[0]).cross(x[3] - x[1]);
}

TEST(ClosedSurface, IsClosedAndLiesOnTheShape) {
  const double spacing = 0.05;
  for (const auto& [shape, dimension] : examples) {
    const auto surface = closed_surface(shape, spacing, dimension);
    ASSERT_TRUE(surface);
    for (const Vec3& x : surface->nodes) EXPECT_LT(std::abs(signed_distance(shape, x, dimension)), 1e-9);
    Vec3 sum = Vec3::Zero();
    double volume = 0, largest = 0, least = 1e300;
    std::map<std::pair<int, int>, int> edges;
    for (const auto& face : surface->faces) {
      const Vec3 area = area_of(face, *surface);
      const std::array<Vec3, 4> x = corners_of(face, surface->nodes);
      const Vec3 middle = 0.25 * (x[0] + x[1] + x[2] + x[3]);
      sum += area;
      volume -= area.dot(middle) / dimension;
      largest = std::max(largest, area.norm());
      least = std::min(least, area.norm());
      EXPECT_GT(signed_distance(shape, middle - 0.3 * spacing * area.normalized(), dimension), 0.0);
      if (is_segment(face)) ++edges[{face[0], -1}], ++edges[{-1, face[1]}];
      else
        for (int c = 0; c < 4; ++c) ++edges[{face[c], face[(c + 1) % 4]}];
    }
    EXPECT_LT(sum.norm(), 1e-12);
    if (dimension > 1)
      for (const auto& [edge, count] : edges) {  // each edge once in either direction
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
      }
    EXPECT_NEAR(volume, mass_properties(shape, dimension).volume, 0.01 * volume);
    if (dimension < 3) continue;
    EXPECT_LT(largest, 2.2 * spacing * spacing);
    EXPECT_GT(least, 0.02 * spacing * spacing);
  }
}

TEST(ClosedSurface, OfComposedShapesIsClosed) {
  const double spacing = 0.05;
  for (const auto& [shape, dimension] : composed) {
    SCOPED_TRACE(std::visit([](const auto& each) { return each.name; }, shape));
    const auto surface = closed_surface(shape, spacing, dimension);
    ASSERT_TRUE(surface);
    double farthest = 0, volume = 0, mean = 0, least = 1e300;
    for (const Vec3& x : surface->nodes) {
      const double d = std::abs(signed_distance(shape, x, dimension));
      farthest = std::max(farthest, d);
      mean += d / double(surface->nodes.size());
    }
    EXPECT_LT(farthest, 0.1 * spacing);
    EXPECT_LT(mean, 0.005 * spacing);
    Vec3 sum = Vec3::Zero();
    std::map<std::pair<int, int>, int> edges;
    for (const auto& face : surface->faces) {
      const Vec3 area = area_of(face, *surface);
      const std::array<Vec3, 4> x = corners_of(face, surface->nodes);
      const Vec3 middle = 0.25 * (x[0] + x[1] + x[2] + x[3]);
      sum += area;
      volume -= area.dot(middle) / dimension;
      least = std::min(least, area.norm());
      if (is_segment(face)) ++edges[{face[0], -1}], ++edges[{-1, face[1]}];
      else
        for (int c = 0; c < 4; ++c) ++edges[{face[c], face[(c + 1) % 4]}];
    }
    EXPECT_LT(sum.norm(), 1e-12);
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
    EXPECT_NEAR(volume, mass_properties(shape, dimension).volume, 0.02 * volume);
    EXPECT_GT(least, dimension == 3 ? 0.01 * spacing * spacing : 0.0);
    for (int a = 0; a < dimension; ++a) {
      if (!is_mirrored(shape, a, 0.0, dimension)) continue;
      for (const auto& face : surface->faces) {
        double low = 1e300, high = -1e300;
        for (const int n : face) {
          low = std::min(low, surface->nodes[std::size_t(n)][a]);
          high = std::max(high, surface->nodes[std::size_t(n)][a]);
        }
        EXPECT_FALSE(low < -1e-6 * spacing && high > 1e-6 * spacing) << low << ' ' << high;
      }
    }
  }
}

TEST(ClosedSurface, NoneOfPartsThinnerThanTheSpacing) {
  EXPECT_FALSE(closed_surface(Union{{HalfSpace{}}}, 0.1, 3));
  EXPECT_FALSE(closed_surface(Union{{Box{{0.001, 0.001, -1}, {1, 1, 1}}, Box{{-1, -1, -1}, {-0.001, -0.001, 1}}}}, 0.1, 3))
      << "two that touch along an edge";
}

TEST(ClosedSurface, APlaneThroughTheMiddleCutsBetweenFaces) {
  for (const auto& [shape, dimension] : examples) {
    const Vec3 at = middle(shape, dimension);
    const auto surface = closed_surface(shape, 0.07, dimension);
    for (const auto& face : surface->faces)
      for (int a = 0; a < std::min(dimension, dimension == 1 ? 0 : 3); ++a) {
        if (!is_mirrored(shape, a, at[a], dimension)) continue;
        double low = 1e300, high = -1e300;
        for (const int n : face) {
          low = std::min(low, surface->nodes[std::size_t(n)][a] - at[a]);
          high = std::max(high, surface->nodes[std::size_t(n)][a] - at[a]);
        }
        EXPECT_FALSE(low < -1e-9 && high > 1e-9);
      }
  }
}

TEST(MassProperties, AreThoseOfTheIntegral) {
  std::vector<Example> all(std::begin(examples), std::end(examples));
  all.insert(all.end(), std::begin(composed), std::end(composed));
  for (const auto& [shape, dimension] : all) {
    SCOPED_TRACE(std::visit([](const auto& each) { return each.name; }, shape));
    const Bounds box = bounds(shape, dimension);
    const int most = dimension == 3 ? 72 : dimension == 2 ? 400 : 1000;
    const int count[3] = {most, dimension > 1 ? most - 5 : 1, dimension > 2 ? most - 9 : 1};  // no plane through many places
    const Vec3 size = box.high - box.low;
    double volume = 0, cell = 1;
    for (int a = 0; a < dimension; ++a) cell *= size[a] / count[a];
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (int i = 0; i < count[0]; ++i)
      for (int j = 0; j < count[1]; ++j)
        for (int k = 0; k < count[2]; ++k) {
          Vec3 x = Vec3::Zero();
          const int at[3] = {i, j, k};
          for (int a = 0; a < dimension; ++a) x[a] = box.low[a] + (at[a] + 0.5) / count[a] * size[a];
          if (signed_distance(shape, x, dimension) > 0) continue;
          volume += cell;
          first += cell * x;
          second += cell * x * x.transpose();
        }
    const MassProperties m = mass_properties(shape, dimension);
    const double length = size.maxCoeff();
    EXPECT_NEAR(m.volume, volume, 0.01 * volume);
    EXPECT_LT((m.centroid - first / volume).norm(), 0.005 * length);
    second -= volume * m.centroid * m.centroid.transpose();
    const Mat3 inertia = second.trace() * Mat3::Identity() - second;
    if (dimension == 1) continue;
    EXPECT_NEAR(m.inertia(2, 2), inertia(2, 2), 0.02 * inertia(2, 2));
    EXPECT_LT(dimension == 3 ? (m.inertia - inertia).norm() : 0.0, 0.02 * inertia.norm());
  }
}

TEST(MassProperties, OfRings) {
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(mass_properties(Box{{0.2, 0, 0}, {0.5, 2, 0}}, 2, true).volume, pi * 0.21 * 2, 1e-12);
  EXPECT_NEAR(mass_properties(Box{{-0.5, 0, 0}, {0.5, 2, 0}}, 2, true).volume, pi * 0.25 * 2, 1e-12);
  EXPECT_NEAR(mass_properties(Cone{1, {0, 0, 0}, 0.3, 0.0, 0, 1}, 2, true).volume, pi * 0.03, 1e-12);
}

}  // namespace
}  // namespace undex::testing
