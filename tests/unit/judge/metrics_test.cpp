// Metrics of made-up histories and shapes, and of the references that scenes are compared with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "judge/comparison_table.hpp"
#include "judge/rigid_cylinder.hpp"
#include "judge/taylor_bar.hpp"
#include "judge/tube.hpp"

namespace undex::judge {
namespace {

using namespace output;

const std::filesystem::path cases = UNDEX_CASES;

double get(const NamedNumbers& numbers, const std::string& name) {
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const auto& n) { return n.first == name; });
  if (found == numbers.end()) throw std::runtime_error("no metric " + name);
  return found->second;
}
bool has(const NamedNumbers& numbers, const std::string& name) {
  return std::any_of(numbers.begin(), numbers.end(), [&](const auto& n) { return n.first == name; });
}

Series reference_pressure(const std::string& column = "pressure at 0.25 mm") {
  for (const HistoryColumn& found : read_history(cases / "rigid_cylinder/reference/midline_wall_pressure.csv"))
    if (found.name == column) return found.series;
  throw std::runtime_error("no column " + column);
}

// Every value of the table's "converged" column, from the very history that it was made of.
TEST(RigidCylinderMetrics, ReferenceHistoryGivesTheConvergedTable) {
  const NamedNumbers metrics = rigid_cylinder_metrics(reference_pressure());
  const ReferenceTable table = read_reference_table(cases / "rigid_cylinder/reference/metrics.csv");
  ASSERT_EQ(table.sources.front(), "converged");
  EXPECT_EQ(table.rows.size(), metrics.size());
  for (const auto& row : table.rows) {
    const auto [value, stated] = row.values.front();
    // Half of the last printed digit comes on top; where no uncertainty is stated 1 % stands for it.
    const double tolerance = (std::isnan(stated) ? 0.01 * value : stated) + (row.unit == "us" ? 0.05 : 0.0005);
    EXPECT_NEAR(get(metrics, row.metric) * row.scale, value, tolerance) << row.metric;
  }
}

TEST(RigidCylinderMetrics, CoarserReferenceGridDiffersLittle) {
  const NamedNumbers metrics = rigid_cylinder_metrics(reference_pressure("pressure at 0.5 mm"), reference_pressure());
  EXPECT_NEAR(get(metrics, "l1_0_95us"), 0.0027, 0.0003);
  EXPECT_NEAR(get(metrics, "second_cavitation_s"), 112.0e-6, 0.1e-6);
  EXPECT_DOUBLE_EQ(get(rigid_cylinder_metrics(reference_pressure(), reference_pressure()), "l1_0_95us"), 0);
}

// Triangles: 0 to 400 MPa over 10..20 us, back to 0 at 40 us; 0 until 95; up to 300 MPa at 97, down to 0 at 107 us.
Series triangles() { return {{0, 10e-6, 20e-6, 40e-6, 95e-6, 97e-6, 107e-6, 125e-6}, {0, 0, 400e6, 0, 0, 300e6, 0, 0}}; }

TEST(RigidCylinderMetrics, TrianglesGiveTheirExactAnswers) {
  const NamedNumbers metrics = rigid_cylinder_metrics(triangles());
  EXPECT_NEAR(get(metrics, "arrival_s"), 15e-6, 1e-12);
  EXPECT_DOUBLE_EQ(get(metrics, "first_peak_pa"), 400e6);
  EXPECT_DOUBLE_EQ(get(metrics, "first_peak_time_s"), 20e-6);
  EXPECT_NEAR(get(metrics, "impulse_0_45us_pa_s"), 6000, 1e-6);
  // Best window of 5 us: a above the peak's left and b right of it with equal ends, 40a = 20b, a + b = 5.
  EXPECT_NEAR(get(metrics, "first_peak_5us_pa"), 400e6 - 0.5 * (5.0 / 3) * 40e6, 1e4);
  EXPECT_NEAR(get(metrics, "cavitation_s"), 40e-6, 1e-12);
  EXPECT_NEAR(get(metrics, "collapse_s"), 95e-6 + 2e-6 / 3, 1e-12);
  EXPECT_DOUBLE_EQ(get(metrics, "second_peak_time_s"), 97e-6);
  EXPECT_NEAR(get(metrics, "impulse_85_112us_pa_s"), 1800, 1e-6);
  EXPECT_NEAR(get(metrics, "second_cavitation_s"), 107e-6, 1e-12);
}

