// What two scenes do not share, and what neither gives to the other: where a wave of the one must not have come before its state
// may be laid over the other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace undex::run {

struct Undisturbed {
  std::string name;                             ///< in words
  std::function<double(const Vec3&)> distance;  ///< from a place in space [m]; it changes by at most the way between two places
};

/// The order of what is removed does not count.
bool same_shape(const Shape& one, const Shape& other);

/// Walls, bodies of fluid and surfaces of theirs that only one of the scenes has; structures, solids and rigid bodies of either.
/// Radiating faces of the scene are none of them.
std::vector<Undisturbed> not_shared_by(const scene::Scene& scene, const scene::Scene& donor);

}  // namespace undex::run
