#include "judge/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace undex::output {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double forever = std::numeric_limits<double>::infinity();
constexpr double us = 1e-6;
constexpr double cavitated = 5e6;    // [Pa]; well above a cavitated liquid's, well below any shock here
constexpr double least_peak = 10e6;  // [Pa]; what is lower is noise, not a peak

struct Peak {
  double t = nan, y = nan;
  bool found() const { return !std::isnan(t); }
};

// The largest value in 0..until, if it is a peak: above the noise, and seen to pass.
Peak first_peak(const Series& p, double until) {
  const Extremum top = maximum(p, -forever, until);
  if (!(top.y >= least_peak)) return {};
  if (p.t.back() < until && std::isnan(first_below(p, 0.5 * top.y, top.t, forever))) return {};
  return {top.t, top.y};
}

double half_rise(const Series& p, const Peak& peak) { return peak.found() ? first_rise(p, 0.5 * peak.y, -forever, peak.t) : nan; }

// Largest mean over `window` centred in a..b, only where the windows lie within the samples.
double largest_mean(const Series& p, double window, double a, double b) {
  if (p.t.size() < 2) return nan;
  // The mean varies smoothly on the scale of the window: a hundredth of it finds the maximum to 1e-4.
  Series fine;
  const double begin = std::max(a - window, p.t.front()), end = std::min(b + window, p.t.back());
  for (double t = begin; t <= end; t += 0.01 * window) fine.append(t, 0);
  Series merged;
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

// When the pressure, having dropped below `cavitated` in from..until, is gone: the fall from twice that level continued
// in a straight line. A threshold alone would be early by the time that the rest of the fall takes.
double fall_to_zero(const Series& p, double from, double until) {
  const double low = first_below(p, cavitated, from, until);
  if (std::isnan(low)) return nan;
  double high = nan;
  for (std::size_t i = 1; i < p.t.size() && p.t[i - 1] <= low; ++i)
    if (p.y[i - 1] >= 2 * cavitated && p.y[i] < 2 * cavitated)
      high = p.t[i - 1] + (p.y[i - 1] - 2 * cavitated) / (p.y[i - 1] - p.y[i]) * (p.t[i] - p.t[i - 1]);
  return std::isnan(high) ? low : low + std::clamp(low - high, 0.0, 1 * us);
}

double mean_difference(const Series& p, const Series& reference, double a, double b) {
  if (!covers(p, a, b) || !covers(reference, a, b)) return nan;
  constexpr int samples = 9500;
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const double t = a + (b - a) * (i + 0.5) / samples;
    sum += std::abs(value_held(p, t) - value_held(reference, t));
  }
  return sum / samples;
}

std::string at_time(const std::string& name, int time_us, const std::string& unit) {
  return name + "_" + std::to_string(time_us) + "us" + (unit.empty() ? "" : "_" + unit);
}

void add_table(NamedNumbers& out, const Series& series, const std::string& name, const std::string& unit,
               std::initializer_list<int> times_us) {
  for (const int time : times_us)
    if (covers(series, time * us, time * us)) out.emplace_back(at_time(name, time, unit), value_at(series, time * us));
}

void add_velocity(NamedNumbers& out, const Series& v) {
  add_table(out, v, "wall_velocity", "m_s", {20, 25, 30, 40, 60, 80});
  out.emplace_back("motion_start_s", first_rise(v, 1.0, -forever, forever));
  const Extremum top = maximum(v, -forever, forever);
  const bool passed = top.y > 0 && !std::isnan(first_below(v, 0.9 * top.y, top.t, forever));
  out.emplace_back("peak_wall_velocity_m_s", passed ? top.y : nan);
  out.emplace_back("peak_wall_velocity_time_s", passed ? top.t : nan);

  // The largest rise from any earlier value within the interval.
  double start = nan, end = nan, gain = 0, lowest = forever, lowest_t = nan;
  if (covers(v, 85 * us, 125 * us))
    for (std::size_t i = 0; i < v.t.size(); ++i) {
      if (v.t[i] < 85 * us || v.t[i] > 125 * us) continue;
      if (v.y[i] < lowest) lowest = v.y[i], lowest_t = v.t[i];
      if (v.y[i] - lowest > gain) gain = v.y[i] - lowest, start = lowest_t, end = v.t[i];
    }
  const bool reloaded = gain > 5;
  out.emplace_back("reload_start_s", reloaded ? start : nan);
  out.emplace_back("reload_end_s", reloaded ? end : nan);
  out.emplace_back("reload_gain_m_s", reloaded ? gain : nan);
}

