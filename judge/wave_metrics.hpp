// The named results of waves in the open and on a free plate: pure functions of histories. What did not happen, or was not
// reached, is NaN; the definitions are the same for a run and for its reference.
#pragma once

#include <string>

#include "output/run_record.hpp"
#include "output/series.hpp"

namespace undex::output {

/// A free plate struck by a plane wave.
struct PlateHistories {
  Series pressure;  ///< of the fluid at the plate [Pa]
  Series velocity;  ///< of the plate, along the wave's way [m/s]
};

/// With `mass` of the plate per area [kg/m^2] and `peak` [Pa] of the incident wave above the pressure at rest:
///   cavitation<label>_s         the pressure at the plate, having passed `peak`, is gone: its fall from 0.2 to 0.1 `peak`
///                               continued in a straight line
///   impulse<label>_pa_s         mass times velocity then
///   end_impulse<label>_pa_s     mass times mean velocity from then to the end of the history
/// Throws std::invalid_argument on a series that is not one.
NamedNumbers plate_metrics(const PlateHistories& histories, double mass, double peak, const std::string& label = "");

/// A blast wave at a fixed point, run beside reference over the time a..b [s] that both cover:
///   peak_<name>_pa, arrival_<name>_s (half rise of the peak), impulse_<name>_pa_s (integral over a..b)
///   the same as peak_1d_<name>_pa ... of the reference
///   l1_pressure_<name>          mean of |p - reference| over a..b, over the reference's peak
/// Throws std::invalid_argument on a series that is not one.
NamedNumbers blast_metrics(const Series& pressure, const Series& reference, const std::string& name, double a, double b);

}  // namespace undex::output
