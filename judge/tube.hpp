// comparison.kind = "tube": motion of a deforming tube's wall and the pressure in it.
#pragma once

#include "output/run_record.hpp"
#include "output/series.hpp"

namespace undex::judge {

/// Histories of the deforming tube; any may be empty, its results are then left out.
struct TubeHistories {
  output::Series pressure;        ///< at the inner wall, mid-length [Pa]
  output::Series displacement;    ///< outwards, outer wall, mid-length [m]
  output::Series velocity;        ///< the same point [m/s]
  output::Series plastic_strain;  ///< mid-wall, mid-length
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
output::NamedNumbers tube_metrics(const TubeHistories& histories);

}  // namespace undex::judge
