// What a run of a scene would be.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace undex::run {

/// Particles by body, cells, expected step, steps, memory and run time, as text of several lines. The solvers are set up
/// and a few steps are taken to know; nothing is written. Throws SceneError where a solver refuses its part of the scene.
std::string describe(const scene::Scene& scene);

}  // namespace undex::run
