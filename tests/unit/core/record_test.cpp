// Records: what a walk over a struct's parameters shows.
#include "core/record.hpp"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include "core/rigid_plane.hpp"
#include "core/shapes.hpp"

namespace undex::test {

enum class Colour { red, green };
constexpr auto words(Colour) { return std::to_array<Word<Colour>>({{"red", Colour::red}, {"green", Colour::green}}); }

struct Nested {
  double depth = 2;
};
struct Sample {
  double length = 1;
  Nested nested;
  Colour colour = Colour::green;
};
template <class Visit>
void describe(Sample& sample, Visit&& visit) {
  visit(sample.length, {.name = "length", .unit = "m", .range = Range::length()});
  visit(sample.nested.depth, {.name = "depth", .used = sample.length > 1});
  visit(sample.colour, {.name = "colour"});
  visit(ByHand{}, {.name = "other"});
}

namespace {

TEST(Record, IsWalkedInItsOrder) {
  std::string names;
  for_each_field(Sample{}, [&](const auto&, const Key& key) { names += std::string(key.name) + ' '; });
  EXPECT_EQ(names, "length depth colour other ");
}

TEST(Record, MembersCanBeChangedAndWhatCountsFollows) {
  Sample sample;
  bool used = true;
  for_each_field(sample, [&](auto&& member, const Key& key) {
    if constexpr (std::is_same_v<decltype(member), double&>) member = 5;
    if (std::string(key.name) == "depth") used = key.used;
  });
  EXPECT_EQ(sample.length, 5);
  EXPECT_EQ(sample.nested.depth, 5);
  EXPECT_TRUE(used) << "a key sees what those before it have read";
}

TEST(Record, MembersOfAConstantObjectAreConstant) {
  const Sample sample;
  for_each_field(sample,
                 [](auto&& member, const Key&) { EXPECT_TRUE(std::is_const_v<std::remove_reference_t<decltype(member)>>); });
}

TEST(Record, WordsOfAnEnumeration) {
  EXPECT_STREQ(word_of(Colour::red), "red");
  EXPECT_STREQ(word_of(Colour::green), "green");
  EXPECT_TRUE(Worded<Colour>);
  EXPECT_FALSE(Worded<double>);
}

TEST(Record, DescribedIsWhatHasADescription) {
  EXPECT_TRUE(Described<Sample>);
  EXPECT_TRUE(Described<RigidPlane>);
  EXPECT_TRUE(Described<TubeShape>);
  EXPECT_FALSE(Described<Nested>);
  EXPECT_FALSE(Described<double>);
}

TEST(Record, RangesHoldTheirEnds) {
  EXPECT_TRUE(Range::between(0, 1).holds(0) && Range::between(0, 1).holds(1));
  EXPECT_FALSE(Range::between(0, 1).holds(-1e-9) || Range::between(0, 1).holds(1.1));
  EXPECT_TRUE(Range::above(0).holds(1e-30) && !Range::above(0).holds(0));
  EXPECT_TRUE(Range{}.is_endless() && !Range::position().is_endless());
}

TEST(Record, MultiplesRoundUp) {
  EXPECT_EQ(Multiple{}.next(7), 7);
  EXPECT_EQ((Multiple{.of = 4}.next(5)), 8);
  EXPECT_EQ((Multiple{.of = 4}.next(8)), 8);
}

}  // namespace
}  // namespace undex::test
