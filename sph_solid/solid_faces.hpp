// The faces of a solid's shape, by name: which one a point lies on.
#pragma once

#include <string>
#include <vector>

#include "sph_solid/settings.hpp"

namespace undex::solid {

/// Names of the faces of a shape: box "x_low" ... "z_high"; cylinder "side", "low", "high"; tube "inner", "outer", "low",
/// "high"; sphere "side".
std::vector<std::string> solid_faces(const Primitive& shape, int dimension);

/// Is the face that x lies nearest to one of the body's wet faces (of all, where it names none)? Faces are taken as endless.
bool is_wet(const Body& body, const Vec3& x, int dimension);

/// Does x [m], within the body, lie within `depth` [m] of the face of that name, taken as endless?
bool is_near_face(const Body& body, const std::string& face, const Vec3& x, double depth, int dimension);

}  // namespace undex::solid