TEST(RigidCylinderMetrics, WhatDidNotHappenIsNaN) {
  const NamedNumbers quiet = rigid_cylinder_metrics({{0, 125e-6}, {1e5, 1e5}});
  for (const auto& [name, value] : quiet) {
    if (!name.starts_with("impulse")) {
      EXPECT_TRUE(std::isnan(value)) << name;
    }
  }
  for (const Series& series : {Series{}, Series{{0}, {1e5}}, Series{{0, 1e-6}, {1e5, 1e5}}})
    for (const auto& [name, value] : rigid_cylinder_metrics(series)) EXPECT_TRUE(std::isnan(value)) << name;
}

TEST(RigidCylinderMetrics, ShortRunsTellOnlyWhatTheySaw) {
  Series series = triangles();
  series.t = {0, 10e-6, 18e-6};
  series.y = {0, 0, 320e6};
  EXPECT_TRUE(std::isnan(get(rigid_cylinder_metrics(series), "first_peak_pa"))) << "still rising: not a peak";
  series.append(20e-6, 400e6);
  series.append(35e-6, 100e6);
  const NamedNumbers metrics = rigid_cylinder_metrics(series);
  EXPECT_DOUBLE_EQ(get(metrics, "first_peak_pa"), 400e6);
  for (const char* name : {"impulse_0_45us_pa_s", "cavitation_s", "collapse_s", "second_peak_time_s", "second_peak_5us_pa",
                           "impulse_85_112us_pa_s", "second_cavitation_s"})
    EXPECT_TRUE(std::isnan(get(metrics, name))) << name;
  EXPECT_TRUE(std::isnan(get(rigid_cylinder_metrics(series, reference_pressure()), "l1_0_95us")));
}

TEST(RigidCylinderMetrics, BadSeriesIsOurDefect) { EXPECT_THROW(rigid_cylinder_metrics({{0, 1}, {0}}), std::invalid_argument); }

// A wall that accelerates at 1e7 m/s^2 over 16..26 us, then slows to 20 m/s at 90 us, is kicked to 40 m/s at 100 us.
TubeHistories tube() {
  TubeHistories histories;
  histories.velocity = {{0, 16e-6, 26e-6, 90e-6, 100e-6, 160e-6}, {0, 0, 100, 20, 40, 0}};
  for (int i = 0; i <= 160; ++i) histories.displacement.append(i * 1e-6, i * 1e-5);
  histories.pressure = {{0, 14e-6, 18e-6, 28e-6, 30e-6, 32e-6, 160e-6}, {0, 0, 500e6, 0, 0, 50e6, 50e6}};
  return histories;
}

