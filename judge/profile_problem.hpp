// The problem with an exact solution that a scene poses: which of its bodies play which part. The states themselves stand in
// the bodies.
#pragma once

#include <cstddef>

#include "core/vector.hpp"
#include "scene/solution.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::judge {

struct ProfileProblem {
  scene::Solution solution = scene::Solution::riemann;
  std::size_t first = 0;       ///< body on the left; the charge; the hot gas; the falling gas
  std::size_t second = 0;      ///< body on the right; the cold gas
  bool plane = false;          ///< taylor_wave: a charge that fills a duct along x burns as in one dimension
  Vec3 center = Vec3::Zero();  ///< where the coordinate is zero [m]; riemann: the interface, the coordinate is x itself
};

/// Throws std::invalid_argument saying what the solution needs and the bodies do not have.
ProfileProblem profile_problem(const sph::Settings& fluid, scene::Solution solution);

}  // namespace undex::judge
