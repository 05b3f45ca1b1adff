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
    for (const int threads : {2, 3, 7}) {
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

// ---- The cells -----------------------------------------------------------------------------------------------------

struct Points {
  std::vector<double> x, y, z;
};

Points scatter(int n) {
  Dice dice(3);
  Points p;
  for (int k = 0; k < n; ++k) {
    p.x.push_back(dice.between(-1, 2));
    p.y.push_back(dice.between(5, 6));
    p.z.push_back(dice.between(0, 0.3));
  }
  return p;
}

void expect_sorted(const CellList& cells, const Points& p, std::uint32_t first, std::uint32_t last) {
  const CellGrid grid = cells.view();
  const std::set<std::uint32_t> distinct(cells.order().begin(), cells.order().end());
  ASSERT_EQ(cells.order().size(), last - first);
  ASSERT_EQ(distinct.size(), last - first);
  if (last > first) {
    ASSERT_EQ(*distinct.begin(), first);
    ASSERT_EQ(*distinct.rbegin(), last - 1);
  }
  const std::size_t count = std::size_t(grid.count[0]) * grid.count[1] * grid.count[2];
  ASSERT_EQ(grid.start[0], first);
  ASSERT_EQ(grid.start[count], last);
  for (std::size_t c = 0; c < count; ++c)
    for (std::uint32_t k = grid.start[c]; k < grid.start[c + 1]; ++k) {
      const std::uint32_t i = cells.order()[k - first];
      const double at[3] = {p.x[i], p.y[i], p.z[i]};
      const long cell[3] = {long(c % grid.count[0]), long(c / grid.count[0] % grid.count[1]),
                            long(c / grid.count[0] / grid.count[1])};
      for (int a = 0; a < 3; ++a) {
        ASSERT_GE(at[a], grid.low[a] + (cell[a] - 1e-9) * grid.size[a]);
        ASSERT_LE(at[a], grid.low[a] + (cell[a] + 1 + 1e-9) * grid.size[a]);
      }
    }
}

TEST(CellList, EveryParticleLiesInItsCell) {
  const Points p = scatter(20000);
  CellList cells;
  cells.build(p.x.data(), p.y.data(), p.z.data(), 100, 19000, 0.07);
  expect_sorted(cells, p, 100, 19000);
  // Rebuilt, smaller: nothing left of the first time.
  cells.build(p.x.data(), p.y.data(), p.z.data(), 5, 900, 0.03);
  expect_sorted(cells, p, 5, 900);
  cells.build(p.x.data(), p.y.data(), p.z.data(), 5, 5, 0.03);
  expect_sorted(cells, p, 5, 5);
}

TEST(CellList, OrderDoesNotDependOnThreads) {
  const Points p = scatter(20000);
  const int before = omp_get_max_threads();
  CellList one, three;
  omp_set_num_threads(1);
  one.build(p.x.data(), p.y.data(), p.z.data(), 0, 20000, 0.1);
  omp_set_num_threads(3);
  three.build(p.x.data(), p.y.data(), p.z.data(), 0, 20000, 0.1);
  omp_set_num_threads(before);
  EXPECT_EQ(one.order(), three.order());
}

/// With numbers the order is one of places and numbers alone, whatever it was before.
TEST(CellList, NumbersDecideWithinACell) {
  const std::uint32_t n = 5000;
  const Points p = scatter(n);
  Points turned = p;
  std::vector<std::uint32_t> number(n), number_turned(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    number[i] = (7 * i + 3) % n;
    const std::uint32_t k = n - 1 - i;
    turned.x[k] = p.x[i], turned.y[k] = p.y[i], turned.z[k] = p.z[i];
    number_turned[k] = number[i];
  }
  CellList cells, cells_turned;
  cells.build(p.x.data(), p.y.data(), p.z.data(), 0, n, 0.3, number.data());
  cells_turned.build(turned.x.data(), turned.y.data(), turned.z.data(), 0, n, 0.3, number_turned.data());
  expect_sorted(cells, p, 0, n);
  for (std::uint32_t k = 0; k < n; ++k) ASSERT_EQ(number[cells.order()[k]], number_turned[cells_turned.order()[k]]);
}

/// The runtime may give fewer threads than asked for (OMP_THREAD_LIMIT, a nested region): no particle may be lost.
TEST(CellList, FewerThreadsThanAskedForLoseNothing) {
  const Points p = scatter(20000);
  const int before = omp_get_max_threads();
  omp_set_num_threads(3);
  CellList cells;
#pragma omp parallel num_threads(2)
  {
#pragma omp single
    cells.build(p.x.data(), p.y.data(), p.z.data(), 0, 20000, 0.1);
  }
  omp_set_num_threads(before);
  expect_sorted(cells, p, 0, 20000);
}

/// A stray particle must cost neither memory nor correctness.
TEST(CellList, StrayParticlesDoNotCostMemory) {
  Points p = scatter(5000);
  p.x[17] = 1e9;
  p.z[4000] = -1e12;
  CellList cells;
  cells.build(p.x.data(), p.y.data(), p.z.data(), 0, 5000, 0.05);
  expect_sorted(cells, p, 0, 5000);
  EXPECT_LT(cells.memory_bytes(), 3e6);
}

TEST(CellList, RefusesPositionsThatAreNotFinite) {
  Points p = scatter(50);
  p.y[20] = std::nan("");
  CellList cells;
  EXPECT_THROW(cells.build(p.x.data(), p.y.data(), p.z.data(), 0, 50, 0.1), std::domain_error);
}

// ---- The blocks ----------------------------------------------------------------------------------------------------

/// Two groups of unlike cells, in blocks.
struct Blocks {
  Points points = scatter(3000);
  CellList cells[2];
  std::vector<GroupView> groups;
  BlockOrder order;
  PairInput in{};

  explicit Blocks(double reach, int threads = 1) {
    cells[0].build(points.x.data(), points.y.data(), points.z.data(), 0, 2000, 0.04);
    cells[1].build(points.x.data(), points.y.data(), points.z.data(), 2000, 3000, 0.05);
    groups = {{0, 2000, cells[0].view(), 0.04, false, false}, {2000, 3000, cells[1].view(), 0.05, true, true}};
    // Into the cells' order.
    Points sorted = points;
    for (int g = 0; g < 2; ++g)
      for (std::size_t k = 0; k < cells[g].order().size(); ++k) {
        const std::uint32_t from = cells[g].order()[k], to = groups[g].begin + std::uint32_t(k);
        sorted.x[to] = points.x[from];
        sorted.y[to] = points.y[from];
        sorted.z[to] = points.z[from];
      }
    points = sorted;
    order.build(groups, reach, threads);
    order.describe(in);
  }
};

TEST(Blocks, ClustersCoverEveryParticleOnce) {
  const Blocks b(0.2);
  std::vector<int> seen(3000, 0);
  std::uint32_t next = 0;
  for (std::uint32_t k = 0; k < b.in.blocks[b.in.block_count - 1].end; ++k) {
    const Cluster& cluster = b.in.clusters[k];
    const GroupView& group = b.groups[cluster.group];
    EXPECT_GE(cluster.count, 1);
    EXPECT_LE(cluster.count, cluster_size);
    EXPECT_GE(cluster.begin, group.begin);
    EXPECT_LE(cluster.begin + cluster.count, group.end);
    for (int l = 0; l < cluster.count; ++l) ++seen[cluster.begin + l];
    // None across the end of a row.
    for (std::size_t row = 0; row < std::size_t(group.grid.count[1]) * group.grid.count[2]; ++row) {
      const std::uint32_t end = group.grid.start[(row + 1) * group.grid.count[0]];
      EXPECT_FALSE(cluster.begin < end && cluster.begin + cluster.count > end);
    }
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
  for (std::uint32_t k = 0; k < b.in.block_count; ++k) {
    EXPECT_EQ(b.in.blocks[k].begin, next);
    next = b.in.blocks[k].end;
  }
}

/// Box of a block's particles.
Bounds box_of(const Blocks& b, std::uint32_t block) {
  Bounds box;
  for (std::uint32_t k = b.in.blocks[block].begin; k < b.in.blocks[block].end; ++k)
    for (std::uint32_t i = b.in.clusters[k].begin; i < b.in.clusters[k].begin + b.in.clusters[k].count; ++i)
      box.include(Vec3(b.points.x[i], b.points.y[i], b.points.z[i]));
  return box;
}

bool waits_for(const Blocks& b, std::uint32_t block, std::uint32_t other) {
  const std::uint32_t *first = b.in.waits + b.in.blocks[block].first_wait, *last = b.in.waits + b.in.blocks[block].last_wait;
  return std::find(first, last, other) != last;
}

/// Blocks that add to the same particles are done one after the other.
TEST(Blocks, ThoseThatShareAParticleWaitForEachOther) {
  const double reach = 0.03;
  const Blocks b(reach);
  ASSERT_GE(b.in.block_count, 20u);
  int apart = 0;
  for (std::uint32_t m = 0; m < b.in.block_count; ++m)
    for (std::uint32_t n = 0; n < m; ++n) {
      EXPECT_FALSE(waits_for(b, n, m)) << "a block waits for a later one";
      if (waits_for(b, m, n)) continue;
      ++apart;
      const Bounds one = box_of(b, m), other = box_of(b, n);
      const double gap = std::max((one.low - other.high).maxCoeff(), (other.low - one.high).maxCoeff());
      EXPECT_GT(gap, 2 * reach) << m << " " << n;
    }
  EXPECT_GT(apart, 20);
}

/// The sequence may differ, but not which of two blocks comes first.
TEST(Blocks, RanksDoNotDependOnThreads) {
  const Blocks one(0.05, 1), four(0.05, 4);
  ASSERT_EQ(one.in.block_count, four.in.block_count);
  const auto waits = [](const Blocks& b) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;  // blocks by their first particle
    const auto name = [&](std::uint32_t block) { return b.in.clusters[b.in.blocks[block].begin].begin; };
    for (std::uint32_t m = 0; m < b.in.block_count; ++m)
      for (std::uint32_t k = b.in.blocks[m].first_wait; k < b.in.blocks[m].last_wait; ++k)
        pairs.insert({name(m), name(b.in.waits[k])});
    return pairs;
  };
  EXPECT_EQ(waits(one), waits(four));
}

/// Bodies far apart: no more boxes than particles call for.
TEST(Blocks, FarApartTakesNoMemory) {
  Blocks b(0.05);
  for (const double far : {1e3, 1e9}) {
    for (double* low : {&b.groups[1].grid.low[0], &b.groups[1].grid.low[1], &b.groups[1].grid.low[2]}) *low += far;
    b.order.build(b.groups, 0.05, 1);
    EXPECT_LT(b.order.memory_bytes(), 1000000u);
    EXPECT_GE(b.order.block_count(), 2u);
  }
}

}  // namespace
}  // namespace undex::sph::testing
