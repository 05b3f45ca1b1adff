// Names of the faces of walls, structures and solids.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/shapes.hpp"

namespace undex::scene {

/// Faces of a wall in a scene of that dimension: "x_low" ... or "side", "low", "high".
std::vector<std::string> wall_faces(const Primitive& container, int dimension);

/// Is it a cylinder or tube that the scene sees as a circle or ring, not as a strip?
bool is_round(const Primitive& shape, int dimension);

/// Faces of a solid body ("inner", "outer", "side", "low", "high", "x_low" ...), those that symmetry planes cut away left out.
std::vector<std::string> shape_faces(const Primitive& shape, int dimension, const std::array<bool, 3>& symmetric);

}  // namespace undex::scene
