// The exact solutions that a run can be compared with: comparison.solution.
#pragma once

namespace undex::scene {

enum class Solution {
  riemann,      ///< two uniform states side by side along x
  taylor_wave,  ///< detonation from a point (a rigid wall in one dimension)
  sedov,        ///< energy set free at a point (axis, plane) of a cold gas
  noh,          ///< a cold gas falls on a point (axis, plane)
};

/// As a scene file names it.
inline const char* solution_name(Solution solution) {
  switch (solution) {
    case Solution::riemann: return "riemann";
    case Solution::taylor_wave: return "taylor_wave";
    case Solution::sedov: return "sedov";
    case Solution::noh: break;
  }
  return "noh";
}

}  // namespace undex::scene
