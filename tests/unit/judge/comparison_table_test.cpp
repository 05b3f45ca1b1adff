#include "judge/comparison_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "tests/unit/output/temporary_folder.hpp"

namespace undex::judge {
namespace {

using namespace output;

ReferenceTable read(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "t.csv") << text;
  return read_reference_table(folder.path / "t.csv");
}

const char* const good =
    "# comment\n"
    "metric,label,unit,scale,converged,paper\n"
    "arrival_s,arrival,us,1e6,14.40+-0.05,\n"
    "first_peak_pa,first peak,GPa,1e-9,0.8,0.66\n"
    "displacement_300us_m,not reached,mm,1e3,5,5\n";

TEST(ComparisonTable, ReadsValuesUncertaintiesAndBlanks) {
  const ReferenceTable table = read(good);
  EXPECT_EQ(table.sources, (std::vector<std::string>{"converged", "paper"}));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_DOUBLE_EQ(table.rows[0].values[0].value, 14.40);
  EXPECT_DOUBLE_EQ(table.rows[0].values[0].uncertainty, 0.05);
  EXPECT_TRUE(std::isnan(table.rows[0].values[1].value));
  EXPECT_DOUBLE_EQ(table.rows[1].scale, 1e-9);
}

TEST(ComparisonTable, PrintsDifferencesPerSource) {
  const std::string text = format_comparison({{"first_peak_pa", 0.72e9}, {"arrival_s", 14.65e-6}}, read(good));
  EXPECT_EQ(text,
            "                   this run           converged         paper\n"
            "-------------------------------------------------------------\n"
            "arrival [us]          14.65   14.40±0.05  +0.25       -\n"
            "first peak [GPa]      0.720        0.800 -10.0%   0.660 +9.1%\n")
      << text;
}

TEST(ComparisonTable, SourcesThatDoNotFitFollowBelow) {
  // A row of which the further block knows nothing is not repeated there.
  const std::string text = format_comparison({{"arrival_s", 14e-6}, {"first_peak_pa", 0.72e9}}, read(good), 50);
  EXPECT_EQ(text,
            "                   this run           converged\n"
            "-----------------------------------------------\n"
            "arrival [us]          14.00   14.40±0.05  -0.40\n"
            "first peak [GPa]      0.720        0.800 -10.0%\n"
            "\n"
            "                   this run         paper\n"
            "-----------------------------------------\n"
            "first peak [GPa]      0.720   0.660 +9.1%\n");
}

TEST(ComparisonTable, WhatDidNotHappenIsADash) {
  const std::string text = format_comparison({{"arrival_s", std::nan("")}}, read(good));
  EXPECT_NE(text.find("arrival [us]          -"), std::string::npos) << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(ComparisonTable, BadFilesAreReportedWithTheirLine) {
  const auto message = [](const std::string& text) { return message_of<FileError>([&] { read(text); }); };
  EXPECT_NE(message("metric,label\n").find(":1: the header"), std::string::npos);
  EXPECT_NE(message("").find("no header"), std::string::npos);
  EXPECT_NE(message("metric,label,unit,scale,a\nx,x,s,1\n").find(":2: 4 cells"), std::string::npos);
  EXPECT_NE(message("metric,label,unit,scale,a\nx,x,s,1,abc\n").find("'abc'"), std::string::npos);
  EXPECT_NE(message("metric,label,unit,scale,a\nx,x,s,big,1\n").find("'big'"), std::string::npos);
  EXPECT_THROW(read_reference_table("/nowhere/t.csv"), FileError);
}

}  // namespace
}  // namespace undex::judge
