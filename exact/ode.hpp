// Ordinary differential equations to tight tolerance: the embedded Runge-Kutta pair of orders 5 and 4 of J.
// R. Dormand and P. J. Prince (J. Comput. Appl. Math. 6, 1980).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace undex::exact {

template <std::size_t N>
using OdeState = std::array<double, N>;

/// One step of length h from y at s; the estimated error of each component goes to `error`.
template <std::size_t N, class Slope>
OdeState<N> runge_kutta_step(const Slope& slope, double s, const OdeState<N>& y, double h, OdeState<N>& error) {
  constexpr double a[6][6] = {{1.0 / 5},
                              {3.0 / 40, 9.0 / 40},
                              {44.0 / 45, -56.0 / 15, 32.0 / 9},
                              {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                              {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                              {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  constexpr double c[6] = {1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1.0, 1.0};
  constexpr double d[7] = {71.0 / 57600, 0.0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525.0, -1.0 / 40};
  std::array<OdeState<N>, 7> k;
  k[0] = slope(s, y);
  OdeState<N> stage = y;
  for (int i = 0; i < 6; ++i) {
    for (std::size_t n = 0; n < N; ++n) {
      double sum = 0.0;
      for (int j = 0; j <= i; ++j) sum += a[i][j] * k[j][n];
      stage[n] = y[n] + h * sum;
    }
    k[i + 1] = slope(s + c[i] * h, stage);
  }
  for (std::size_t n = 0; n < N; ++n) {
    error[n] = 0.0;
    for (int j = 0; j < 7; ++j) error[n] += h * d[j] * k[j][n];
  }
  return stage;
}

template <std::size_t N>
struct OdePoint {
  double s;
  OdeState<N> y;
};

/// Ten times what the stiffest of the laws here asks for.
constexpr long usual_most_steps = 1'000'000;

/// Integrates dy/ds = slope(s, y) from `begin` to `end` (either direction) and returns the accepted points,
/// the two ends included. Each component's error of a step stays below tolerance * max(|y|, scale). After
/// each step `stop(point)` is asked; the integration ends behind the first point for which it holds. Throws
/// std::domain_error where the equation cannot be followed: the step has become too small to advance, or `most_steps`
/// do not reach the end.
template <std::size_t N, class Slope, std::predicate<OdePoint<N>> Stop>
std::vector<OdePoint<N>> integrate(const Slope& slope, double begin, double end, const OdeState<N>& start,
                                   const OdeState<N>& scale, double tolerance, double largest_step, const Stop& stop,
                                   long most_steps = usual_most_steps) {
  std::vector<OdePoint<N>> points{{begin, start}};
  const double sign = end < begin ? -1.0 : 1.0;
  double h = std::min(largest_step, 1e-4 * std::abs(end - begin));
  long steps = 0;
  while ((end - points.back().s) * sign > 0.0) {
    const OdePoint<N>& from = points.back();
    const double left = std::abs(end - from.s);
    const bool last = h >= left;
    if (last) h = left;
    if (!(h > 0.0) || from.s + sign * h == from.s || ++steps > most_steps)
      throw std::domain_error("the differential equation cannot be followed beyond " + std::to_string(from.s));
    OdeState<N> error{};
    const OdeState<N> y = runge_kutta_step(slope, from.s, from.y, sign * h, error);
    double worst = 0.0;
    for (std::size_t n = 0; n < N; ++n) {
      const double allowed = tolerance * std::max({std::abs(from.y[n]), std::abs(y[n]), scale[n]});
      worst = std::isfinite(y[n]) ? std::max(worst, std::abs(error[n]) / allowed) : 1e30;
    }
    if (worst <= 1.0) {
      points.push_back({last ? end : from.s + sign * h, y});
      if (stop(points.back())) break;
    }
    h = std::min(largest_step, h * std::clamp(0.9 * std::pow(std::max(worst, 1e-10), -0.2), 0.1, 4.0));
  }
  return points;
}

template <std::size_t N, class Slope>
std::vector<OdePoint<N>> integrate(const Slope& slope, double begin, double end, const OdeState<N>& start,
                                   const OdeState<N>& scale, double tolerance, double largest_step,
                                   long most_steps = usual_most_steps) {
  const auto never = [](const OdePoint<N>&) { return false; };
  return integrate(slope, begin, end, start, scale, tolerance, largest_step, never, most_steps);
}

}  // namespace undex::exact
