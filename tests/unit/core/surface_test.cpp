// Points of a wet surface: the nearest one, and where it goes with the nodes.
#include "core/surface.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>

#include "core/bilinear_patch.hpp"

namespace {

using namespace undex;

/// A plate of 4 x 3 faces in the plane z = 0, which goes into the structure along z.
WetSurface plate(double length, double width) {
  WetSurface surface;
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 4; ++i) surface.nodes.push_back(Vec3(length * i / 4, width * j / 3, 0));
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) {
      const int first = 5 * j + i;
      surface.faces.push_back({first, first + 1, first + 6, first + 5});
    }
  return surface;
}

TEST(WetSurface, NearestFootFollowsTheSurface) {
  const WetSurface surface = plate(1.0, 0.6);
  const SurfaceFoot foot = nearest_foot(surface, Vec3(0.375, 0.3, -0.02));
  const auto place = [&](std::span<const Vec3> nodes) { return blended(foot.weight, surface.faces[foot.face], nodes); };
  EXPECT_NEAR(foot.distance, 0.02, 1e-12);
  EXPECT_LT((place(surface.nodes) - Vec3(0.375, 0.3, 0)).norm(), 1e-12);
  std::vector<Vec3> moved = surface.nodes;
  for (Vec3& x : moved) x += Vec3(0, 0, 0.5 * x[0]);
  EXPECT_LT((place(moved) - Vec3(0.375, 0.3, 0.1875)).norm(), 1e-12);
}

/// A segment of the meridian, from the axis along a cone: its ring is a cone's mantle.
TEST(WetSurface, ASegmentOfTheMeridianIsAFace) {
  const std::vector<std::array<int, 4>> faces{{0, 1, 1, 0}};
  const std::vector<Vec3> node{{0.0, 0.0, 0.0}, {0.03, 0.04, 0.0}};
  EXPECT_TRUE(is_segment(faces[0]));
  const auto x = corners_of(faces[0], node);
  EXPECT_LT((0.25 * (x[0] + x[1] + x[2] + x[3]) - Vec3(0.015, 0.02, 0.0)).norm(), 1e-15);
  const Vec3 outward = (x[1] - x[0]).cross(x[3] - x[0]).normalized();
  EXPECT_LT((outward - Vec3(0.8, -0.6, 0.0)).norm(), 1e-14);
  const auto normal = node_normals(faces, node, {true, false, false});
  EXPECT_LT((normal[1] - outward).norm(), 1e-14);
  EXPECT_LT((normal[0] - Vec3(0.0, -1.0, 0.0)).norm(), 1e-14) << "on the axis";
  const auto area = nodal_areas(faces, node);
  const double mantle = std::numbers::pi * 0.03 * 0.05;
  EXPECT_NEAR(area[0] + area[1], mantle, 1e-15);
  EXPECT_NEAR(area[0], mantle / 3.0, 1e-15);
}

}  // namespace
