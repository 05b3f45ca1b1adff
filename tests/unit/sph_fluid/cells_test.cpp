// Sorting into cells, and the blocks that loops work through: every particle once, and no two at the same sums.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "pair_sample.hpp"
#include "sph_fluid/pairs/blocks.hpp"
#include "sph_fluid/pairs/cell_list.hpp"

namespace undex::sph::testing {
namespace {

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
