// The start from another run (users of hydrocodes call it remapping): a scene in space or in a meridian begins from the state to
// which a spherical, axisymmetric or three-dimensional run, the donor, has come. Beyond what the donor's wave has reached the
// scene's own start stands.
#pragma once

#include <string>

#include "run/starts.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// Computes the donor that start.from names up to start.time, or until its first wave nears what only one of the two scenes has,
/// and gives its state to the scene's bodies of the same names: their masses, momenta and energies become the donor's. Returns
/// one line that says what was done. Throws SceneError where the scene or the donor do not allow it.
std::string begin_from_run(scene::Scene& scene, const StartOptions& options, Stages& stages);

}  // namespace undex::run
