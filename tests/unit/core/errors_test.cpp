// What a user sees of a scene's mistakes.
#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace {

using undex::SceneError;

TEST(SceneErrorTest, OneLineEachInOrderOfTheFile) {
  const SceneError error("case.toml", {{{7, 1}, "second"}, {{2, 9}, "first, later column"}, {{2, 3}, "first"}});
  EXPECT_STREQ(error.what(), "case.toml:2:3: first\ncase.toml:2:9: first, later column\ncase.toml:7:1: second");
  EXPECT_EQ(error.file(), "case.toml");
  ASSERT_EQ(error.findings().size(), 3u);
  EXPECT_EQ(error.findings()[0].message, "first");
}

TEST(SceneErrorTest, NoPlaceIsNotPrinted) { EXPECT_STREQ(SceneError("a.toml", {{{}, "no body"}}).what(), "a.toml: no body"); }

TEST(SceneErrorTest, SameLineAndColumnKeepTheirOrder) {
  EXPECT_STREQ(SceneError("f", {{{1, 1}, "x"}, {{1, 1}, "a"}}).what(), "f:1:1: x\nf:1:1: a");
}

}  // namespace
