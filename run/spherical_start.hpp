// The spherical start: as long as the wave from a spherical charge has met nothing, the flow depends on radius and time
// alone. It is computed on a one-dimensional Lagrangian mesh far finer than any particle spacing (spherical_flow.hpp) and laid on
// the particles when its front nears the first obstacle, which takes away most of the error of a charge that is only a
// few particles wide.
#pragma once

#include <functional>
#include <string>

#include "scene/scene.hpp"

namespace undex::run {

/// Called as the one-dimensional flow goes on: its time [s], its front's radius and that of the first obstacle [m].
using StartProgress = std::function<void(double time, double front, double obstacle)>;

/// Computes the one-dimensional flow of the scene's charge and puts it into scene.fluid: the charge's shape grows to its
/// present radius, charge and medium get a start field, and the start time is set. Returns one line that says what was
/// done. Throws SceneError where the scene does not allow a spherical start: where anything but the charge would not stay as it
/// is until the particles take over.
std::string begin_spherically(scene::Scene& scene, const StartProgress& progress = {});

}  // namespace undex::run
