// comparison.kind = "free_field": a spherical charge in the open, beside its one-dimensional flow.
#pragma once

#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "output/series.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

/// A blast wave at a fixed point, run beside reference over the time a..b [s] that both cover:
///   peak_<name>_pa, arrival_<name>_s (half rise of the peak), impulse_<name>_pa_s (integral over a..b)
///   the same as peak_1d_<name>_pa ... of the reference
///   l1_pressure_<name>          mean of |p - reference| over a..b, over the reference's peak
/// Throws std::invalid_argument on a series that is not one.
output::NamedNumbers blast_metrics(const output::Series& pressure, const output::Series& reference, const std::string& name,
                                   double a, double b);

/// Pressures at the scene's fluid probes, in their order, from the charge's one-dimensional flow in unbounded water to `end` [s];
/// `charge_cells` cells in the charge, the water as fine.
std::vector<output::Series> free_field_in_one_dimension(const scene::Scene& scene, double end, int charge_cells);

}  // namespace undex::judge
