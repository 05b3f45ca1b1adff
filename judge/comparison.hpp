// The named results of a run, beside what others got.
#pragma once

#include <filesystem>
#include <string>

#include "run/probes.hpp"
#include "run/simulation.hpp"
#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

/// Metrics of the scene's comparison (none: empty), from its probes, the body's present shape or the particles; NaN for what
/// did not happen or was not reached. A profile is written into `folder` as well.
/// The scene is the one given, before a spherical start changes it.
output::NamedNumbers compare(const scene::Scene& scene, const run::Simulation& simulation, const run::Probes& probes,
                             const std::filesystem::path& folder);

/// The same beside the reference table, as text (a profile's alone); empty where the scene names no reference.
std::string comparison_table(const scene::Scene& scene, const output::NamedNumbers& metrics);

}  // namespace undex::judge
