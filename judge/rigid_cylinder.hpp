// comparison.kind = "rigid_cylinder": the pressure that a bubble in a closed rigid cylinder makes at its wall.
#pragma once

#include "output/run_record.hpp"
#include "output/series.hpp"

namespace undex::judge {

/// The rigid cylinder: pressure [Pa] at the wall at mid-height. In this order:
///   arrival_s               half rise of the first peak
///   first_peak_pa, first_peak_time_s   largest value before 45 us (counted when above 10 MPa, and when the pressure has
///                           halved again or the run went beyond 45 us)
///   first_peak_5us_pa       largest centred 5 us mean before 45 us
///   impulse_0_45us_pa_s     integral over 0..45 us
///   cavitation_s            after the first peak and before 85 us the pressure drops below 5 MPa; the time at which that
///                           fall, from 10 to 5 MPa, continued in a straight line, reaches zero (at most 1 us later)
///   collapse_s              the pressure rises through 0.1 GPa after 60 us
///   second_peak_time_s      of the largest value in 85..112.5 us (counted when above 10 MPa)
///   second_peak_5us_pa      largest 5 us mean in 85..110 us
///   impulse_85_112us_pa_s   integral over 85..112.5 us
///   second_cavitation_s     as cavitation_s, after the second peak
/// and, where a reference history is given, l1_0_95us: mean of |p - reference| over 0..95 us, over 0.722 GPa.
/// Throws std::invalid_argument on a series that is not one (see require_valid).
output::NamedNumbers rigid_cylinder_metrics(const output::Series& pressure, const output::Series& reference = {});

}  // namespace undex::judge
