// A mesh of hexahedra as a file gives it, and what checks ask of it: its outer faces, its pieces, the distance of a point.
//
// The mesh of a meridian (of an axisymmetric scene) is held alike: a quadrangle a, b, c, d in the plane z = 0 is the cell
// {a, b, c, d, a, b, c, d}, its side from a to b the face {a, b, b, a}. Where geometry is asked for, both are drawn out along z.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/vector.hpp"

namespace undex {

/// Physical groups of a mesh: their names by their numbers. Without a name the number is the name, "0" of what has no group.
struct GroupNames {
  std::map<int, std::string> given;

  std::string of(int id) const {
    const auto found = given.find(id);
    return found == given.end() ? std::to_string(id) : found->second;
  }
  /// The name of the group that a text means: its name, or its number.
  std::string meant_by(const std::string& text) const {
    for (const auto& [id, name] : given)
      if (text == std::to_string(id)) return name;
    return text;
  }
};

struct HexahedralMesh {
  std::vector<Vec3> nodes;                ///< [m], each a corner of some cell
  std::vector<std::array<int, 8>> cells;  ///< nodes in VTK's order, or mirrored; all of them hexahedra, or all quadrangles
  struct Face {
    std::array<int, 4> nodes;  ///< round it
    int id;                    ///< its physical group; 0: none
  };
  std::vector<Face> faces;  ///< all outer ones
  /// A node that lies on a face of another cell and moves with it: at the mean of other nodes, which are tied to none, by weights
  /// of 0 to 1 whose sum is 1.
  struct Tie {
    int node;
    std::vector<std::pair<int, double>> to;
  };
  std::vector<Tie> ties;
  std::vector<int> groups;  ///< physical group of each cell; empty: none has one
  GroupNames face_names, group_names;
  bool is_shell = false;             ///< one layer of cells, whose first four nodes are one side of it and the others the other
  std::vector<std::string> remarks;  ///< what a file says and the mesh has otherwise
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
