// What `undex check` says of a scene.
#include "run/describe.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace undex::run