TEST(TubeMetrics, KnownHistoriesGiveTheirAnswers) {
  const NamedNumbers metrics = tube_metrics(tube());
  EXPECT_NEAR(get(metrics, "displacement_20us_m"), 2e-4, 1e-12);
  EXPECT_NEAR(get(metrics, "displacement_150us_m"), 1.5e-3, 1e-12);
  EXPECT_FALSE(has(metrics, "displacement_200us_m")) << "the run ended before";
  EXPECT_NEAR(get(metrics, "wall_velocity_20us_m_s"), 40, 1e-9);
  EXPECT_NEAR(get(metrics, "motion_start_s"), 16.1e-6, 1e-12);
  EXPECT_DOUBLE_EQ(get(metrics, "peak_wall_velocity_m_s"), 100);
  EXPECT_DOUBLE_EQ(get(metrics, "peak_wall_velocity_time_s"), 26e-6);
  EXPECT_DOUBLE_EQ(get(metrics, "reload_start_s"), 90e-6);
  EXPECT_DOUBLE_EQ(get(metrics, "reload_end_s"), 100e-6);
  EXPECT_DOUBLE_EQ(get(metrics, "reload_gain_m_s"), 20);
  EXPECT_NEAR(get(metrics, "arrival_s"), 16e-6, 1e-12);
  EXPECT_DOUBLE_EQ(get(metrics, "peak_pressure_pa"), 500e6);
  EXPECT_NEAR(get(metrics, "impulse_0_30us_pa_s"), 3500, 1e-6);
  EXPECT_NEAR(get(metrics, "cavitation_s"), 28e-6, 1e-12);
  EXPECT_NEAR(get(metrics, "closure_s"), 30.2e-6, 1e-12);
}

TEST(TubeMetrics, EmptyAndShortHistories) {
  EXPECT_TRUE(tube_metrics({}).empty());
  TubeHistories histories;
  histories.velocity = {{0, 10e-6, 12e-6}, {0, 0, 20}};
  histories.pressure = {{0, 10e-6}, {0, 0}};
  for (const auto& [name, value] : tube_metrics(histories)) {
    if (name != "motion_start_s") {
      EXPECT_TRUE(std::isnan(value)) << name;
    }
  }
}

TEST(TubeMetrics, EveryRowOfTheReferenceIsAMetric) {
  TubeHistories histories = tube();
  for (Series* series : {&histories.displacement, &histories.velocity, &histories.pressure})
    series->append(300e-6, series->y.back());
  histories.plastic_strain = {{0, 300e-6}, {0, 0.1}};
  const NamedNumbers metrics = tube_metrics(histories);
  for (const auto& row : read_reference_table(cases / "al_tube_fem/reference/displacement.csv").rows)
    EXPECT_TRUE(has(metrics, row.metric)) << row.metric;
}

TEST(TaylorBarMetrics, ShapeOfACloudOfPoints) {
  // A cone-shaped foot on a straight shank, about an axis off the origin, standing at x = 2: radius 5 - h to h = 3, then 2.
  const double length = 20.0;
  std::vector<Vec3> points;
  for (int layer = 0; layer <= 36; ++layer)
    for (int ring = 0; ring <= 4; ++ring)
      for (int turn = 0; turn < 16; ++turn) {
        const double height = 0.5 * layer, radius = 0.25 * ring * std::max(2.0, 5.0 - height);
        points.emplace_back(2.0 + height, 1.0 + radius * std::cos(0.125 * M_PI * turn),
                            -1.0 + radius * std::sin(0.125 * M_PI * turn));
      }
  const auto value = [&](const std::vector<Vec3>& cloud, double initial, const char* name, double skin = 0.0) {
    for (const auto& [key, number] : taylor_bar_metrics(cloud, 0, Vec3(0, 1, -1), initial, skin))
      if (key == name) return number;
    return -1.0;
  };
  EXPECT_NEAR(value(points, length, "final_length_m"), 18.0, 1e-12);
  EXPECT_NEAR(value(points, length, "foot_radius_m"), 5.0, 1e-12);
  EXPECT_NEAR(value(points, length, "radius_at_fifth_m"), 2.0, 1e-12);
  EXPECT_NEAR(value(points, 10.0, "radius_at_fifth_m"), 3.0, 1e-12) << "on the cone";
  EXPECT_NEAR(value(points, length, "final_length_m", 0.1), 18.2, 1e-12);
  EXPECT_NEAR(value(points, length, "foot_radius_m", 0.1), 5.1, 1e-12);
  EXPECT_TRUE(std::isnan(value({}, length, "final_length_m")));
  EXPECT_TRUE(std::isnan(value({}, length, "radius_at_fifth_m")));
}

}  // namespace
}  // namespace undex::judge
