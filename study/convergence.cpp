#include "study/convergence.hpp"

#include <cmath>

#include "core/constants.hpp"

namespace undex::study {

namespace {

bool usable(double value) { return value > 0 && std::isfinite(value); }

}  // namespace

double observed_order(double h1, double e1, double h2, double e2) { return fitted_order({h1, h2}, {e1, e2}); }

double fitted_order(const std::vector<double>& h, const std::vector<double>& errors) {
  double n = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < h.size(); ++i)
    if (usable(h[i]) && usable(errors[i])) {
      n += 1;
      x += std::log(h[i]);
      y += std::log(errors[i]);
    }
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < h.size(); ++i)
    if (usable(h[i]) && usable(errors[i])) {
      const double dx = std::log(h[i]) - x / n;
      xx += dx * dx;
      xy += dx * (std::log(errors[i]) - y / n);
    }
  return xx > 1e-24 ? xy / xx : nan;
}

std::vector<bool> pareto_front(const std::vector<double>& costs, const std::vector<double>& errors) {
  std::vector<bool> front;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    bool beaten = std::isnan(costs[i]) || std::isnan(errors[i]);
    for (std::size_t j = 0; j < costs.size() && !beaten; ++j)
      beaten = costs[j] <= costs[i] && errors[j] <= errors[i] && (costs[j] < costs[i] || errors[j] < errors[i]);
    front.push_back(!beaten);
  }
  return front;
}

}  // namespace undex::study
