// Down the forces to where they vanish, by the limited-memory BFGS method (Nocedal 1980, Math. Comput. 35, 773).
#pragma once

#include <vector>

#include "core/vector.hpp"

namespace undex {

class Descent {
 public:
  /// The next step from the places `x` [m], at which the forces are `force`, in units of length. The first one goes along them.
  std::vector<Vec3> step(const std::vector<Vec3>& x, const std::vector<Vec3>& force);

 private:
  /// From one step to the next, of the forces with the other sign.
  struct Change {
    std::vector<Vec3> place, force;
    double curvature;  // their product
  };
  void remember(const std::vector<Vec3>& x, const std::vector<Vec3>& force);

  std::vector<Change> changes_;  // the last ones, oldest first
  std::vector<Vec3> x_, force_;
};

}  // namespace undex
