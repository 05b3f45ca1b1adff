// What `undex check` says of a scene.
#include "run/describe.hpp"

#include <gtest/gtest.h>

#include <string>

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

/// A ball of water in a wall.
scene::Scene ball(const char* dimension, const char* spacing, const char* condition) {
  return test::read_text(std::string("end_time = 1e-6\nthreads = 1\ndimension = \"") + dimension +
                         "\"\n[resolution]\nspacing = " + spacing + R"(
[[bodies]]
name = "water"
shape = {type = "sphere", radius = 0.2}
material = "water-tait"
pressure = 1e5
[[walls]]
name = "far"
shape = {type = "sphere", radius = 0.2}
condition = ")" + condition +
                         "\"\n");
}

/// One coordinate has no need of a meridian, and its ends are called what they are.
TEST(Describe, SaysHowALineEnds) {
  const std::string text = describe(ball("spherical", "0.001", "radiating"));
  EXPECT_NE(text.find("outer end: radiating"), std::string::npos) << text;
  EXPECT_EQ(text.find("dimension=axisymmetric"), std::string::npos) << text;
}

/// What settling costs, seconds here, is part of what a run costs, and it is told on the way.
TEST(Describe, CountsTheSettlingOfAStart) {
  const scene::Scene scene = ball("axisymmetric", "0.006", "free_slip");
  Stages stages(/*quiet=*/false);
  testing::internal::CaptureStdout();
  const Simulation settled(scene, &stages);
  const std::string told = testing::internal::GetCapturedStdout();
  EXPECT_NE(told.find("settling"), std::string::npos) << told;
  EXPECT_NE(told.find("particles moved until they rest; pressure uneven by 0."), std::string::npos) << told;
  EXPECT_NE(describe(scene).find(" s for the start"), std::string::npos);
}

}  // namespace
}  // namespace undex::run
