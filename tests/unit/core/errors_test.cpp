// What a user sees of a scene's mistakes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

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

TEST(SceneErrorTest, SaysAsMuchAsSomebodyReads) {
  std::vector<undex::Finding> many;
  for (int line = 600000; line > 0; --line) many.push_back({{line, 1}, "unknown key"});
  const std::string text = SceneError("a.toml", many).what();
  EXPECT_TRUE(text.starts_with("a.toml:1:1: unknown key\na.toml:2:1: unknown key\n")) << text.substr(0, 100);
  EXPECT_NE(text.find("\na.toml:100:1: unknown key\na.toml: and 599900 more; mend these first"), std::string::npos);
  EXPECT_LT(text.size(), 10000u);
  EXPECT_LT(std::string(SceneError("a.toml", {{{1, 1}, std::string(1 << 20, 'x')}}).what()).size(), 3000u);
}

TEST(SceneErrorTest, SameLineAndColumnKeepTheirOrder) {
  EXPECT_STREQ(SceneError("f", {{{1, 1}, "x"}, {{1, 1}, "a"}}).what(), "f:1:1: x\nf:1:1: a");
}

}  // namespace
