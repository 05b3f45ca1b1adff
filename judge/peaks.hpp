// Marks of a pressure history that several comparisons read: its first peak, when that arrives, when the pressure is gone.
#pragma once

#include <limits>

#include "output/series.hpp"

namespace undex::judge {

constexpr double cavitated = 5e6;    ///< [Pa]; well above a cavitated liquid's, well below any shock here
constexpr double least_peak = 10e6;  ///< [Pa]; what is lower is noise, not a peak

struct Peak {
  double t = std::numeric_limits<double>::quiet_NaN(), y = t;  ///< [s], [Pa]; NaN: there is none
  bool found() const { return t == t; }
};

/// The largest value in 0..until [s], if it is a peak: above the noise, and seen to pass.
Peak first_peak(const output::Series& p, double until);

/// When the pressure first rises through half of the peak [s]; NaN without one.
double half_rise(const output::Series& p, const Peak& peak);

/// Largest mean over `window` [s] centred in a..b, only where the windows lie within the samples.
double largest_mean(const output::Series& p, double window, double a, double b);

/// When the pressure, having dropped below `cavitated` in from..until, is gone [s]: the fall from twice that level continued
/// in a straight line, by 1 us at most. A threshold alone would be early by the time that the rest of the fall takes.
double fall_to_zero(const output::Series& p, double from, double until);

}  // namespace undex::judge
