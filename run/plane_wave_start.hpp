// A start with a plane wave in one body: the incident wave of an explosion far away (exact/plane_wave.hpp).
#pragma once

#include <string>

#include "exact/plane_wave.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// The body of the scene that carries the wave of start.kind = "plane_wave" (index).
std::size_t wave_body(const scene::Scene& scene);

/// That wave, in the body at rest. Throws SceneError where the body cannot carry it.
exact::PlaneWave plane_wave(const scene::Scene& scene);

/// Puts the wave into scene.fluid as the body's start field. Returns one line that says what was done.
std::string begin_with_plane_wave(scene::Scene& scene);

}  // namespace undex::run
