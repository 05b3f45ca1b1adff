// How errors fall with resolution and what they cost: observed orders and the Pareto front of error against cost.
#pragma once

#include <vector>

namespace undex::study {

/// Order p of an error ~ h^p from two resolutions: log(e1/e2)/log(h1/h2). NaN unless all are positive and h1 differs from h2.
double observed_order(double h1, double e1, double h2, double e2);

/// The least-squares slope of log(error) over log(h), over the points where both are positive (NaN is not); NaN where these
/// have fewer than two different h.
double fitted_order(const std::vector<double>& h, const std::vector<double>& errors);

/// Whether each point lies on the front: no other is as good in both cost and error and better in one. Points with a NaN
/// are not on it and beat nobody.
std::vector<bool> pareto_front(const std::vector<double>& costs, const std::vector<double>& errors);

}  // namespace undex::study
