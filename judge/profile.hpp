// Comparison of the particles with an exact solution in space: comparison.kind = "profile".
#pragma once

#include <filesystem>

#include "run/simulation.hpp"
#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

/// Metrics of the present state (docs/outputs.md, "Metrics: profile"); writes profile.csv and profile_exact.csv into `folder`.
output::NamedNumbers compare_profile(const scene::Scene& scene, const run::Simulation& simulation,
                                     const std::filesystem::path& folder);

}  // namespace undex::judge
