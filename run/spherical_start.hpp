// The spherical start: as long as the wave from a spherical charge has met nothing, the flow depends on radius and time
// alone. It is computed on a one-dimensional Lagrangian mesh far finer than any particle spacing (spherical_flow.hpp) and laid on
// the particles when its front nears the first obstacle, which takes away most of the error of a charge that is only a
// few particles wide. Of several charges each has a flow of its own, until two of their waves are about to meet.
#pragma once

#include <string>

#include "run/stages.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// At the start [Pa].
double start_pressure(const sph::Body& body);

/// Is it told to move, driven by a force, or in motion at the start?
bool moves_by_itself(const coupling::Obstacle& obstacle);

/// Throws SceneError, as the scene's start.kind, where anything would not stay as it is until the particles take over: all but
/// the bodies in motion (indices) must be at rest under the pressure that `medium` has at rest.
void require_rest(const scene::Scene& scene, const std::vector<std::size_t>& in_motion, const sph::Body& medium);

/// Computes the one-dimensional flows of the scene's charges and puts them into scene.fluid: the charges' shapes grow to their
/// present radii, charges and medium get start fields, and the start time is set. Returns one line that says what was
/// done. Throws SceneError where the scene does not allow a spherical start: where anything but the charges would not stay as it
/// is until the particles take over.
std::string begin_spherically(scene::Scene& scene, Stages& stages);
inline std::string begin_spherically(scene::Scene& scene) {
  Stages silent;
  return begin_spherically(scene, silent);
}

}  // namespace undex::run
