#include "study/run_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace undex::study {
namespace {

using output::Series;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// slope * t over 0..end, in steps of `step`.
Series ramp(double slope, double end, double step) {
  Series series;
  for (int i = 0; i * step <= end * (1 + 1e-12); ++i) series.append(i * step, slope * i * step);
  return series;
}

/// Displacements of 10, 11 and 8 m/s over 100 us, the last of 50 us only.
Quantity displacement() {
  return {.probe = "wall",
          .name = "radial displacement",
          .unit = "m",
          .runs = {ramp(10, 100e-6, 1e-6), ramp(11, 100e-6, 3e-6), ramp(8, 50e-6, 7e-6)},
          .reference = {}};
}

TEST(DifferenceNorms, OfTwoRampsOnDifferentTimes) {
  // The difference 0.1 t, of a peak of 1: mean 0.05, root mean square 0.1/sqrt(3).
  const output::Norms norms = output::difference_norms(ramp(1.1, 1, 0.25), ramp(1, 1, 0.01), 0, 1);
  EXPECT_NEAR(norms.l1, 0.05, 1e-12);
  EXPECT_NEAR(norms.l2, 0.1 / std::sqrt(3), 1e-12);
}

TEST(DifferenceNorms, ASignThatChangesWithinAStepIsIntegratedExactly) {
  // 2 t - 1 on one interval, of a peak of 2.
  const output::Norms norms = output::difference_norms({{0, 1}, {1, 3}}, {{0, 1}, {2, 2}}, 0, 1);
  EXPECT_NEAR(norms.l1, 0.5 / 2, 1e-15);
  EXPECT_NEAR(norms.l2, std::sqrt(1.0 / 3) / 2, 1e-15);
}

TEST(DifferenceNorms, AreUnknownWhereASeriesDoesNotReachOrTheBaseIsZero) {
  EXPECT_TRUE(std::isnan(difference_norms(ramp(1, 0.5, 0.1), ramp(1, 1, 0.1), 0, 1).l1));
  EXPECT_TRUE(std::isnan(output::difference_norms({}, ramp(1, 1, 0.1), 0, 1).l1));
  EXPECT_TRUE(std::isnan(difference_norms(ramp(1, 1, 0.1), ramp(0, 1, 0.1), 0, 1).l2));
  EXPECT_TRUE(std::isnan(difference_norms(ramp(1, 1, 0.1), ramp(1, 1, 0.1), 1, 1).l2));
}

TEST(RunComparison, ValuesAtTimesWithDifferencesFromTheFirst) {
  const ComparedBlock block = values_at(displacement(), {20e-6, 80e-6}, true);
  EXPECT_EQ(block.title, "wall: radial displacement");
  ASSERT_EQ(block.rows.size(), 3u);
  EXPECT_EQ(block.rows[0].label, "20 us");
  EXPECT_EQ(block.rows[0].unit, "mm");
  EXPECT_NEAR(block.rows[0].values[0], 0.20, 1e-9);
  EXPECT_TRUE(std::isnan(block.rows[0].from_first[0])) << "the first has no difference from itself";
  EXPECT_NEAR(block.rows[0].from_first[1], 10, 1e-6);
  EXPECT_NEAR(block.rows[0].from_first[2], -20, 1e-6);
  EXPECT_TRUE(std::isnan(block.rows[1].values[2])) << "beyond the end of the third run";
  EXPECT_TRUE(std::isnan(block.rows[1].from_first[2]));
  EXPECT_EQ(block.rows[2].label, "largest to 49 us") << "where the shortest run ends";
  EXPECT_NEAR(block.rows[2].values[0], 0.49, 1e-9);
}

TEST(RunComparison, DifferencesFromAReference) {
  Quantity quantity = displacement();
  quantity.reference = ramp(20, 60e-6, 1e-6);
  const ComparedBlock block = values_at(quantity, {20e-6, 80e-6}, false);
  EXPECT_NEAR(block.rows[0].reference, 0.4, 1e-9);
  EXPECT_NEAR(block.rows[0].from_reference[0], -50, 1e-6);
  EXPECT_NEAR(block.rows[0].from_reference[2], -60, 1e-6);
  EXPECT_TRUE(std::isnan(block.rows[1].reference));
  EXPECT_TRUE(std::isnan(block.rows[1].from_reference[0]));
}

TEST(RunComparison, NoPercentageOfNoise) {
  Quantity quantity{"p", "velocity", "m/s", {Series{{0, 1e-5, 2e-5}, {100, 0.5, 0}}, Series{{0, 1e-5, 2e-5}, {90, 5, 1}}}, {}};
  const ComparedBlock block = values_at(quantity, {0, 1e-5, 2e-5}, false);
  EXPECT_NEAR(block.rows[0].from_first[1], -10, 1e-9);
  EXPECT_TRUE(std::isnan(block.rows[1].from_first[1])) << "0.5 of 100";
  EXPECT_TRUE(std::isnan(block.rows[2].from_first[1]));
}

TEST(RunComparison, ARunWithoutTheQuantityIsADash) {
  Quantity quantity = displacement();
  quantity.runs[0] = {};
  EXPECT_EQ(quantity.count(), 2u);
  const std::vector<ComparedBlock> blocks{values_at(quantity, {20e-6}, true)};
  EXPECT_TRUE(std::isnan(blocks[0].rows[0].values[0]));
  EXPECT_TRUE(std::isnan(blocks[0].rows[0].from_first[1]));
  EXPECT_EQ(format_blocks(blocks, {"a", "b", "c"}),
            "\nwall: radial displacement [mm]   a       b       c\n"
            "  20 us                          -   0.220   0.160\n"
            "  largest to 49 us               -   0.539   0.392\n");
  EXPECT_TRUE(difference_norms({quantity}).rows.empty());
}

TEST(RunComparison, LargestMagnitudeKeepsItsSignAndTime) {
  const Quantity quantity{"p", "pressure", "Pa", {Series{{0, 1e-6, 2e-6}, {1e6, -3e6, 2e6}}, Series{{0, 2e-6}, {0, 3.3e6}}}, {}};
  const ComparedBlock block = largest_value(quantity);
  ASSERT_EQ(block.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(block.rows[0].values[0], -3);
  EXPECT_EQ(block.rows[0].unit, "MPa");
  EXPECT_DOUBLE_EQ(block.rows[1].values[1], 2);
  EXPECT_EQ(block.rows[1].unit, "us");
  EXPECT_DOUBLE_EQ(block.rows[1].from_first[1], 1) << "of times the difference itself";
}

TEST(RunComparison, NormsArePercentOfThePeak) {
  Quantity quantity = displacement();
  quantity.runs.pop_back();
  quantity.reference = ramp(10, 50e-6, 1e-6);
  const ComparedBlock block = difference_norms({quantity});
  ASSERT_EQ(block.rows.size(), 4u);
  EXPECT_EQ(block.rows[0].label, "wall: radial displacement, L1");
  EXPECT_TRUE(std::isnan(block.rows[0].values[0]));
  EXPECT_NEAR(block.rows[0].values[1], 5, 1e-6);
  EXPECT_NEAR(block.rows[1].values[1], 10 / std::sqrt(3), 1e-6);
  EXPECT_EQ(block.rows[2].label, "wall: radial displacement from the reference, L1");
  EXPECT_NEAR(block.rows[2].values[0], 0, 1e-9);
  EXPECT_NEAR(block.rows[2].values[1], 5, 1e-6);
}

TEST(RunComparison, RoundTimes) {
  EXPECT_TRUE(round_times(0, 0).empty());
  const std::vector<double> times = round_times(0, 150e-6);
  ASSERT_EQ(times.size(), 8u);
  EXPECT_NEAR(times[0], 20e-6, 1e-15);
  EXPECT_NEAR(times[6], 140e-6, 1e-15);
  EXPECT_NEAR(times[7], 150e-6, 1e-15) << "the end itself";
  const std::vector<double> even = round_times(0, 0.4);
  ASSERT_EQ(even.size(), 8u);
  EXPECT_NEAR(even.back(), 0.4, 1e-12);
}

TEST(RunComparison, TextWithReferenceAndUnitsPerRow) {
  ComparedBlock block{"cost", {compared("wall time", "s", {2, 3}), compared("steps", "", {1200, 2400}, 0, 1000)}};
  EXPECT_EQ(format_blocks({block}, {"coarse", "fine"}),
            "\ncost              coarse            fine                 reference\n"
            "  wall time [s]   2.000            3.000 +50.0%                  -\n"
            "  steps            1200 (+20.0%)    2400 +100% (+140%)        1000\n");
}

TEST(RunComparison, RunsThatDoNotFitFollowBelow) {
  const ComparedBlock block{"cost", {compared("wall time", "s", {1, 2, 3})}};
  const std::string text = format_blocks({block}, {"first run", "second run", "third run"}, 50);
  EXPECT_NE(text.find("first run"), std::string::npos);
  EXPECT_GT(text.find("third run"), text.find("wall time")) << text;
}

TEST(RunComparison, CsvHasEmptyCellsForWhatIsUnknown) {
  const ComparedBlock block{"energy: kinetic", {compared("20 us", "kJ", {2, nan})}};
  EXPECT_EQ(csv_header({"a", "b, c"}) + blocks_csv({block}),
            "quantity,at,unit,a,\"b, c\",reference,\"b, c from a [%]\",a from reference [%],\"b, c from reference [%]\"\n"
            "energy: kinetic,20 us,kJ,2,,,,,\n");
}

}  // namespace
}  // namespace undex::study
