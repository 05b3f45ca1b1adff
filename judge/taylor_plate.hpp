// Taylor's air-backed plate: a run beside the same plate, rigid, on a fine one-dimensional mesh, and beside linear theory.
#pragma once

#include "run/probes.hpp"
#include "output/run_record.hpp"
#include "judge/wave_metrics.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

/// Histories of the scene's wave and water against a rigid plate of the structure's mass per area with vacuum behind, on a
/// one-dimensional mesh, to `end` [s]. `refinement` scales its cells' number.
output::PlateHistories plate_in_one_dimension(const scene::Scene& scene, double end, int refinement = 1);

/// The metrics of judge/wave_metrics.hpp: of the run (pressure of the first wall probe, velocity of the compared one), of the
/// one-dimensional solution (label "_1d"), and of G. I. Taylor's linear theory ("_acoustic"); and
///   cavitation_error, impulse_error, end_impulse_error   of the run, as a share of the one-dimensional solution's
///   velocity_l1             mean difference of the plate's velocity from that solution, over its largest
output::NamedNumbers taylor_plate(const scene::Scene& scene, const run::Probes& probes, double end);

}  // namespace undex::judge
