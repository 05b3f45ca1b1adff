// The table of comparisons, and the words that they share: names of metrics, the radial component.
#include "judge/comparisons.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "judge/metric_names.hpp"
#include "judge/radial.hpp"

namespace undex::judge {
namespace {

TEST(Comparisons, EachHasANameATitleAndAVerdict) {
  std::set<std::string> names{"none"};
  for (const Comparison& each : comparisons()) {
    EXPECT_TRUE(names.insert(each.kind.name).second) << each.kind.name << " is there twice";
    EXPECT_NE(std::string(each.title), "") << each.kind.name;
    EXPECT_NE(each.judge, nullptr) << each.kind.name;
    scene::Scene scene;
    scene.comparison.kind = each.kind.name;
    EXPECT_EQ(comparison_of(scene), &each);
  }
  EXPECT_EQ(comparison_kinds().size(), comparisons().size());
  scene::Scene scene;
  scene.comparison.kind = "none";
  EXPECT_EQ(comparison_of(scene), nullptr);
}

TEST(MetricNames, EndsAreUnits) {
  const auto says = [](const char* metric) {
    const ShownMetric shown = judge::shown(metric);
    return shown.label + " [" + shown.unit + "]";
  };
  EXPECT_EQ(says("impulse_0_45us_pa_s"), "impulse 0 45us [kPa s]");
  EXPECT_EQ(says("peak_wall_velocity_m_s"), "peak wall velocity [m/s]");
  EXPECT_EQ(says("first_peak_pa"), "first peak [MPa]");
  EXPECT_EQ(says("arrival_s"), "arrival [us]");
  EXPECT_EQ(says("final_length_m"), "final length [mm]");
  EXPECT_EQ(says("l1_0_95us"), "l1 0 95us []");
  EXPECT_EQ(shown("arrival_s").factor, 1e6);
}

TEST(MetricNames, OfAValueAtATimeTellTheTime) {
  EXPECT_EQ(metric_at_time("displacement", 30, "m"), "displacement_30us_m");
  EXPECT_EQ(metric_at_time("plastic_strain", 60, ""), "plastic_strain_60us");
  EXPECT_DOUBLE_EQ(time_of_metric("wall_velocity_25us_m_s", "wall_velocity"), 25e-6);
  EXPECT_TRUE(std::isnan(time_of_metric("wall_velocity_25us_m_s", "displacement")));
  EXPECT_TRUE(std::isnan(time_of_metric("displacement_m", "displacement")));
  EXPECT_TRUE(is_at_time("displacement_30us_m"));
  EXPECT_FALSE(is_at_time("peak_wall_velocity_time_s"));
}

TEST(Radial, IsTheComponentAwayFromTheAxis) {
  const Axis axis{.direction = 1, .center = {1, 5, 0}};
  EXPECT_NEAR((axis.outward({4, 9, 4}) - Vec3(0.6, 0, 0.8)).norm(), 0, 1e-15);
  EXPECT_TRUE(axis.outward({1, 7, 0}).isZero()) << "on the axis no way leads outward";
  const output::Series x{{0, 1}, {1, 2}}, y{{0, 1}, {7, 7}}, z{{0, 1}, {0, 10}};
  const output::Series r = radial({x, y, z}, {0.6, 0, 0.8});
  EXPECT_DOUBLE_EQ(r.y[0], 0.6);
  EXPECT_DOUBLE_EQ(r.y[1], 9.2);
  EXPECT_DOUBLE_EQ(radial({x, y, {}}, {0, 1, 0}).y[1], 7) << "a plane scene has no z";
  EXPECT_TRUE(radial({}, {1, 0, 0}).empty());
}

}  // namespace
}  // namespace undex::judge
