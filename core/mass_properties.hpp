// Volume, middle and moments of inertia of shapes of uniform density.
#pragma once

#include "core/shapes.hpp"

namespace undex {

struct MassProperties {
  double volume = 0;             ///< [m^3]; of a plane body per metre of depth, in one dimension per m^2
  Vec3 centroid = Vec3::Zero();  ///< [m]
  Mat3 inertia = Mat3::Zero();   ///< about it, of a density of 1 kg/m^3 [m^5]; of a plane body about z alone
};

/// Of a whole shape that ends somewhere: exact for those with a formula, to about 1e-4 for others. `of_revolution`: a section
/// about x = 0 in the plane, whose ring is meant.
MassProperties mass_properties(const Primitive& shape, int dimension, bool of_revolution = false);

}  // namespace undex
