// A rigid, smooth plane that solids, of elements or of particles, cannot pass; they may leave it again.
#pragma once

namespace undex {

struct RigidPlane {
  int axis = 2;            ///< of its normal
  double position = 0;     ///< [m]
  bool body_above = true;  ///< do the bodies lie at x[axis] >= position? Otherwise at <=
};

}  // namespace undex
