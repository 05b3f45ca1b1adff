// The surface of a whole shape as a mesh of quadrilaterals (3D), segments (2D) or points' faces (1D): what a rigid body shows the
// water. Meshes are symmetric about the middle of the shape, with a line of nodes there, so that a symmetry plane through it cuts
// between faces.
#pragma once

#include <optional>

#include "core/shapes.hpp"
#include "core/surface.hpp"

namespace undex {

/// Faces about `spacing` [m] wide, normals into the body (WetSurface). Their nodes lie on the shape's surface; edges and corners
/// of the shape are edges and corners of faces. Nothing for a shape that has no closed surface in that dimension: a slab, and in
/// two dimensions a tube along x or y. In one dimension a face is a square of 1 m^2 across x.
std::optional<WetSurface> closed_surface(const Primitive& shape, double spacing, int dimension);

/// Leaves out the faces of which `dry` is true, and nodes that no face is left at.
WetSurface without(const WetSurface& surface, const std::vector<bool>& dry);

/// Area of a face [m^2]; of a segment its length by 1 m.
double face_area(const std::array<int, 4>& face, std::span<const Vec3> position);

}  // namespace undex
