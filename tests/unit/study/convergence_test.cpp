// Observed orders and Pareto fronts against what can be said by hand.
#include "study/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace undex::study {
namespace {

const double nan = std::nan("");

TEST(Convergence, OrderOfAPowerIsItsExponent) {
  for (const double p : {0.5, 1.0, 2.0, 3.7}) {
    const auto error = [&](double h) { return 0.3 * std::pow(h, p); };
    EXPECT_NEAR(observed_order(0.02, error(0.02), 0.013, error(0.013)), p, 1e-12);
    EXPECT_NEAR(observed_order(0.013, error(0.013), 0.02, error(0.02)), p, 1e-12) << "whichever comes first";
    EXPECT_NEAR(fitted_order({0.1, 0.05, 0.03, 0.01}, {error(0.1), error(0.05), error(0.03), error(0.01)}), p, 1e-12);
  }
  EXPECT_NEAR(observed_order(0.2, 1, 0.1, 2), -1, 1e-12) << "an error that grows";
}

TEST(Convergence, LeastSquaresOfPointsOffTheLine) {
  // log2 of h: 2, 1, 0; of the errors: 3, 1, 1. The slope is sum((x - 1)(y - 5/3))/sum((x - 1)^2) = 2/2.
  EXPECT_NEAR(fitted_order({4, 2, 1}, {8, 2, 2}), 1, 1e-12);
}

TEST(Convergence, WhatHasNoOrder) {
  EXPECT_TRUE(std::isnan(observed_order(0.1, 0, 0.05, 1e-3))) << "an error of zero";
  EXPECT_TRUE(std::isnan(observed_order(0.1, 1, 0.1, 2))) << "one resolution";
  EXPECT_TRUE(std::isnan(observed_order(0.1, nan, 0.05, 1)));
  EXPECT_TRUE(std::isnan(fitted_order({}, {})));
  EXPECT_NEAR(fitted_order({0.4, 0.2, 0.1}, {nan, 4, 2}), 1, 1e-12) << "points without an error are passed over";
}

TEST(Convergence, ParetoFront) {
  EXPECT_EQ(pareto_front({1, 2, 3, 4}, {8, 4, 5, 1}), (std::vector<bool>{true, true, false, true}));
  EXPECT_EQ(pareto_front({1, 1, 2}, {3, 3, 3}), (std::vector<bool>{true, true, false})) << "equals do not beat each other";
  EXPECT_EQ(pareto_front({1, 1}, {3, 2}), (std::vector<bool>{false, true})) << "better in one is enough";
  EXPECT_EQ(pareto_front({1, nan, 0.5, 3}, {2, 0, nan, 1}), (std::vector<bool>{true, false, false, true}))
      << "the unknown beats nobody";
  EXPECT_TRUE(pareto_front({}, {}).empty());
}

}  // namespace
}  // namespace undex::study
