// Names of the faces of walls and structures.
#pragma once

#include <string>
#include <vector>

#include "core/shapes.hpp"
#include "fem_structure/settings.hpp"

namespace undex::scene {

/// Faces of a wall in a scene of that dimension: "x_low" ... or "side", "low", "high".
std::vector<std::string> wall_faces(const Primitive& container, int dimension);

/// Faces of a structure, those that symmetry planes cut away left out; empty for a gmsh mesh, whose faces are the ids in
/// its file.
std::vector<std::string> structure_faces(const fem::Mesh& mesh, const std::vector<int>& symmetry_axes);

}  // namespace undex::scene
