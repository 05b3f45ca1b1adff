#include "judge/metric_names.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/constants.hpp"

namespace undex::judge {
namespace {

struct End {
  const char *name, *unit;
  double factor;
};
/// The longer ends first.
constexpr std::array ends{
    End{"_j_m2", "kJ/m^2", 1e-3}, End{"_pa_s", "kPa s", 1e-3}, End{"_m_s", "m/s", 1}, End{"_pa", "MPa", 1e-6},
    End{"_s", "us", 1e6},         End{"_m", "mm", 1e3},        End{"", "", 1}};

}  // namespace

ShownMetric shown(const std::string& metric) {
  const End& end = *std::find_if(ends.begin(), ends.end(), [&](const End& each) { return metric.ends_with(each.name); });
  return {
      .label = spoken(metric.substr(0, metric.size() - std::string(end.name).size())), .unit = end.unit, .factor = end.factor};
}

std::string metric_at_time(const std::string& quantity, int time_us, const std::string& unit) {
  return quantity + "_" + std::to_string(time_us) + "us" + (unit.empty() ? "" : "_" + unit);
}

double time_of_metric(const std::string& metric, const std::string& quantity) {
  if (!metric.starts_with(quantity + "_")) return nan;
  const char* begin = metric.c_str() + quantity.size() + 1;
  char* end = nullptr;
  const double time = std::strtod(begin, &end);
  return end != begin && std::string(end).starts_with("us") ? 1e-6 * time : nan;
}

bool is_at_time(const std::string& metric) {
  return std::any_of(timed_quantities.begin(), timed_quantities.end(),
                     [&](const char* quantity) { return !std::isnan(time_of_metric(metric, quantity)); });
}

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace undex::judge
