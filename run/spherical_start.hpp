// The spherical start: as long as the wave from a spherical charge has met nothing, the flow depends on radius and time
// alone. It is computed on a one-dimensional Lagrangian mesh a hundred times finer than any particle spacing and laid on
// the particles when its front nears the first obstacle, which takes away most of the error of a charge that is only a
// few particles wide.
#pragma once

#include <string>

#include "exact/lagrangian_1d.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// Computes the one-dimensional flow of the scene's charge and puts it into scene.fluid: the charge's shape grows to its
/// present radius, charge and medium get a start field, and the start time is set. Returns one line that says what was
/// done. Throws SceneError where the scene does not allow a spherical start.
std::string begin_spherically(scene::Scene& scene);

/// The scene's spherical charge as it is at time zero. Throws SceneError where there is none.
Sphere spherical_charge(const scene::Scene& scene);

/// Its one-dimensional flow in the medium, which reaches out to the radius `outer` [m] and there lets the wave pass; the
/// charge's radius is cut into `charge_cells` cells, the medium into cells as wide.
exact::Lagrangian1D spherical_flow(const scene::Scene& scene, double outer, int charge_cells);

}  // namespace undex::run
