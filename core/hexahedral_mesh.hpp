// A mesh of hexahedra as a file gives it, and what checks ask of it: its outer faces, its pieces, the distance of a point.
//
// The mesh of a meridian (of an axisymmetric scene) is held alike: a quadrangle a, b, c, d in the plane z = 0 is the cell
// {a, b, c, d, a, b, c, d}, its side from a to b the face {a, b, b, a}. Where geometry is asked for, both are drawn out along z.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/vector.hpp"

namespace undex {

struct HexahedralMesh {
  std::vector<Vec3> nodes;                ///< [m], each a corner of some cell
  std::vector<std::array<int, 8>> cells;  ///< nodes in VTK's order, or mirrored; all of them hexahedra, or all quadrangles
  struct Face {
    std::array<int, 4> nodes;  ///< round it
    int id;                    ///< its physical group; 0: none
  };
  std::vector<Face> faces;  ///< all outer ones
};

/// The six faces of a hexahedron in VTK's order, each round its normal to the outside.
constexpr int hexahedron_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Is the cell a quadrangle of a meridian?
constexpr bool is_quadrangle(const std::array<int, 8>& cell) { return cell[0] == cell[4]; }

/// The corners [m] of a cell: those of a quadrangle half a metre to either side of its plane.
std::array<Vec3, 8> corners_of(const std::array<int, 8>& cell, std::span<const Vec3> position);

/// Three times the volume of the corner's three edges for each of the eight corners: all of one sign in a sound cell [m^3].
std::array<double, 8> corner_volumes(const std::vector<Vec3>& nodes, const std::array<int, 8>& cell);

Bounds bounds(const HexahedralMesh& mesh);

/// The faces that one cell alone has, without a group.
std::vector<HexahedralMesh::Face> outer_faces(const HexahedralMesh& mesh);

/// Which piece each cell belongs to, numbered from 0; cells of one piece are joined by faces, or by nodes.
enum class JoinedBy { faces, nodes };
std::vector<int> pieces(const HexahedralMesh& mesh, JoinedBy by);

/// Distances of points to a mesh: a tree of boxes over its faces and cells, made once.
class MeshDistance {
 public:
  explicit MeshDistance(std::shared_ptr<const HexahedralMesh> mesh);
  ~MeshDistance();
  MeshDistance(MeshDistance&&) noexcept;
  MeshDistance& operator=(MeshDistance&&) noexcept;

  /// To the surface [m], negative inside a cell. Faces are taken as four triangles about their middle.
  double signed_distance(const Vec3& x) const;

 private:
  struct Trees;
  std::shared_ptr<const HexahedralMesh> mesh_;
  std::unique_ptr<Trees> trees_;
};

/// Distance of a point to a triangle [m] (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
double distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace undex
