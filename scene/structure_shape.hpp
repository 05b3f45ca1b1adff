// The geometry of structures and solids as the shapes that scenes are checked with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/shapes.hpp"
#include "fem_structure/settings.hpp"

namespace undex::scene {

/// Nothing for a gmsh mesh.
std::optional<Primitive> structure_shape(const fem::Mesh& mesh);

/// Points spread over a face of a whole shape; none for an unknown face.
std::vector<Vec3> face_points(const Primitive& shape, const std::string& face);

/// Extent of a shape where it is thinnest: the wall of a tube, the diameter of a ball [m].
double thickness(const Primitive& shape, int dimension);

}  // namespace undex::scene
