// The faces of a solid's shape, by name: which one a point lies behind, and how deep.
#pragma once

#include <string>
#include <vector>

#include "sph_solid/settings.hpp"

namespace undex::solid {

/// Names of the faces of a shape: box "x_low" ... "z_high"; cylinder "side", "low", "high"; tube "inner", "outer", "low",
/// "high"; sphere "side".
std::vector<std::string> solid_faces(const Primitive& shape, int dimension);

struct Face {
  double depth = 0;             ///< of the point behind the face [m]
  Vec3 outward = Vec3::Zero();  ///< unit normal
};

/// The nearest of the body's wet faces (of all, where it names none). Faces are taken as endless: a point near an edge lies
/// behind both.
Face nearest_face(const Body& body, const Vec3& x, int dimension);

}  // namespace undex::solid
