// What a structure shows of itself to the outside world: points, faces and their motion; impulses come back.
#pragma once

#include <array>
#include <vector>

#include "core/vector.hpp"

namespace undex {

/// The wet faces of a structure: bilinear quadrilaterals on nodes. Node order of a face is such that
/// (x1 - x0) x (x3 - x0) points INTO the structure, away from the fluid.
struct WetSurface {
  std::vector<Vec3> nodes;                 ///< reference positions [m], one per wet node
  std::vector<std::array<int, 4>> faces;   ///< indices into nodes
};

}  // namespace undex
