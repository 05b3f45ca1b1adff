// Copies of walls' faces across symmetry planes and containers' slip faces, as the fluid has images there.
#pragma once

#include <array>
#include <vector>

#include "core/vector.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::sph {

struct FaceCopy {
  std::array<Vec3, 4> corner;  ///< [m]
  /// Are its corners in the order 0, 3, 2, 1 of the face? So they lie where an odd number of mirrors has been.
  bool turned;
};

/// The face itself first; none of the others farther behind its mirror than `reach` [m].
std::vector<FaceCopy> copies_of(const std::array<Vec3, 4>& corner, const SlipFaces& faces, const Settings& settings,
                                double reach);

}  // namespace undex::sph
