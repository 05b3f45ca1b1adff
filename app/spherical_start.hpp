// The spherical start: as long as the wave from a spherical charge has met nothing, the flow depends on radius and time
// alone. It is computed on a one-dimensional Lagrangian mesh a hundred times finer than any particle spacing and laid on
// the particles when its front nears the first obstacle, which takes away most of the error of a charge that is only a
// few particles wide.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace undex::app {

/// Computes the one-dimensional flow of the scene's charge and puts it into scene.fluid: the charge's shape grows to its
/// present radius, charge and medium get a start field, and the start time is set. Returns one line that says what was
/// done. Throws SceneError where the scene does not allow a spherical start.
std::string begin_spherically(scene::Scene& scene);

}  // namespace undex::app
