// What a structure shows of itself to the outside world: points, faces and their motion; impulses come back.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/vector.hpp"

namespace undex {

/// The wet faces of a structure: bilinear quadrilaterals on nodes, or in two dimensions segments, whose nodes lie at z = 0 (in an
/// axisymmetric scene at (r, axial, 0)): a segment from a to b is the face {a, b, b, a} (see corners_of). Node order of a face is
/// such that (x1 - x0) x (x3 - x0) of its corners points INTO the structure, away from the fluid.
struct WetSurface {
  std::vector<Vec3> nodes;                ///< reference positions [m], one per wet node
  std::vector<std::array<int, 4>> faces;  ///< indices into nodes
};

/// Faces of it that are one face of the body, by a name that the scene knows: those from `first` to below `last`.
struct NamedFaces {
  std::string name;
  std::size_t first, last;
};

/// Is the face a segment of a plane or a meridian?
inline bool is_segment(const std::array<int, 4>& face) { return face[0] == face[3]; }

/// The corners [m] of a face. A segment is drawn out along z, half a metre to either side, so that it is a bilinear face over
/// whose middle the plane lies: normals, projections and weights are those of any face.
inline std::array<Vec3, 4> corners_of(const std::array<int, 4>& face, std::span<const Vec3> position) {
  std::array<Vec3, 4> corner{position[face[0]], position[face[1]], position[face[2]], position[face[3]]};
  if (is_segment(face))
    for (int c = 0; c < 4; ++c) corner[c][2] += c < 2 ? -0.5 : 0.5;
  return corner;
}

/// A point of the surface: a face, and the weights of its nodes.
struct SurfaceFoot {
  int face = -1;
  std::array<double, 4> weight{};
  double distance = 0;  ///< to the place that it was sought for [m]
};

/// The point of the reference surface nearest to x [m], among nine by nine on each face.
SurfaceFoot nearest_foot(const WetSurface& surface, const Vec3& x);

/// The image of a place or vector across symmetry planes through the origin; bit a of `axes`: across axis a.
inline Vec3 mirrored(Vec3 x, unsigned axes) {
  for (int a = 0; a < 3; ++a)
    if (axes >> a & 1) x[a] = -x[a];
  return x;
}

/// Area [m^2] of each node: a quarter of each of its faces; of a segment's ring the integral of the node's shape function.
/// Without `rings` segments are those of a plane, a metre deep.
std::vector<double> nodal_areas(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position, bool rings = true);

/// Unit normals at the nodes of faces, away from the fluid: means weighted by area. Those of nodes on a symmetry plane (through
/// the origin, across a marked axis) lie in it.
std::vector<Vec3> node_normals(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position,
                               const std::array<bool, 3>& symmetry);

}  // namespace undex
