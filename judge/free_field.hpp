// A spherical charge in the open: pressures of a run beside the one-dimensional solution.
#pragma once

#include "run/probes.hpp"
#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

/// Pressures at the scene's fluid probes, in their order, from the charge's one-dimensional flow in unbounded water to `end` [s];
/// `charge_cells` cells in the charge, the water as fine.
std::vector<output::Series> free_field_in_one_dimension(const scene::Scene& scene, double end, int charge_cells);

/// blast_metrics (judge/wave_metrics.hpp) of every fluid probe, from the run's first row to `end` [s]. The scene is the one
/// given, its charge not yet grown.
output::NamedNumbers free_field(const scene::Scene& scene, const run::Probes& probes, double end);

}  // namespace undex::judge
