// The named results of a run, beside what others got.
#pragma once

#include <string>

#include "app/probes.hpp"
#include "app/simulation.hpp"
#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::app {

/// Metrics of the scene's comparison (none: empty), from its probes or the body's present shape; NaN for what did not happen or was not reached.
output::NamedNumbers compare(const scene::Scene& scene, const Simulation& simulation, const Probes& probes);

/// The same beside the reference table, as text; empty where the scene names no reference.
std::string comparison_table(const scene::Scene& scene, const output::NamedNumbers& metrics);

}  // namespace undex::app
