// Scenes of revolution: what keeps a scene in space from being one, and what the solvers of the meridian are given in its place.
#pragma once

#include <string>
#include <vector>

#include "core/meridian.hpp"
#include "scene/scene.hpp"

namespace undex::scene {

/// A key of the scene and why it is not of revolution.
struct Objection {
  std::string key, why;
};

/// All that keeps a scene from being computed in its meridian about this axis; empty where it can be.
std::vector<Objection> objections(const Scene& scene, const Meridian& meridian);

/// The scene's line of revolution along an axis: through the middle of what is round about it.
Meridian line_along(const Scene& scene, int axis);

/// The axis with the fewest objections.
int likeliest_axis(const Scene& scene);

/// Volume [m^3] of the part of a shape that the scene's symmetry planes keep; in one and two dimensions length and area.
double kept_volume(const Shape& shape, const Scene& scene);

/// How many mirror images of what is computed, itself included, make the whole that the scene stands for.
int mirror_copies(const Scene& scene);

/// What the solvers compute: an axisymmetric scene in its meridian (x: distance from the axis, y: along it), any other as it is.
Scene for_solvers(const Scene& scene);

}  // namespace undex::scene
