// Loads spread over a particle's footprint: sums and power are kept, and a coarse mesh is left alone.
#include "sph_fluid/walls/footprint.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace undex::sph {
namespace {

struct Plate {
  std::vector<Vec3> x;
  std::vector<std::array<int, 4>> faces;
};

/// n by n faces of `size` [m] on z = 0 from the origin on.
Plate plate(int n, double size) {
  Plate p;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) p.x.push_back({size * i, size * j, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int k = j * (n + 1) + i;
      p.faces.push_back({k, k + 1, k + n + 2, k + n + 1});
    }
  return p;
}

std::vector<Vec3> some_field(std::size_t n, double phase) {
  std::vector<Vec3> field;
  for (std::size_t k = 0; k < n; ++k) field.push_back({std::sin(k + phase), std::cos(3 * k + phase), std::sin(7 * k * phase)});
  return field;
}

TEST(Footprint, KeepsForceAndPower) {
  const Plate p = plate(9, 0.01);
  const Footprint footprint(p.faces, p.x, 0.035, {false, false, false}, false);
  const std::vector<Vec3> force = some_field(p.x.size(), 0.3), velocity = some_field(p.x.size(), 0.7);
  std::vector<Vec3> handed(p.x.size(), Vec3::Zero());
  footprint.spread(force, handed);
  const std::vector<Vec3> seen = footprint.seen(velocity);
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  double given = 0, received = 0;
  for (std::size_t n = 0; n < p.x.size(); ++n) {
    before += force[n];
    after += handed[n];
    given += force[n].dot(seen[n]);
    received += handed[n].dot(velocity[n]);
  }
  EXPECT_LT((after - before).norm(), 1e-13 * p.x.size());
  EXPECT_NEAR(given, received, 1e-13 * p.x.size());
  for (const Vec3& v : footprint.seen(std::vector<Vec3>(p.x.size(), Vec3(1, 2, 3)))) EXPECT_LT((v - Vec3(1, 2, 3)).norm(), 1e-13);
}

TEST(Footprint, LeavesAMeshWiderThanItselfAlone) {
  const Plate p = plate(5, 0.01);
  const Footprint footprint(p.faces, p.x, 0.01, {false, false, false}, false);
  const std::vector<Vec3> v = some_field(p.x.size(), 0.1), seen = footprint.seen(v);
  for (std::size_t n = 0; n < v.size(); ++n) EXPECT_LT((seen[n] - v[n]).norm(), 1e-15);
}

/// The part of a plate beside symmetry planes does what that part does in the whole plate.
TEST(Footprint, SymmetryIsTheWholePlate) {
  const int n = 6;
  Plate part = plate(n, 0.01), whole = plate(2 * n, 0.01);
  for (Vec3& x : whole.x) x -= Vec3(n * 0.01, n * 0.01, 0);
  const auto field = [](const Vec3& x) {  // mirrored across x and y
    return Vec3(std::sin(40 * x[0]) * std::cos(60 * x[1]), std::cos(50 * x[0]) * std::sin(30 * x[1]), std::cos(70 * x[0] * x[1]));
  };
  std::vector<Vec3> in_part, in_whole;
  for (const Vec3& x : part.x) in_part.push_back(field(x));
  for (const Vec3& x : whole.x) in_whole.push_back(field(x));
  const Footprint of_part(part.faces, part.x, 0.032, {true, true, false}, false),
      of_whole(whole.faces, whole.x, 0.032, {false, false, false}, false);
  const std::vector<Vec3> a = of_part.seen(in_part), b = of_whole.seen(in_whole);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Vec3 &one = a[j * (n + 1) + i], &other = b[(j + n) * (2 * n + 1) + i + n];
      EXPECT_LT((one - other).norm(), 1e-12) << i << " " << j;
    }
}

}  // namespace
}  // namespace undex::sph
