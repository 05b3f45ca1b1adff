// The named results by which a run is compared: pure functions of histories.
//
// An event that did not happen (or that the run did not reach) is NaN. The definitions are fixed and the same for a run
// and for a reference, so that their difference means something.
#pragma once

#include <vector>

#include "core/vector.hpp"
#include "output/run_record.hpp"
#include "output/series.hpp"

namespace undex::output {

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
NamedNumbers rigid_cylinder_metrics(const Series& pressure, const Series& reference = {});

/// Histories of the deforming tube; any may be empty, its results are then left out.
struct TubeHistories {
  Series pressure;        ///< at the inner wall, mid-length [Pa]
  Series displacement;    ///< outwards, outer wall, mid-length [m]
  Series velocity;        ///< the same point [m/s]
  Series plastic_strain;  ///< mid-wall, mid-length
};

/// The tube:
///   displacement_{20,30,40,60,80,100,120,150,200,250,300}us_m   only the times that the run reached
///   wall_velocity_{20,25,30,40,60,80}us_m_s                     likewise
///   motion_start_s          the wall's velocity passes 1 m/s
///   peak_wall_velocity_m_s, peak_wall_velocity_time_s   (counted when the velocity has fallen again by a tenth)
///   reload_start_s, reload_end_s, reload_gain_m_s       second kick by the closing cavity: largest rise of velocity
///                           within 85..125 us (needs a run to 125 us; counted above 5 m/s)
///   arrival_s, peak_pressure_pa, peak_pressure_time_s, peak_pressure_3us_pa   as for the rigid cylinder, before 45 us
///   impulse_0_30us_pa_s, impulse_0_60us_pa_s, impulse_0_100us_pa_s            where the run reached
///   cavitation_s, closure_s   as for the rigid cylinder's cavitation; then the first rise through 5 MPa
///   plastic_strain_60us, plastic_strain_150us
NamedNumbers tube_metrics(const TubeHistories& histories);

/// A round bar that has hit an anvil, from points of its deformed body [m] (nodes, particles): `axis` 0, 1 or 2 along the
/// bar, `center` on its axis; the foot is the end with the smaller coordinate. `skin` [m] is how far the surface lies
/// beyond the outermost points (half a spacing of particles, zero for nodes).
///   final_length_m
///   foot_radius_m           largest radius in the lowest tenth of the initial length (the mushroom's)
///   radius_at_fifth_m       at a fifth of the initial length above the foot, between the widest points of a slice of a
///                           twentieth below that height and of one above it; NaN where a slice has none
NamedNumbers taylor_bar_metrics(const std::vector<Vec3>& points, int axis, const Vec3& center, double initial_length,
                                double skin = 0.0);

}  // namespace undex::output
