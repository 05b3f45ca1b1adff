// The problem with an exact solution that a scene poses: which of its bodies play which part. The states themselves stand in
// the bodies.
#pragma once

#include <optional>
#include <string>

#include "core/vector.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::scene {

/// Solutions that a run can be compared with.
enum class Solution {
  riemann,      ///< two uniform states side by side along x
  taylor_wave,  ///< detonation from a point (a rigid wall in one dimension)
  sedov,        ///< energy set free at a point (axis, plane) of a cold gas
  noh,          ///< a cold gas falls on a point (axis, plane)
};

const char* solution_name(Solution solution);

struct ProfileProblem {
  Solution solution = Solution::riemann;
  std::size_t first = 0;       ///< body on the left; the charge; the hot gas; the falling gas
  std::size_t second = 0;      ///< body on the right; the cold gas
  bool plane = false;          ///< taylor_wave: a charge that fills a duct along x burns as in one dimension
  Vec3 center = Vec3::Zero();  ///< where the coordinate is zero [m]; riemann: the interface, the coordinate is x itself
};

/// Throws std::invalid_argument saying what the solution needs and the bodies do not have.
ProfileProblem profile_problem(const sph::Settings& fluid, Solution solution);

}  // namespace undex::scene
