// What is done with particles is done with all of their arrays.
#include "sph_fluid/pairs/large_pages.hpp"
#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/walls/particles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace undex::sph {
namespace {

constexpr std::size_t count = 6;

/// Every array there, all bytes of its entry i being i + 1.
Particles filled() {
  Particles p;
  p.resize(count, true);
  for_each_array(p, [](Role, auto& array) {
    array.resize(count);
    for (std::size_t i = 0; i < count; ++i) std::memset(static_cast<void*>(&array[i]), int(i + 1), sizeof array[i]);
  });
  return p;
}

/// The number that fills entry i, or 0 where it is not filled by one.
template <class T>
int filling(const std::vector<T>& array, std::size_t i) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(&array[i]);
  for (std::size_t k = 1; k < sizeof(T); ++k)
    if (bytes[k] != bytes[0]) return 0;
  return bytes[0];
}

TEST(Particles, SortingTakesAllArraysAlong) {
  Particles p = filled();
  p.permute(1, {3, 1, 4, 2});
  const int wanted[count] = {1, 4, 2, 5, 3, 6};
  for_each_array(p, [&](Role role, auto& array) {
    if (role == Role::scratch) return;
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(filling(array, i), wanted[i]) << int(role);
  });
  // Whatever roles the list gives them, these outlast an evaluation.
  for (const int found : {filling(p.mass, 1), filling(p.id, 1), filling(p.rate, 1), filling(p.earlier, 1), filling(p.other, 1),
                          filling(p.place, 1)})
    EXPECT_EQ(found, wanted[1]);
}

TEST(Particles, AStepThatIsNotTakenGivesTheStateBack) {
  Particles p = filled();
  p.keep_start();
  for_each_array(
      state_arrays, [](Role, auto& array) { std::memset(static_cast<void*>(array.data()), 0, sizeof array[0] * count); }, p);
  p.restore_start();
  for_each_array(
      state_arrays,
      [](Role, auto& array) {
        for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(filling(array, i), int(i + 1));
      },
      p);
}

TEST(Particles, APartGoesAndComesBack) {
  Particles whole = filled(), part;
  part.place = {4, 1};
  part.gather(whole);
  for_each_array(part, [](Role role, auto& array) {
    if (role == Role::start || role == Role::index) return;
    ASSERT_EQ(array.size(), 2u) << int(role);
    EXPECT_EQ(filling(array, 0), 5) << int(role);
    EXPECT_EQ(filling(array, 1), 2) << int(role);
  });
  std::swap(part.x[0], part.x[1]);
  part.scatter(whole);
  EXPECT_EQ(filling(whole.x, 4), 2);
  EXPECT_EQ(filling(whole.x, 1), 5);
  EXPECT_EQ(filling(whole.y, 4), 5);
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(filling(whole.other, i), int(i + 1));
}

/// Places and velocities, now and at the step's start, and all rates.
TEST(Particles, EveryVectorIsReflected) {
  Particles p = filled();
  int places = 0, velocities = 0, others = 0;
  for_each_vector(p, 2, [&](Vector kind, auto& a, auto&, auto&) {
    (kind == Vector::place ? places : kind == Vector::velocity ? velocities : others) += 1;
    a = 0;
  });
  EXPECT_EQ(places, 2);
  EXPECT_EQ(velocities, 2);
  EXPECT_EQ(others, 4);
  EXPECT_EQ(p.x[2], 0.0);
  EXPECT_EQ(p.start.vx[2], 0.0);
  EXPECT_EQ(p.other[2].earlier.ax, 0.0f);
  EXPECT_EQ(filling(p.x, 1), 2);
}

/// Wherever an array begins and however long it is, asking changes nothing that can be read.
TEST(LargePages, AreAWish) {
  std::vector<unsigned char> bytes(3 * large_page + 12345, 7);
  for (const std::size_t begin : {std::size_t(0), std::size_t(1), large_page - 3})
    for (const std::size_t length : {std::size_t(0), std::size_t(100), large_page, 2 * large_page + 1})
      ask_for_large_pages(bytes.data() + begin, length);
  ask_for_large_pages(nullptr, 0);
  EXPECT_TRUE(std::all_of(bytes.begin(), bytes.end(), [](unsigned char byte) { return byte == 7; }));
  SingleRows rows;
  for (const std::size_t particles : {10u, 200000u, 300000u}) {
    grow(rows, particles, 16, 8);
    std::fill_n(rows.main, 16 * particles, 1.0f);
    std::fill_n(rows.tail, 8 * particles, 2.0f);
    for (std::int32_t* place : rows.place) std::fill_n(place, particles + 16, 3);
    EXPECT_EQ(rows.main[16 * particles - 1], 1.0f);
  }
  release(rows);
}

}  // namespace
}  // namespace undex::sph
