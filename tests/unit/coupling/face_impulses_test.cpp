// Impulses of named faces: whole together, and each its own under a pressure, edges included.
#include "coupling/face_impulses.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>

namespace undex::coupling {
namespace {

/// The faces x = 0, y = 0 and z = 0 of a block of sides a, in n x n squares each, which share their edges' nodes.
struct Corner {
  WetSurface surface;
  std::vector<NamedFaces> faces;

  explicit Corner(const Vec3& a, int n = 4) {
    std::vector<std::array<int, 3>> known;
    const auto node = [&](const std::array<int, 3>& at) {
      for (std::size_t k = 0; k < known.size(); ++k)
        if (known[k] == at) return int(k);
      known.push_back(at);
      surface.nodes.push_back(Vec3(at[0] * a[0] / n, at[1] * a[1] / n, at[2] * a[2] / n));
      return int(known.size()) - 1;
    };
    for (int across = 0; across < 3; ++across) {
      const std::size_t first = surface.faces.size();
      const int u = (across + 1) % 3, v = (across + 2) % 3;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          std::array<int, 4> face{};
          for (int c = 0; c < 4; ++c) {
            std::array<int, 3> at{};
            at[std::size_t(u)] = i + (c == 1 || c == 2);
            at[std::size_t(v)] = j + (c > 1);
            face[std::size_t(c)] = node(at);
          }
          surface.faces.push_back(face);
        }
      faces.push_back({std::string(1, "xyz"[across]), first, surface.faces.size()});
    }
  }
  /// Nodal impulses of a pressure of a unit of time on each named face: a quarter of each square's.
  std::vector<Vec3> under(const std::array<double, 3>& pressure) const {
    std::vector<Vec3> impulse(surface.nodes.size(), Vec3::Zero());
    for (std::size_t k = 0; k < faces.size(); ++k)
      for (std::size_t f = faces[k].first; f < faces[k].last; ++f) {
        const auto x = corners_of(surface.faces[f], surface.nodes);
        for (int node : surface.faces[f]) impulse[std::size_t(node)] += 0.25 * pressure[k] * (x[1] - x[0]).cross(x[3] - x[0]);
      }
    return impulse;
  }
};

TEST(FaceImpulses, APressureGivesEachFaceItsOwn) {
  const Vec3 a(0.3, 0.5, 0.8);
  const Corner corner(a);
  FaceImpulses on(corner.surface, corner.faces);
  on.book(corner.under({2e6, 2e6, 2e6}), corner.surface.nodes);
  const std::array<Vec3, 3> exact{Vec3(a[1] * a[2], 0, 0), Vec3(0, a[2] * a[0], 0), Vec3(0, 0, a[0] * a[1])};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT((on.impulse()[k] - 2e6 * exact[k]).norm(), 1e-9 * 2e6) << k;
}

/// Where the pressure jumps at an edge, the nodes there do not tell how much of it is whose: an error of the row of squares
/// along it.
TEST(FaceImpulses, AJumpAtAnEdgeConvergesWithTheMesh) {
  double before = 0;
  for (int n : {4, 8, 16}) {
    const Corner corner(Vec3(1, 1, 1), n);
    FaceImpulses on(corner.surface, corner.faces);
    on.book(corner.under({1, 0, 0}), corner.surface.nodes);
    const double error = (on.impulse()[0] - Vec3(1, 0, 0)).norm();
    EXPECT_LT(error, 0.8 / n);
    if (before > 0) {
      EXPECT_NEAR(before / error, 2.0, 0.2);
    }
    before = error;
  }
}

TEST(FaceImpulses, TheSumIsExactWhateverTheNodesReceive) {
  const Corner corner(Vec3(0.3, 0.5, 0.8));
  FaceImpulses on(corner.surface, corner.faces);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  Vec3 all = Vec3::Zero();
  for (int window = 0; window < 3; ++window) {
    std::vector<Vec3> impulse, place;
    for (const Vec3& x : corner.surface.nodes) {
      impulse.push_back(Vec3(any(random), any(random), any(random)));
      place.push_back(x + 0.02 * Vec3(any(random), any(random), any(random)));
      all += impulse.back();
    }
    on.book(impulse, place);
  }
  EXPECT_LT((on.impulse()[0] + on.impulse()[1] + on.impulse()[2] - all).norm(), 1e-13 * double(corner.surface.nodes.size()));
}

/// In a meridian the edge between two segments is a node; what is named by nobody is given to nobody.
TEST(FaceImpulses, SegmentsShareTheirNode) {
  WetSurface surface;
  surface.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(5, 5, 0)};
  surface.faces = {{0, 1, 1, 0}, {1, 2, 2, 1}};
  FaceImpulses on(surface, {{"end", 0, 1}, {"side", 1, 2}});
  // Of a unit pressure that pushes the end along y and the side along -x; the last node belongs to no face.
  const std::vector<Vec3> impulse{Vec3(0, 0.5, 0), Vec3(-0.5, 0.5, 0), Vec3(-0.5, 0, 0), Vec3(7, 7, 7)};
  on.book(impulse, surface.nodes);
  EXPECT_LT((on.impulse()[0] - Vec3(0, 1, 0)).norm(), 1e-14);
  EXPECT_LT((on.impulse()[1] - Vec3(-1, 0, 0)).norm(), 1e-14);
}

}  // namespace
}  // namespace undex::coupling
