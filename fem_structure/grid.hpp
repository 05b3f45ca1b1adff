// Mesh of a structure as plain arrays, and the place of a point in it. deal.II builds it (deal_mesh.cpp) and stays there.
#pragma once

#include <array>
#include <memory>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/hexahedral_mesh.hpp"
#include "core/vector.hpp"
#include "fem_structure/settings.hpp"

namespace undex::fem {

/// Trilinear shape functions on the unit cube and the 2x2x2 Gauss rule, nodes in VTK hexahedron order. Of a meridian: bilinear
/// ones of four nodes on the unit square; the 2x2 points come twice, for two cells, and the weights of each four sum to 1.
struct ReferenceCell {
  double gradient[3][8][8];  ///< [direction][node][quadrature point], per unit coordinate
  double value[8][8];        ///< [node][quadrature point]
  double point[8][3];        ///< [quadrature point][direction] in [0,1]^3, x fastest
  double weight[8];          ///< sum 1
};

/// Cells and their named boundary faces: hexahedra, or the quadrangles of a meridian in the doubled form of
/// core/hexahedral_mesh.hpp, with positions (r, axial, 0) and volumes of rings.
struct Grid {
  bool axisymmetric = false;
  std::vector<Vec3> nodes;                          ///< reference positions [m]
  std::vector<std::array<int, 8>> cells;            ///< VTK hexahedron order
  std::vector<std::array<double, 8>> nodal_volume;  ///< integral of each shape function over its cell [m^3]; of a ring's four
  /// Boundary quadrilaterals, or segments (core/surface.hpp), by name; (x1 - x0) x (x3 - x0) points into the structure.
  std::map<std::string, std::vector<std::array<int, 4>>> faces;
  ReferenceCell reference;
  std::vector<HexahedralMesh::Tie> ties;
  std::vector<int> groups;  ///< physical group of each cell; empty: none has one
  GroupNames group_names, face_names;
};

/// Cell and unit coordinates of a point, with the distance [m] to it when it lies outside the mesh.
struct Place {
  std::size_t cell;
  std::array<double, 3> unit;
  double distance;
};

struct DealMesh;

/// A mesh held by deal.II, from which the plain arrays were taken.
class Mesher {
 public:
  /// Throws std::invalid_argument with every mistake of the mesh settings, FileError where the library that builds meshes is not
  /// to be found.
  explicit Mesher(const Settings& settings);
  ~Mesher();
  Mesher(Mesher&&) noexcept;
  Mesher& operator=(Mesher&&) noexcept;

  const Grid& grid() const;
  /// The cell of the reference mesh that contains the point, or nothing when the point is outside.
  std::optional<Place> containing_cell(const Vec3& reference_position) const;

 private:
  std::unique_ptr<DealMesh> held_;
};

/// Place of the point of the mesh nearest to `reference_position`, by projection onto every cell in reach.
Place nearest_place(const Grid& grid, const Vec3& reference_position);

/// Trilinear shape functions at unit coordinates, in VTK order; of a quadrangle at its third coordinate 1/2, for each node twice.
std::array<double, 8> shape_values(const std::array<double, 3>& unit);

}  // namespace undex::fem
