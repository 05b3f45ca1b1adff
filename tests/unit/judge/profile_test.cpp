// The comparison in space on made-up profiles whose errors and fronts are known.
#include "judge/profile_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/unit/output/temporary_folder.hpp"

namespace undex::judge {
namespace {

using namespace output;

double value(const NamedNumbers& numbers, const std::string& name) {
  for (const auto& [each, number] : numbers)
    if (each == name) return number;
  ADD_FAILURE() << "no " << name;
  return 0;
}

ProfilePoint point(double x, double volume, double p, double exact) {
  ProfilePoint result;
  result.coordinate = x;
  result.volume = volume;
  result.run.pressure = p;
  result.exact.pressure = exact;
  return result;
}

/// A step of pressure from 10 to 0 at x = `front` on n points in 0..1, of the run and of the exact solution.
Profile step(int n, double front, double exact) {
  Profile profile;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    profile.push_back(point(x, 1.0 / n, x < front ? 10 : 0, x < exact ? 10 : 0));
  }
  return profile;
}

TEST(Profile, ErrorsAreMeansByVolumeOverTheLargestExactValue) {
  // Error 1 in a tenth of the volume, -3 in the rest.
  const Profile profile{point(0, 0.1, 5, 4), point(1, 0.9, -1, 2)};
  const NamedNumbers errors = profile_errors(profile);
  EXPECT_DOUBLE_EQ(value(errors, "l1_pressure_pa"), 0.1 * 1 + 0.9 * 3);
  EXPECT_DOUBLE_EQ(value(errors, "l1_pressure"), 2.8 / 4);
  EXPECT_EQ(value(errors, "points"), 2);
  EXPECT_TRUE(std::isnan(value(errors, "l1_density"))) << "there is nothing to measure it against";
  EXPECT_EQ(value(errors, "l1_density_kg_m3"), 0);
  EXPECT_EQ(errors.size(), 7u);
}

TEST(Profile, NothingComparedIsNotNoError) {
  const NamedNumbers errors = profile_errors({});
  for (const char* name : {"l1_pressure", "l1_pressure_pa", "l1_velocity"}) EXPECT_TRUE(std::isnan(value(errors, name))) << name;
  EXPECT_TRUE(std::isnan(front_position({}, &FlowState::pressure, 1, true)));
  EXPECT_TRUE(std::isnan(profile_mean({}, 0, 1).run.pressure));
  EXPECT_TRUE(std::isnan(largest_pressure_error({}, [](const ProfilePoint&) { return true; })));
}

TEST(Profile, AStepThatIsLateByADistanceHasThatErrorOfFirstOrder) {
  for (const int n : {100, 1000}) {
    const Profile profile = step(n, 0.5, 0.6);
    EXPECT_NEAR(value(profile_errors(profile), "l1_pressure"), 0.1, 1.0 / n);
    for (const bool from_high : {true, false})
      EXPECT_NEAR(front_position(profile, &FlowState::pressure, 5, from_high), 0.5, 0.5 / n);
  }
}

TEST(Profile, FrontIsTheFirstFromTheSideAskedFor) {
  Profile profile = step(100, 0.7, 0.7);
  for (ProfilePoint& p : profile)
    if (p.coordinate < 0.2) p.run.pressure = 0;
  EXPECT_NEAR(front_position(profile, &FlowState::pressure, 2.5, true), 0.7025, 1e-9);  // linear between 0.695 and 0.705
  EXPECT_NEAR(front_position(profile, &FlowState::pressure, 5, false), 0.2, 1e-9);
  EXPECT_TRUE(std::isnan(front_position(profile, &FlowState::pressure, 11, true)));
}

TEST(Profile, ShellsKeepVolumeAndIntegral) {
  Profile profile;
  double integral = 0, volume = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = 1e-3 * i;
    profile.push_back(point(x, 1 + x, std::sin(7 * x), std::cos(3 * x)));
    integral += profile.back().volume * profile.back().run.pressure;
    volume += profile.back().volume;
  }
  const Profile means = shells(profile, 0.1 * (1 + 1e-9));
  ASSERT_EQ(means.size(), 10u);
  double sum = 0, sum_volume = 0;
  for (const ProfilePoint& mean : means) {
    sum += mean.volume * mean.run.pressure;
    sum_volume += mean.volume;
    EXPECT_NEAR(mean.run.pressure, std::sin(7 * mean.coordinate), 0.03);
    EXPECT_NEAR(mean.exact.pressure, std::cos(3 * mean.coordinate), 0.01);
  }
  EXPECT_NEAR(sum, integral, 1e-9);
  EXPECT_NEAR(sum_volume, volume, 1e-9);
}

TEST(Profile, MeanTakesItsIntervalAlone) {
  const Profile profile{point(0.1, 1, 100, 0), point(0.4, 1, 1, 3), point(0.6, 3, 5, 3), point(0.9, 1, 100, 0)};
  const ProfileMean mean = profile_mean(profile, 0.3, 0.7);
  EXPECT_DOUBLE_EQ(mean.run.pressure, 4);
  EXPECT_DOUBLE_EQ(mean.exact.pressure, 3);
  EXPECT_DOUBLE_EQ(
      largest_pressure_error(profile, [](const ProfilePoint& p) { return p.coordinate < 0.7 && p.coordinate > 0.3; }), 2);
}

TEST(Profile, FilesHaveUnitsAndEveryPoint) {
  const TemporaryFolder folder;
  write_history(folder.path / "profile.csv", profile_table(step(3, 0.5, 0.5)));
  write_history(folder.path / "exact.csv", exact_profile_table(step(3, 0.5, 0.5)));
  std::ifstream file(folder.path / "profile.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line,
            "coordinate [m],body [-],volume [m^d],density [kg/m3],velocity [m/s],pressure [Pa],exact_density [kg/m3],"
            "exact_velocity [m/s],exact_pressure [Pa]");
  int rows = 0;
  while (std::getline(file, line)) ++rows;
  EXPECT_EQ(rows, 3);
}

}  // namespace
}  // namespace undex::judge
