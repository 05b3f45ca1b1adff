// A drawing of a scene before it is run.
#pragma once

#include <string>

#include "run/simulation.hpp"

namespace undex::run {

/// SVG of the scene at its start, in the plane in which it is computed: in two dimensions x and y, of revolution the distance
/// from the axis and along it; in three the plane x, z through the middle of all that lies in y (or the symmetry plane y = 0).
/// Particles of the water and of solids, and nodes of structures, within three quarters of a spacing are squares coloured by
/// body; obstacles and walls are their outlines, probes crosses with their names.
std::string picture(const scene::Scene& scene, const Simulation& simulation);

}  // namespace undex::run
