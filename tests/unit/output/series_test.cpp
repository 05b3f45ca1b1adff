#include "output/series.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "temporary_folder.hpp"

namespace undex::output {
namespace {

// y = t on 0..10 with uneven samples.
Series ramp() { return {{0, 1, 1.5, 4, 10}, {0, 1, 1.5, 4, 10}}; }

TEST(Series, ValuesAndIntegralsOfARamp) {
  EXPECT_DOUBLE_EQ(value_at(ramp(), 2.7), 2.7);
  EXPECT_DOUBLE_EQ(integral(ramp(), 1.2, 7), 0.5 * (49 - 1.44));
  EXPECT_TRUE(std::isnan(value_at(ramp(), 11)));
  EXPECT_TRUE(std::isnan(integral(ramp(), 0, 11)));
}

TEST(Series, EmptyAndSingleSamplesGiveNaN) {
  for (const Series& series : {Series{}, Series{{0}, {1}}}) {
    EXPECT_TRUE(std::isnan(value_at(series, 0)));
    EXPECT_TRUE(std::isnan(integral(series, 0, 1)));
    EXPECT_TRUE(moving_average(series, 1).empty());
    EXPECT_TRUE(std::isnan(first_rise(series, 0.5, -1, 1)));
  }
  EXPECT_TRUE(std::isnan(maximum({}, 0, 1).y));
}

TEST(Series, MovingAverageOfARampIsTheRampAwayFromTheEnds) {
  const Series mean = moving_average(ramp(), 2);
  EXPECT_NEAR(mean.y[1], 1, 1e-12);
  EXPECT_NEAR(mean.y[3], 4, 1e-12);
  EXPECT_NEAR(mean.y[0], 0.5, 1e-12) << "the window is cut off at the end";
}

TEST(Series, CrossingsAreInterpolated) {
  const Series hat{{0, 1, 2, 3, 4}, {0, 0, 10, 0, 0}};
  EXPECT_DOUBLE_EQ(first_rise(hat, 5, 0, 4), 1.5);
  EXPECT_DOUBLE_EQ(first_below(hat, 5, 1.8, 4), 2.5);
  EXPECT_TRUE(std::isnan(first_rise(hat, 5, 2, 4)));
  EXPECT_TRUE(std::isnan(first_below(hat, -1, 0, 4)));
  EXPECT_DOUBLE_EQ(maximum(hat, 0, 4).t, 2);
}

TEST(Series, RepeatedTimesDoNoHarm) {
  const Series jump{{0, 1, 1, 2}, {0, 0, 4, 4}};
  EXPECT_DOUBLE_EQ(integral(jump, 0, 2), 4);
  EXPECT_DOUBLE_EQ(first_rise(jump, 2, 0, 2), 1);
}

TEST(Series, InvalidOnesAreRefused) {
  EXPECT_THROW(require_valid({{0, 1}, {0}}), std::invalid_argument);
  EXPECT_THROW(require_valid({{1, 0}, {0, 0}}), std::invalid_argument);
  EXPECT_THROW(require_valid({{0, 1}, {0, std::nan("")}}), std::invalid_argument);
  EXPECT_NO_THROW(require_valid({}));
}

TEST(Series, ReadErrorsNameFileAndLine) {
  const TemporaryFolder folder;
  const auto path = folder.path / "a.csv";
  EXPECT_NE(message_of<FileError>([&] { read_history(path); }).find("No such file"), std::string::npos);
  std::ofstream(path) << "# comment\ntime [s],pressure [Pa]\n0,1\nhello,2\n";
  EXPECT_NE(message_of<FileError>([&] { read_history(path); }).find("a.csv:4"), std::string::npos);
  std::ofstream(path) << "# comment\n";
  EXPECT_NE(message_of<FileError>([&] { read_history(path); }).find("a.csv: the file is empty"), std::string::npos);
}

}  // namespace
}  // namespace undex::output
