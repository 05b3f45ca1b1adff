// Values that carry their unit.
#include "scene/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace undex::scene {
namespace {

TEST(Units, AreConvertedToFifteenDigits) {
  const auto value = [](const char* text, const char* unit) { return in_unit(text, unit).value.value_or(std::nan("")); };
  EXPECT_EQ(value("7 mm", "m"), 0.007);
  EXPECT_EQ(value("3g", "kg"), 0.003);
  EXPECT_EQ(value("2 GPa", "Pa"), 2e9);
  EXPECT_EQ(value("1.63 g/cm3", "kg/m^3"), 1630.0);
  EXPECT_EQ(value(" -0.25 Mbar ", "Pa"), -2.5e10);
  EXPECT_EQ(value("+1e2 us", "s"), 1e-4);
  EXPECT_EQ(value("6.93 mm/us", "m/s"), 6930.0);
  EXPECT_EQ(value("20 degC", "K"), 293.15);
  EXPECT_EQ(value("30 deg", "deg"), 30.0);
  EXPECT_NEAR(value("0.5 rad", "deg"), 90.0 / std::acos(-1.0), 1e-13);
  EXPECT_EQ(value("4 kJ/kg", "J/kg"), 4000.0);
  EXPECT_EQ(value("900 J/(kg K)", "J/kg/K"), 900.0);
  EXPECT_EQ(value("3 %", ""), 0.03);
}

TEST(Units, WhatIsWrongIsSaid) {
  const auto flaw = [](const std::string& text, const char* unit) {
    const Converted converted = in_unit(text, unit);
    EXPECT_FALSE(converted.value) << text;
    return converted.flaw;
  };
  EXPECT_EQ(flaw("7 mm", "s"), "is none in units of s");
  EXPECT_EQ(flaw("7 mm", ""), "has a unit, and the value is a pure number");
  EXPECT_EQ(flaw("7", "m"), "has no unit: write the number without quotes, or name its unit");
  EXPECT_EQ(flaw("7 furz", "m"), "has a unit that nobody knows, 'furz'; e.g. mm, g, us, GPa, g/cm3, m/s");
  EXPECT_EQ(flaw("mm", "m"), "must be a number in m, or a text that begins with a number");
  EXPECT_EQ(flaw("nan m", "m"), "must be a number in m, or a text that begins with a number");
  EXPECT_EQ(flaw("1e308 km", "m"), "is too large");
  EXPECT_EQ(flaw(std::string(1000, '7'), "m"), "must be a number in m");
  for (const char* odd :
       {"", " ", "+", "-", "1 m m", "1 m^", "1 (", "1 m^99999999999", "1 \xff", "1 lg(re 1 mW)", "1 s since 1970-01-01"})
    in_unit(odd, "m");  // whatever comes, nothing breaks
}

}  // namespace
}  // namespace undex::scene
