// comparison.kind = "taylor_bar": the shape of a round bar that has hit a rigid anvil.
#pragma once

#include <vector>

#include "core/vector.hpp"
#include "output/run_record.hpp"

namespace undex::judge {

/// A round bar that has hit an anvil, from points of its deformed body [m] (nodes, particles): `axis` 0, 1 or 2 along the
/// bar, `center` on its axis; the foot is the end with the smaller coordinate. `skin` [m] is how far the surface lies
/// beyond the outermost points (half a spacing of particles, zero for nodes).
///   final_length_m
///   foot_radius_m           largest radius in the lowest tenth of the initial length (the mushroom's)
///   radius_at_fifth_m       at a fifth of the initial length above the foot, between the widest points of a slice of a
///                           twentieth below that height and of one above it; NaN where a slice has none
output::NamedNumbers taylor_bar_metrics(const std::vector<Vec3>& points, int axis, const Vec3& center, double initial_length,
                                        double skin = 0.0);

}  // namespace undex::judge
