// A run's particles beside an exact solution along one coordinate (position in a plane flow, radius in a round one): error
// norms, means, fronts. Pure functions of the compared points.
#pragma once

#include <functional>
#include <vector>

#include "output/run_record.hpp"
#include "output/samples.hpp"

namespace undex::judge {

/// What a profile shows of the flow at a point.
struct FlowState {
  double density = 0;   ///< [kg/m^3]
  double velocity = 0;  ///< along the coordinate [m/s]
  double pressure = 0;  ///< [Pa]
};

/// A particle and the exact state at its place.
struct ProfilePoint {
  double coordinate = 0;  ///< [m]
  double volume = 0;      ///< m/rho [m^3, m^2, m]
  int body = 0;           ///< number in the scene
  FlowState run, exact;
};

/// Sorted by coordinate.
using Profile = std::vector<ProfilePoint>;

/// Mean of |run - exact| over the points, weighted by their volumes:
///   points
///   l1_density, l1_velocity, l1_pressure                          over the largest |exact| among the points; NaN where that is 0
///   l1_density_kg_m3, l1_velocity_m_s, l1_pressure_pa             as they are
output::NamedNumbers profile_errors(const Profile& profile);

/// Means by volume over the points with low <= coordinate <= high, of the run and of the exact states; NaN without points.
struct ProfileMean {
  FlowState run, exact;
};
ProfileMean profile_mean(const Profile& profile, double low, double high);

/// The profile in shells `width` [m] wide: mean coordinate, volume and means by volume; empty shells are left out.
Profile shells(const Profile& profile, double width);

/// Where a front stands: walking in from the high end (or from the low one) the first place where `quantity` of the run
/// passes `level`, linear between points; NaN where it nowhere does.
double front_position(const Profile& profile, double FlowState::*quantity, double level, bool from_high);

/// Largest |run - exact| of the pressure [Pa] among the points that `counts` wants; NaN without any.
double largest_pressure_error(const Profile& profile, const std::function<bool(const ProfilePoint&)>& counts);

/// The points as a table: coordinate, body, volume, density, velocity, pressure, and the exact states in `exact_...`.
output::Samples profile_table(const Profile& profile);
/// The exact states alone, for a line through them.
output::Samples exact_profile_table(const Profile& profile);

}  // namespace undex::judge
