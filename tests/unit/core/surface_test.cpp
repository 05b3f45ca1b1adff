// Points of a wet surface: the nearest one, and where it goes with the nodes.
#include "core/surface.hpp"

#include <gtest/gtest.h>

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

}  // namespace
