// What `undex check` says of a scene.
#include "run/describe.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "scenes.hpp"

namespace undex::run {
namespace {

TEST(Describe, SaysWhoseTemperatureDoesNotKnowOfShocks) {
  const auto text_of = [](const char* material) {
    return describe(test::read_text(test::plate_on_water, {{"structure.material", material}}));
  };
  const std::string linear = "note: 'plate': the pressure law of ";
  EXPECT_NE(text_of("\"armco-iron\"").find(linear + "armco-iron has no energy"), std::string::npos);
  EXPECT_EQ(text_of("\"al-2024-t351\"").find(linear), std::string::npos);
}

/// One coordinate has no need of a meridian, and its ends are called what they are.
TEST(Describe, SaysHowALineEnds) {
  const std::string text = describe(test::read_text(R"(end_time = 1e-6
dimension = "spherical"
[[bodies]]
name = "water"
shape = {type = "sphere", radius = 0.2}
material = "water-tait"
pressure = 1e5
[[walls]]
name = "far"
shape = {type = "sphere", radius = 0.2}
condition = "radiating"
)"));
  EXPECT_NE(text.find("outer end: radiating"), std::string::npos) << text;
  EXPECT_EQ(text.find("dimension=axisymmetric"), std::string::npos) << text;
}

/// What settling costs is part of what a run costs, and it is told on the way.
TEST(Describe, CountsTheSettlingOfAStart) {
  const scene::Scene scene = test::read_text(R"(end_time = 1e-6
dimension = "axisymmetric"
threads = 1
[resolution]
spacing = 0.006
[[bodies]]
name = "water"
shape = {type = "sphere", radius = 0.2}
material = "water-tait"
pressure = 1e5
[[walls]]
name = "tank"
shape = {type = "sphere", radius = 0.2}
)");
  int told = 0;
  const auto before = std::chrono::steady_clock::now();
  const Simulation settled(scene, [&](std::size_t moved, double unevenness) {
    ++told;
    EXPECT_GT(moved, 0u);
    EXPECT_GT(unevenness, 0.0);
  });
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  EXPECT_GT(told, 10);
  if (taken < 2) GTEST_SKIP() << "settles within " << taken << " s, which nobody need be told";
  EXPECT_NE(describe(scene).find(" s for the start"), std::string::npos);
}

}  // namespace
}  // namespace undex::run
