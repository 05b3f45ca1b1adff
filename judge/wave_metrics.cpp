#include "judge/wave_metrics.hpp"

#include <cmath>
#include <limits>

namespace undex::output {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double forever = std::numeric_limits<double>::infinity();

/// Time at which y, above `level` at `from`, first falls through it.
double fall_through(const Series& series, double level, double from) {
  for (std::size_t i = 1; i < series.t.size(); ++i)
    if (series.t[i - 1] >= from && series.y[i - 1] >= level && series.y[i] < level)
      return series.t[i - 1] + (series.y[i - 1] - level) / (series.y[i - 1] - series.y[i]) * (series.t[i] - series.t[i - 1]);
  return nan;
}

double fall_to_zero(const Series& p, double peak) {
  const double reached = first_rise(p, peak, -forever, forever);
  if (std::isnan(reached)) return nan;
  const double low = fall_through(p, 0.05 * peak, reached);
  if (std::isnan(low)) return nan;
  // The last fall before that, so that an oscillation on the way does not stretch the line.
  double high = nan;
  for (double at = fall_through(p, 0.1 * peak, reached); at <= low; at = fall_through(p, 0.1 * peak, std::nextafter(at, forever)))
    high = at;
  return low + (low - high);
}

}  // namespace

NamedNumbers plate_metrics(const PlateHistories& histories, double mass, double peak, const std::string& label) {
  require_valid(histories.pressure);
  require_valid(histories.velocity);
  const Series& v = histories.velocity;
  const double cavitation = fall_to_zero(histories.pressure, peak);
  const bool reached = !std::isnan(cavitation) && !v.empty() && v.t.back() > cavitation;
  return {
      {"cavitation" + label + "_s", cavitation},
      {"impulse" + label + "_pa_s", reached ? mass * value_at(v, cavitation) : nan},
      {"end_impulse" + label + "_pa_s", reached ? mass * integral(v, cavitation, v.t.back()) / (v.t.back() - cavitation) : nan}};
}

NamedNumbers blast_metrics(const Series& pressure, const Series& reference, const std::string& name, double a, double b) {
  require_valid(pressure);
  require_valid(reference);
  NamedNumbers out;
  for (const auto& [series, label] : {std::pair{&pressure, ""}, {&reference, "1d_"}}) {
    const Extremum top = maximum(*series, a, b);
    out.emplace_back(std::string("peak_") + label + name + "_pa", top.y);
    out.emplace_back(std::string("arrival_") + label + name + "_s", top.y > 0 ? first_rise(*series, 0.5 * top.y, a, b) : nan);
    out.emplace_back(std::string("impulse_") + label + name + "_pa_s", integral(*series, a, b));
  }
  out.emplace_back("l1_pressure_" + name, difference_norms(pressure, reference, a, b).l1);
  return out;
}

}  // namespace undex::output
