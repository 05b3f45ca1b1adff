#include "study/run_settings.hpp"

#include <gtest/gtest.h>

namespace undex::study {
namespace {

std::optional<judge::Axis> axis_of(const std::string& text) { return read_resolved(text, "resolved.toml").axis; }

const std::string rod = "[structure]\nshape = {type = \"rod\", axis = \"y\", center = [1, 0, 2]}\n";

std::string listed(const std::string& type, const std::string& axis, const std::string& center = "[0, 0, 0]") {
  return "[[structures]]\nname = \"" + type + "\"\nshape = {type = \"" + type + "\", axis = \"" + axis +
         "\", center = " + center + "}\n";
}

TEST(RunSettings, AxisIsThatOfAllStructures) {
  EXPECT_EQ(axis_of(rod), (judge::Axis{.direction = 1, .center = Vec3(1, 0, 2)}));
  EXPECT_EQ(axis_of(listed("tube", "z") + listed("rod", "z")), judge::Axis{});
  EXPECT_EQ(axis_of(listed("tube", "z")), judge::Axis{});
  EXPECT_FALSE(axis_of(listed("tube", "z") + listed("rod", "x")));
  EXPECT_FALSE(axis_of(listed("tube", "z") + listed("rod", "z", "[1, 0, 0]")));
  EXPECT_FALSE(axis_of(listed("tube", "z") + "[[structures]]\nshape = {type = \"plate\"}\n"));
  EXPECT_FALSE(axis_of("[[structures]]\nshape = {type = \"plate\"}\n" + listed("tube", "z")));
  EXPECT_EQ(axis_of("[[solids]]\nshape = {type = \"tube\", axis = \"x\"}\n"), (judge::Axis{.direction = 0}));
}

TEST(RunSettings, StructuresGoByTheirNames) {
  const ResolvedScene scene = read_resolved("[[structures]]\nname = \"front\"\ncells = {x = 4, y = 5, z = 1}\n", "resolved.toml");
  const auto found = std::find(scene.settings.begin(), scene.settings.end(),
                               std::pair<std::string, std::string>("structures.front.cells", "4x5x1"));
  EXPECT_NE(found, scene.settings.end());
}

}  // namespace
}  // namespace undex::study
