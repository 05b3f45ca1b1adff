// What a start from another run has laid, kept in the run's folder: a run that is gone on with needs its donor no more.
#pragma once

#include <filesystem>

#include "run/simulation.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// Keeps the fluid of a simulation at its start as folder/start.h5. Throws FileError.
void keep_start(const Simulation& simulation, const std::filesystem::path& folder);

/// Gives the scene's bodies the start that the folder keeps, to the same bits. False: there is none that is whole.
bool take_start(const std::filesystem::path& folder, scene::Scene& scene);

}  // namespace undex::run
