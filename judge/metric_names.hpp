// What the name of a metric says: its end the unit (displacement_30us_m, peak_pressure_pa), a number before that the time [us].
#pragma once

#include <array>
#include <string>

namespace undex::judge {

/// A metric as a table shows it.
struct ShownMetric {
  std::string label;    ///< its name as words, without the unit
  std::string unit;     ///< that suits a table (mm, MPa, us); empty for a pure number
  double factor = 1.0;  ///< from the metric to that unit
};
ShownMetric shown(const std::string& metric);

/// The quantities of which metrics are values at given times.
inline constexpr std::array timed_quantities{"displacement", "wall_velocity", "plastic_strain"};

/// The name of such a metric; `unit` is its end ("m", "m_s"), empty for a pure number.
std::string metric_at_time(const std::string& quantity, int time_us, const std::string& unit);

/// Its time [s], where the metric is one of that quantity; else NaN.
double time_of_metric(const std::string& metric, const std::string& quantity);
bool is_at_time(const std::string& metric);

/// "wall_velocity" as words.
std::string spoken(std::string name);

}  // namespace undex::judge
