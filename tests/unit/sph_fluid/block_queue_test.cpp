// Handing blocks to threads: each once, each after those that it waits for, whatever the threads' number and pace.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

#include "core/vector.hpp"
#include "sph_fluid/pairs/block_queue.hpp"
#include "sph_fluid/pairs/blocks.hpp"
#include "sph_fluid/pairs/cell_list.hpp"

namespace undex::sph::testing {
namespace {

/// A cloud of particles in blocks for that many threads, and the particles within reach of each block's.
struct Cloud {
  std::vector<Vec3> places;  // in the cells' order
  CellList cells;
  BlockOrder order;
  PairInput in{};
  std::vector<GroupView> groups;
  std::vector<std::vector<std::uint32_t>> touched;

  Cloud(const std::vector<Vec3>& given, double reach, int threads) {
    std::vector<double> x, y, z;
    for (const Vec3& place : given) x.push_back(place[0]), y.push_back(place[1]), z.push_back(place[2]);
    const std::uint32_t n = std::uint32_t(given.size());
    cells.build(x.data(), y.data(), z.data(), 0, n, 2.0 * reach / 3.0);
    for (const std::uint32_t k : cells.order()) places.push_back(given[k]);
    groups = {{0, n, cells.view(), reach, false, false}};
    divide(reach, threads);
  }

  void divide(double reach, int threads) {
    order.build(groups, reach, threads);
    order.describe(in);
    touched.assign(in.block_count, {});
    for (std::uint32_t b = 0; b < in.block_count; ++b) {
      Bounds box;
      for (std::uint32_t k = in.blocks[b].begin; k < in.blocks[b].end; ++k)
        for (int l = 0; l < in.clusters[k].count; ++l) box.include(places[in.clusters[k].begin + l]);
      for (std::uint32_t i = 0; i < places.size(); ++i)
        if (((places[i] - box.low).array() > -reach).all() && ((places[i] - box.high).array() < reach).all())
          touched[b].push_back(i);
    }
  }
};

std::vector<Vec3> lattice(int nx, int ny, int nz, const Vec3& low = Vec3::Zero()) {
  std::vector<Vec3> places;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) places.push_back(low + Vec3(i, j, k));
  return places;
}

struct Case {
  const char* name;
  std::vector<Vec3> places;
};

std::vector<Case> cases() {
  std::vector<Case> all = {{"cube", lattice(70, 30, 30)}, {"plane", lattice(200, 150, 1)},
                           {"row", lattice(300, 1, 1)},   {"one particle", lattice(1, 1, 1)},
                           {"blocks of one cell", {}},    {"empty layers between", lattice(30, 24, 24)}};
  for (int k = 0; k < 600; ++k) all[4].places.push_back({k % 10 * 40.0, k / 10 % 10 * 9.0, k / 100 * 9.0});
  for (const Vec3& place : lattice(30, 24, 24, {500, 3, 0})) all[5].places.push_back(place);
  return all;
}

/// Sums as a pass makes them: a block adds to its own particles and, where blocks wait for each other, to all within reach.
/// Rounding shows the order.
std::vector<float> sums_of(const Cloud& cloud, Turns turns, int team, unsigned seed) {
  const PairInput& in = cloud.in;
  const auto first_particle = [&](std::uint32_t b) { return in.clusters[in.blocks[b].begin].begin; };
  std::vector<float> sums(cloud.places.size(), 0.0f);
  std::vector<std::atomic<int>> times(in.block_count), done(in.block_count);
  std::atomic<bool> too_early = false;
  start(*in.queue, turns);
#pragma omp parallel num_threads(team)
  {
    std::mt19937 dice(seed + unsigned(omp_get_thread_num()));
    for (std::uint32_t b; (b = take(*in.queue, omp_get_thread_num())) < in.block_count;) {
      ++times[b];
      if (turns == Turns::in_order)
        for (std::uint32_t k = in.blocks[b].first_wait; k < in.blocks[b].last_wait; ++k)
          if (!done[in.waits[k]].load()) too_early = true;
      if (seed > 0 && dice() % 4 == 0) std::this_thread::sleep_for(std::chrono::microseconds(dice() % 300));
      const float given = std::sqrt(float(first_particle(b)) + 0.3f);
      if (turns == Turns::any) sums[first_particle(b)] += given;
      else
        for (const std::uint32_t i : cloud.touched[b]) sums[i] += given;
      done[b] = 1;
      finish(*in.queue, b);
    }
  }
  EXPECT_FALSE(too_early);
  for (const auto& count : times) EXPECT_EQ(count.load(), 1);
  return sums;
}

TEST(BlockQueue, SumsDependNeitherOnThreadsNorOnTheirPace) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(each.name);
    for (const Turns turns : {Turns::in_order, Turns::any}) {
      const Cloud alone(each.places, 3.0, 1);
      const std::vector<float> wanted = sums_of(alone, turns, 1, 0);
      for (const int threads : {1, 2, 3, 4, 8, 17}) {
        const Cloud cloud(each.places, 3.0, threads);
        for (const unsigned seed : {0u, 1u, 2u})
          EXPECT_TRUE(sums_of(cloud, turns, threads, seed) == wanted) << threads << " threads, " << seed;
      }
    }
  }
}

