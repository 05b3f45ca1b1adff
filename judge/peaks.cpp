#include "judge/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace undex::judge {
Peak first_peak(const output::Series& p, double until) {
  const output::Extremum top = maximum(p, -forever, until);
  if (!(top.y >= least_peak)) return {};
  if (p.t.back() < until && std::isnan(first_below(p, 0.5 * top.y, top.t, forever))) return {};
  return {top.t, top.y};
}

double half_rise(const output::Series& p, const Peak& peak) {
  return peak.found() ? first_rise(p, 0.5 * peak.y, -forever, peak.t) : nan;
}

double largest_mean(const output::Series& p, double window, double a, double b) {
  if (p.t.size() < 2) return nan;
  // The mean varies smoothly on the scale of the window: a hundredth of it finds the maximum to 1e-4.
  output::Series fine;
  const double begin = std::max(a - window, p.t.front()), end = std::min(b + window, p.t.back());
  for (double t = begin; t <= end; t += 0.01 * window) fine.append(t, 0);
  output::Series merged;
  std::size_t i = 0;
  for (const double t : fine.t) {
    for (; i < p.t.size() && p.t[i] <= t; ++i)
      if (p.t[i] >= begin) merged.append(p.t[i], p.y[i]);
    merged.append(t, value_held(p, t));
  }
  for (; i < p.t.size() && p.t[i] <= end; ++i) merged.append(p.t[i], p.y[i]);
  return maximum(moving_average(merged, window), std::max(a, p.t.front() + 0.5 * window), std::min(b, p.t.back() - 0.5 * window))
      .y;
}

double fall_to_zero(const output::Series& p, double from, double until) {
  const double low = first_below(p, cavitated, from, until);
  if (std::isnan(low)) return nan;
  double high = nan;
  for (std::size_t i = 1; i < p.t.size() && p.t[i - 1] <= low; ++i)
    if (p.y[i - 1] >= 2 * cavitated && p.y[i] < 2 * cavitated)
      high = p.t[i - 1] + (p.y[i - 1] - 2 * cavitated) / (p.y[i - 1] - p.y[i]) * (p.t[i] - p.t[i - 1]);
  return std::isnan(high) ? low : low + std::clamp(low - high, 0.0, 1 * us);
}

}  // namespace undex::judge
