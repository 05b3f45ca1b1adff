// Bilinear faces: weights, slopes, and the way from a place in space back to the face.
#include <gtest/gtest.h>

#include <numeric>

#include "core/bilinear_patch.hpp"

namespace {

using namespace undex;

/// A warped face with normals that lean apart.
BilinearPatch warped() {
  return {.corner = {Vec3(0, 0, 0), Vec3(1.1, 0.1, 0.2), Vec3(1, 1.2, -0.1), Vec3(-0.1, 0.9, 0.1)},
          .normal = {Vec3(-0.1, 0, 1).normalized(), Vec3(0.2, 0, 1).normalized(), Vec3(0.1, 0.2, 1).normalized(),
                     Vec3(0, 0.1, 1).normalized()}};
}

TEST(BilinearWeights, AreOneAtTheirOwnNodeAndSumToOne) {
  const double place[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int node = 0; node < 4; ++node)
    for (int other = 0; other < 4; ++other)
      EXPECT_EQ(bilinear_weights(place[node][0], place[node][1])[other], node == other ? 1.0 : 0.0);
  const auto weight = bilinear_weights(0.3, 0.7);
  EXPECT_NEAR(std::accumulate(weight.begin(), weight.end(), 0.0), 1.0, 1e-15);
}

TEST(BilinearWeights, BlendWhatTheNodesOfAFaceHave) {
  const std::vector<Vec3> nodal{Vec3(9, 9, 9), Vec3(0, 1, 2), Vec3(1, 1, 2), Vec3(1, 2, 2), Vec3(0, 2, 2)};
  EXPECT_LT((blended(bilinear_weights(0.25, 0.5), {1, 2, 3, 4}, nodal) - Vec3(0.25, 1.5, 2)).norm(), 1e-15);
}

TEST(BilinearPatch, SlopesAreTheDerivatives) {
  const BilinearPatch patch = warped();
  const double u = 0.3, v = 0.6, step = 1e-5;
  const BilinearPatch::Frame frame = patch.frame(u, v);
  const auto along_u = [&](auto of) { return Vec3((of(patch.frame(u + step, v)) - of(patch.frame(u - step, v))) / (2 * step)); };
  const auto along_v = [&](auto of) { return Vec3((of(patch.frame(u, v + step)) - of(patch.frame(u, v - step))) / (2 * step)); };
  const auto foot = [](const BilinearPatch::Frame& f) { return f.foot; };
  const auto normal = [](const BilinearPatch::Frame& f) { return f.normal; };
  EXPECT_LT((along_u(foot) - frame.foot_u).norm(), 1e-9);
  EXPECT_LT((along_v(foot) - frame.foot_v).norm(), 1e-9);
  EXPECT_LT((along_u(normal) - frame.normal_u).norm(), 1e-9);
  EXPECT_LT((along_v(normal) - frame.normal_v).norm(), 1e-9);
  EXPECT_NEAR(frame.normal.norm(), 1.0, 1e-15);
}

TEST(BilinearPatch, FindsItsWayBackFromAPlaceInSpace) {
  const BilinearPatch patch = warped();
  for (const double u : {0.1, 0.5, 0.95})
    for (const double v : {0.0, 0.4, 1.0})
      for (const double distance : {-0.2, 0.0, 0.3}) {
        const BilinearPatch::Frame frame = patch.frame(u, v);
        PatchPoint at;
        ASSERT_TRUE(patch.project(frame.foot - distance * frame.normal, 1.0, at));
        EXPECT_NEAR(at.u, u, 1e-9);
        EXPECT_NEAR(at.v, v, 1e-9);
        EXPECT_NEAR(at.distance, distance, 1e-9);
      }
}

TEST(BilinearPatch, SaysWhereAPlaceIsFarBesideIt) {
  PatchPoint at;
  EXPECT_FALSE(warped().project(Vec3(40, 40, 0), 1.0, at));
}

/// Of a cylinder's face: volume grows with the radius.
TEST(BilinearPatch, VolumeElementFollowsTheNormals) {
  const BilinearPatch patch{.corner = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 1, 1), Vec3(1, 0, 1)},
                            .normal = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 1, 0), Vec3(1, 0, 0)}};
  const BilinearPatch::Frame middle = patch.frame(0.5, 0.5);
  EXPECT_NEAR(middle.element(0.0), std::sqrt(2.0), 1e-14);
  EXPECT_GT(middle.element(0.5), middle.element(0.0));
  EXPECT_LT(middle.element(-0.5), middle.element(0.0));
}

}  // namespace