void add_pressure(NamedNumbers& out, const Series& p) {
  const Peak peak = first_peak(p, 45 * us);
  out.emplace_back("arrival_s", half_rise(p, peak));
  out.emplace_back("peak_pressure_pa", peak.y);
  out.emplace_back("peak_pressure_time_s", peak.t);
  out.emplace_back("peak_pressure_3us_pa", peak.found() ? largest_mean(p, 3 * us, 0, 45 * us) : nan);
  for (const int end : {30, 60, 100})
    if (covers(p, 0, end * us)) out.emplace_back("impulse_0_" + std::to_string(end) + "us_pa_s", integral(p, 0, end * us));
  const double cavitation = peak.found() ? fall_to_zero(p, peak.t, 85 * us) : nan;
  out.emplace_back("cavitation_s", cavitation);
  out.emplace_back("closure_s", std::isnan(cavitation) ? nan : first_rise(p, cavitated, cavitation, forever));
}

}  // namespace

NamedNumbers rigid_cylinder_metrics(const Series& p, const Series& reference) {
  require_valid(p);
  require_valid(reference);
  const Peak peak = first_peak(p, 45 * us);
  Peak second;
  if (covers(p, 85 * us, 112.5 * us)) {
    const Extremum top = maximum(p, 85 * us, 112.5 * us);
    if (top.y >= least_peak) second = {top.t, top.y};
  }
  NamedNumbers out;
  out.emplace_back("arrival_s", half_rise(p, peak));
  out.emplace_back("first_peak_pa", peak.y);
  out.emplace_back("first_peak_time_s", peak.t);
  out.emplace_back("first_peak_5us_pa", peak.found() ? largest_mean(p, 5 * us, 0, 45 * us) : nan);
  out.emplace_back("impulse_0_45us_pa_s", integral(p, 0, 45 * us));
  out.emplace_back("cavitation_s", peak.found() ? fall_to_zero(p, peak.t, 85 * us) : nan);
  out.emplace_back("collapse_s", first_rise(p, 1e8, 60 * us, forever));
  out.emplace_back("second_peak_time_s", second.t);
  out.emplace_back("second_peak_5us_pa", second.found() ? largest_mean(p, 5 * us, 85 * us, 110 * us) : nan);
  out.emplace_back("impulse_85_112us_pa_s", integral(p, 85 * us, 112.5 * us));
  out.emplace_back("second_cavitation_s", second.found() ? fall_to_zero(p, second.t, forever) : nan);
  if (!reference.empty()) out.emplace_back("l1_0_95us", mean_difference(p, reference, 0, 95 * us) / 0.722e9);
  return out;
}

NamedNumbers tube_metrics(const TubeHistories& histories) {
  for (const Series* series : {&histories.pressure, &histories.displacement, &histories.velocity, &histories.plastic_strain})
    require_valid(*series);
  NamedNumbers out;
  add_table(out, histories.displacement, "displacement", "m", {20, 30, 40, 60, 80, 100, 120, 150, 200, 250, 300});
  if (!histories.velocity.empty()) add_velocity(out, histories.velocity);
  if (!histories.pressure.empty()) add_pressure(out, histories.pressure);
  add_table(out, histories.plastic_strain, "plastic_strain", "", {60, 150});
  return out;
}

NamedNumbers taylor_bar_metrics(const std::vector<Vec3>& points, int axis, const Vec3& center, double initial_length,
                                double skin) {
  double low = forever, high = -forever;
  for (const Vec3& x : points) {
    low = std::min(low, x[axis] - skin);
    high = std::max(high, x[axis] + skin);
  }
  struct Widest {
    double height = nan, radius = -forever;
  };
  const auto widest = [&](double from, double to) {
    Widest found;
    for (const Vec3& x : points) {
      const double height = x[axis] - low;
      const double radius =
          std::hypot(x[(axis + 1) % 3] - center[(axis + 1) % 3], x[(axis + 2) % 3] - center[(axis + 2) % 3]) + skin;
      if (height >= from && height <= to && radius > found.radius) found = {height, radius};
    }
    return found;
  };
  const double fifth = 0.2 * initial_length, slice = 0.05 * initial_length;
  const Widest foot = widest(0.0, 0.1 * initial_length), below = widest(fifth - slice, fifth),
               above = widest(fifth, fifth + slice);
  double radius = nan;
  if (std::isfinite(below.radius) && std::isfinite(above.radius)) {
    const double gap = above.height - below.height;
    radius = gap > 0 ? below.radius + (fifth - below.height) / gap * (above.radius - below.radius) : below.radius;
  }
  return {{"final_length_m", points.empty() ? nan : high - low},
          {"foot_radius_m", std::isfinite(foot.radius) ? foot.radius : nan},
          {"radius_at_fifth_m", radius}};
}

}  // namespace undex::output
