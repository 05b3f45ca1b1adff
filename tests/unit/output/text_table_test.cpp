#include "output/text_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "output/terminal.hpp"

namespace undex::output {
namespace {

TEST(TextTable, CountsAreGroupedByThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(27288), "27,288");
  EXPECT_EQ(grouped(1754496), "1,754,496");
  EXPECT_EQ(grouped(-123), "-123");
  EXPECT_EQ(grouped(-123456), "-123,456");
}

TEST(TextTable, ValuesHaveThePrefixThatSuitsThem) {
  EXPECT_EQ(with_unit(0.0005, "m"), "0.5 mm");
  EXPECT_EQ(with_unit(0.001, "m"), "1 mm");
  EXPECT_EQ(with_unit(28.22e6, "Pa"), "28.22 MPa");
  EXPECT_EQ(with_unit(150e-6, "s"), "150 us");
  EXPECT_EQ(with_unit(-2.5e9, "Pa"), "-2.5 GPa");
  EXPECT_EQ(with_unit(999.96e-6, "m"), "1 mm");  // not 1000 um
  EXPECT_EQ(with_unit(0, "m"), "0 m");
  EXPECT_EQ(with_unit(3600, "s"), "3600 s");  // nobody counts in kiloseconds
  EXPECT_EQ(with_unit(std::nan(""), "Pa"), "nan Pa");
}

TEST(Terminal, ColoursAreForTerminalsOnly) {
  const std::string shown = inked("text", Ink::bad);
  EXPECT_EQ(shown == "text", !in_colour()) << shown;
  EXPECT_TRUE(on_terminal() || !in_colour());
}

}  // namespace
}  // namespace undex::output
