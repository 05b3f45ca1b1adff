// The pair loops against sums by brute force, and against a neighbour search by somebody else.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <nanoflann.hpp>
#include <numeric>
#include <set>

#include "pair_sample.hpp"
#include "sph_fluid/water/fluid.hpp"
#include "sph_fluid/pairs/cpu_level.hpp"

namespace undex::sph::testing {
namespace {

/// Rates agree to `tolerance` times the sizes of the summed terms.
void expect_same(const Result& got, const Result& wanted, double tolerance) {
  ASSERT_EQ(got.rates.size(), wanted.rates.size());
  EXPECT_EQ(got.interactions, wanted.interactions);
  for (std::size_t i = 0; i < got.rates.size(); ++i) {
    const Rate &a = got.rates[i], &b = wanted.rates[i];
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(a.a[k], b.a[k], tolerance * b.size[k]) << "particle " << i << " axis " << k;
    ASSERT_NEAR(a.compression, b.compression, tolerance * b.compression_size) << "particle " << i;
    ASSERT_NEAR(a.heat, b.heat, tolerance * b.heat_size) << "particle " << i;
    ASSERT_NEAR(a.closing, b.closing, tolerance * b.closing) << "particle " << i;
  }
  for (std::size_t k = 0; k < got.wall_forces.size(); ++k)
    for (int a = 0; a < 3; ++a)
      ASSERT_NEAR(got.wall_forces[k].a[a], wanted.wall_forces[k].a[a], tolerance * wanted.wall_forces[k].size[a])
          << "wall particle " << k;
}

/// The Gaussian of the pair loops is a polynomial of 2e-11 relative error.
double tolerance_of(KernelName kernel) { return kernel == KernelName::gaussian ? 5e-11 : 2e-12; }

struct Case {
  std::string name;
  int dimension = 3;
  KernelName kernel = KernelName::wendland_c2;
  bool lattice = false;  // else scattered
  bool bodies = false;   // a second body of other spacing with variable h, a third of other constant h
  std::array<bool, 3> mirror{};
  int wall = 0;  // 0: none, 1: free slip, 2: no slip, 3: both, moving
  SchemeName scheme = SchemeName::monaghan;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Sample make(const Case& c) {
  Dice dice(1 + c.dimension);
  Sample sample;
  sample.dimension = c.dimension;
  sample.kernel = c.kernel;
  sample.scheme = c.scheme;
  const double dx = 0.1, h = (c.kernel == KernelName::gaussian ? 1.21 : 1.51) * dx;  // no lattice distance on the support's edge
  for (int a = 0; a < 3; ++a) sample.mirror[a] = c.mirror[a];
  const Vec3 size(c.dimension == 1 ? 6.0 : 0.9, c.dimension > 1 ? 0.8 : 0.0, c.dimension > 2 ? 0.7 : 0.0);
  const Vec3 low = c.mirror[0] || c.mirror[1] || c.mirror[2]
                       ? Vec3(0, 0, 0)
                       : Vec3(-0.2, c.dimension > 1 ? -0.3 : 0.0, c.dimension > 2 ? 0.4 : 0.0);
  Set first;
  first.cell_width = 2 * dx;
  const int counts[3] = {int(size[0] / dx + 0.5), std::max(1, int(size[1] / dx + 0.5)), std::max(1, int(size[2] / dx + 0.5))};
  for (int k = 0; k < counts[2]; ++k)
    for (int j = 0; j < counts[1]; ++j)
      for (int i = 0; i < counts[0]; ++i) {
        Vec3 x = low;
        const double at[3] = {i + 0.5, j + 0.5, k + 0.5};
        for (int a = 0; a < c.dimension; ++a) x[a] += c.lattice ? at[a] * dx : dice.between(0, size[a]);
        first.particles.push_back(random_particle(dice, x, c.dimension, h, dx, 1000, 1e8, 1500));
      }
  sample.sets.push_back(first);
  if (c.bodies) {
    Set gas{{}, true, 3 * dx}, coarse{{}, false, 3 * dx};
    for (int k = 0; k < 60; ++k) {
      Vec3 x = low, y = low;
      for (int a = 0; a < c.dimension; ++a) {
        x[a] += dice.between(0, 0.5 * size[a]);
        y[a] += dice.between(0.4 * size[a], size[a]);
      }
      gas.particles.push_back(random_particle(dice, x, c.dimension, h * dice.between(0.7, 1.8), dx, 1.0, 1e6, 700));
      coarse.particles.push_back(random_particle(dice, y, c.dimension, 1.4 * h, dx, 3000, 1e9, 5000));
    }
    sample.sets.push_back(gas);
    sample.sets.push_back(coarse);
  }
  if (c.wall > 0)
    for (int k = 0; k < 120; ++k) {
      Vec3 x = low, n = Vec3::Zero(), v = Vec3::Zero();
      for (int a = 0; a < c.dimension; ++a) {
        x[a] += dice.between(a == 0 ? 0.8 * size[a] : 0, a == 0 ? 1.2 * size[a] : size[a]);
        n[a] = dice.between(-1, 1);
        if (c.wall == 3) v[a] = dice.between(-50, 50);
      }
      n.normalize();
      const double slip = c.wall == 1 ? 1.0 : c.wall == 2 ? 0.0 : double(k % 2);
      const double volume = std::pow(dx, c.dimension) * dice.between(0.5, 1.5);
      sample.walls.push_back(wall_particle(x, v, n, volume, slip));
    }
  return sample;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const KernelName kernel : {KernelName::wendland_c2, KernelName::gaussian}) {
    const std::string name = kernel == KernelName::gaussian ? "gaussian" : "wendland";
    for (int d = 1; d <= 3; ++d) {
      const std::string in = name + "_" + std::to_string(d) + "d_";
      all.push_back({.name = in + "lattice", .dimension = d, .kernel = kernel, .lattice = true});
      all.push_back({.name = in + "scattered", .dimension = d, .kernel = kernel});
      all.push_back({.name = in + "bodies", .dimension = d, .kernel = kernel, .bodies = true});
      all.push_back({.name = in + "slip_wall", .dimension = d, .kernel = kernel, .lattice = true, .wall = 1});
      all.push_back({.name = in + "no_slip_wall", .dimension = d, .kernel = kernel, .lattice = true, .wall = 2});
      all.push_back({.name = in + "everything",
                     .dimension = d,
                     .kernel = kernel,
                     .bodies = true,
                     .mirror = {true, d > 1, d > 2},
                     .wall = 3});
    }
    all.push_back({.name = name + "_3d_plane_y", .kernel = kernel, .bodies = true, .mirror = {false, true, false}});
    all.push_back({.name = name + "_3d_planes_xz",
                   .kernel = kernel,
                   .lattice = true,
                   .bodies = true,
                   .mirror = {true, false, true},
                   .wall = 2});
  }
  // The loop that serves any kernel.
  for (const KernelName kernel : all_kernels) {
    const std::string name = with_kernel(kernel, [](auto k) { return k.name; });
    for (const SchemeName scheme : {SchemeName::monaghan, SchemeName::paper, SchemeName::monaghan_switch}) {
      if (scheme == SchemeName::monaghan && (kernel == KernelName::gaussian || kernel == KernelName::wendland_c2)) continue;
      const std::string in = std::string(scheme == SchemeName::paper      ? "paper_"
                                         : scheme == SchemeName::monaghan ? ""
                                                                          : "switch_") +
                             name;
      for (int d = 1; d <= 3; ++d)
        all.push_back({.name = in + "_any_" + std::to_string(d) + "d",
                       .dimension = d,
                       .kernel = kernel,
                       .bodies = true,
                       .mirror = {true, d > 1, d > 2},
                       .wall = 3,
                       .scheme = scheme});
    }
  }
  return all;
}

class PairLoop : public ::testing::TestWithParam<Case> {};

TEST_P(PairLoop, IsTheBruteForceSum) {
  const Sample sample = make(GetParam());
  const Result wanted = brute_force(sample, run(sample));
  ASSERT_GT(wanted.interactions, 0);
  for (const char* level : {"x86-64-v2", "x86-64-v3", "x86-64-v4"}) {
    SCOPED_TRACE(level);
    const AtLevel at(level);
    const Result got = run(sample);
    for (std::size_t i = 0; i < got.rates.size(); ++i) ASSERT_EQ(got.particles[i].x, wanted.particles[i].x);
    expect_same(got, wanted, tolerance_of(sample.kernel));
  }
}

INSTANTIATE_TEST_SUITE_P(, PairLoop, ::testing::ValuesIn(cases()), [](const auto& c) { return c.param.name; });

/// Levels that this machine has differ by round-off only; a machine without AVX-512 compares what it has.
TEST(PairLoops, InstructionSetsAgree) {
  Sample sample = make({"", 3, KernelName::wendland_c2, false, true, {true, true, false}, 3});
  const AtLevel best("x86-64-v4");
  const Result reference = run(sample);
  const Result sizes = brute_force(sample, reference);
  for (const char* level : {"x86-64-v3", "x86-64-v2"}) {
    SCOPED_TRACE(level);
    const AtLevel at(level);
    Result got = run(sample);
    for (std::size_t i = 0; i < got.rates.size(); ++i) ASSERT_EQ(got.particles[i].x, reference.particles[i].x);
    for (std::size_t i = 0; i < got.rates.size(); ++i) {
      const Rate &a = got.rates[i], &b = reference.rates[i], &size = sizes.rates[i];
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(a.a[k], b.a[k], 1e-12 * size.size[k]);
      ASSERT_NEAR(a.compression, b.compression, 1e-12 * size.compression_size);
      ASSERT_NEAR(a.heat, b.heat, 1e-12 * size.heat_size);
    }
    EXPECT_EQ(got.interactions, reference.interactions);
  }
}

/// Bit for bit: the order of every sum depends on the particles alone.
TEST(PairLoops, ThreadsDoNotChangeASum) {
  for (const auto& [name, scheme] : scheme_names) {
    SCOPED_TRACE(name);
    Dice dice(11);
    Sample sample;
    sample.scheme = scheme;
    sample.mirror[1] = true;
    const double dx = 0.03;
    for (const bool gas : {false, true}) {
      Set set{{}, gas, 2 * dx};
      for (int k = 0; k < 4000; ++k)
        set.particles.push_back(random_particle(dice, {dice.between(0, 0.5), dice.between(0, 0.9), dice.between(0, 0.8)}, 3,
                                                1.5 * dx, dx, 1000, 1e8, 1500));
      sample.sets.push_back(set);
    }
    for (int k = 0; k < 300; ++k) {
      const double x = dice.between(0, 0.5), y = dice.between(0, 0.9), z = dice.between(0.78, 0.84);
      sample.walls.push_back(wall_particle(Vec3(x, y, z), Vec3(1, 2, 3), Vec3(0, 0, 1), dx * dx * dx, double(k % 2)));
    }
    sample.threads = 1;
    const Result one = run(sample);
    for (const int threads : {2, 3, 4, 8}) {
      sample.threads = threads;
      const Result many = run(sample);
      EXPECT_EQ(many.interactions, one.interactions);
      for (std::size_t i = 0; i < one.rates.size(); ++i) {
        ASSERT_EQ(many.rates[i].a, one.rates[i].a) << i;
        ASSERT_EQ(many.rates[i].compression, one.rates[i].compression);
        ASSERT_EQ(many.rates[i].heat, one.rates[i].heat);
        ASSERT_EQ(many.rates[i].closing, one.rates[i].closing);
      }
      for (std::size_t k = 0; k < one.wall_forces.size(); ++k) ASSERT_EQ(many.wall_forces[k].a, one.wall_forces[k].a) << k;
    }
  }
}

/// In mixed precision the sums are those of the full one to single precision.
TEST_P(PairLoop, MixedPrecisionIsSinglePrecise) {
  Sample sample = make(GetParam());
  const Result wanted = brute_force(sample, run(sample));
  sample.precision = Precision::mixed;
  for (const char* level : {"x86-64-v2", "x86-64-v3", "x86-64-v4"}) {
    SCOPED_TRACE(level);
    const AtLevel at(level);
    Result got = run(sample);
    EXPECT_NEAR(double(got.interactions), double(wanted.interactions), 2e-4 * double(wanted.interactions) + 2);
    got.interactions = wanted.interactions;  // a neighbour on the support's edge may fall on either side
    expect_same(got, wanted, 2e-5);
  }
}

TEST(PairLoops, LevelIsWhatWasAskedFor) {
  {
    const AtLevel at("x86-64-v2");
    EXPECT_STREQ(cpu_level(), "x86-64-v2");
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    const AtLevel at("x86-64-v3");
    EXPECT_STREQ(cpu_level(), "x86-64-v3");
  }
}

struct Cloud {
  std::vector<Vec3> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t a) const { return points[i][Eigen::Index(a)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3>;

/// Neighbours counted by a k-d tree, in a cloud too large for brute force, with stray particles far off that stretch the
/// grid and a plane of symmetry.
TEST(PairLoops, CountsTheNeighboursOfAKdTree) {
  Dice dice(7);
  Sample sample;
  sample.mirror[0] = true;
  const double dx = 0.03, h = 1.5 * dx;
  Set set{{}, false, 2 * dx};
  for (int k = 0; k < 10000; ++k)
    set.particles.push_back(
        random_particle(dice, {dice.between(0, 0.7), dice.between(0, 0.5), dice.between(0, 0.6)}, 3, h, dx, 1000, 1e8, 1500));
  for (int k = 0; k < 5; ++k)
    set.particles.push_back(
        random_particle(dice, {dice.between(0, 3), dice.between(-3, 3), dice.between(-3, 3)}, 3, h, dx, 1000, 1e8, 1500));
  sample.sets.push_back(set);

  Cloud cloud;
  for (const Particle& q : set.particles) {
    cloud.points.push_back(place(q));
    cloud.points.push_back(place(mirrored(q, 1)));
  }
  Tree tree(3, cloud);
  tree.buildIndex();
  long long wanted = 0;
  for (const Particle& q : set.particles) {
    std::vector<std::pair<unsigned, double>> found;
    const double at[3] = {q.x, q.y, q.z};
    wanted += (long long)(tree.radiusSearch(at, 4 * h * h, found, nanoflann::SearchParams())) - 1;
  }
  for (const char* level : {"x86-64-v2", "x86-64-v3", "x86-64-v4"}) {
    const AtLevel at(level);
    EXPECT_EQ(run(sample).interactions, wanted) << level;
  }
}

}  // namespace
}  // namespace undex::sph::testing