/// The runtime may give other threads than were asked for.
TEST(BlockQueue, ATeamOfAnotherSizeDoesAllBlocks) {
  const std::vector<Vec3> places = lattice(70, 30, 30);
  const Cloud alone(places, 3.0, 1);
  const std::vector<float> wanted = sums_of(alone, Turns::in_order, 1, 0);
  for (const auto& [shares, team] : {std::pair(8, 1), {8, 3}, {2, 5}}) {
    const Cloud cloud(places, 3.0, shares);
    EXPECT_TRUE(sums_of(cloud, Turns::in_order, team, 1) == wanted) << shares << " shares, " << team << " threads";
  }
}

/// The same queue serves pass after pass, and another build.
TEST(BlockQueue, IsUsedAgain) {
  Cloud cloud(lattice(70, 30, 30), 3.0, 2);
  const std::vector<float> first = sums_of(cloud, Turns::in_order, 2, 0);
  EXPECT_TRUE(sums_of(cloud, Turns::in_order, 2, 3) == first);
  for (const int threads : {3, 1, 4}) {
    cloud.divide(3.0, threads);
    EXPECT_TRUE(sums_of(cloud, Turns::in_order, threads, 5) == first) << threads;
  }
}

/// Nothing to do is no loop without end.
TEST(BlockQueue, WithoutBlocksThereIsNothingToTake) {
  BlockOrder order;
  PairInput in{};
  order.build({}, 1.0, 3);
  order.describe(in);
  EXPECT_EQ(in.block_count, 0u);
  start(*in.queue, Turns::in_order);
  for (int t = 0; t < 3; ++t) EXPECT_EQ(take(*in.queue, t), 0u);
}

/// Where each block waits for the one before, only one thread has work: the others sleep. A chain is a row of particles.
TEST(BlockQueue, WhoWaitsSleeps) {
  Cloud cloud(lattice(1000, 1, 1), 3.0, 8);
  const PairInput& in = cloud.in;
  ASSERT_GT(in.block_count, 20u);
  start(*in.queue, Turns::in_order);
  const std::clock_t before = std::clock();  // CPU time of all threads
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::thread> threads;
  std::atomic<std::uint32_t> done = 0;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (std::uint32_t b; (b = take(*in.queue, t)) < in.block_count; ++done) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        finish(*in.queue, b);
      }
    });
  for (std::thread& thread : threads) thread.join();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(done, in.block_count);
  EXPECT_GE(wall, 0.01 * in.block_count);
  EXPECT_LT(double(std::clock() - before) / CLOCKS_PER_SEC, 0.2 * wall);
}

/// Each of two threads has about half of the clusters of a layer, and few blocks wait across the seam.
TEST(BlockQueue, SharesAreEvenAndCompact) {
  const Cloud cloud(lattice(60, 80, 80), 3.0, 2);
  const PairInput& in = cloud.in;
  // The second share begins where the place of blocks falls back to the first layer.
  const auto x_of = [&](std::uint32_t b) { return cloud.places[in.clusters[in.blocks[b].begin].begin][0]; };
  std::uint32_t seam = 1;
  while (seam < in.block_count && !(x_of(seam) < x_of(seam - 1) - 20.0)) ++seam;
  ASSERT_LT(seam, in.block_count);
  const auto clusters = [&](std::uint32_t first, std::uint32_t last) { return in.blocks[last - 1].end - in.blocks[first].begin; };
  const double first = clusters(0, seam), second = clusters(seam, in.block_count);
  EXPECT_NEAR(first / (first + second), 0.5, 0.07);
  std::uint32_t across = 0, waits = 0;
  for (std::uint32_t b = 0; b < in.block_count; ++b)
    for (std::uint32_t k = in.blocks[b].first_wait; k < in.blocks[b].last_wait; ++k) {
      ++waits;
      across += (b < seam) != (in.waits[k] < seam);
    }
  EXPECT_LT(across, waits / 6);
}

}  // namespace
}  // namespace undex::sph::testing
