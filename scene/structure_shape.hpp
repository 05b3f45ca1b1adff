// The geometry of structures and solids as the shapes that scenes are checked with.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/hexahedral_mesh.hpp"
#include "core/meridian.hpp"
#include "core/shapes.hpp"
#include "fem_structure/settings.hpp"

namespace undex::scene {

/// Points spread over a face of a whole shape; none for an unknown face.
std::vector<Vec3> face_points(const Primitive& shape, const std::string& face);

/// Extent of a shape where it is thinnest: the wall of a tube, the diameter of a ball [m].
double thickness(const Primitive& shape, int dimension);

/// The shape of a structure: a built-in one, whole; or a gmsh mesh, which is the kept part. One of quadrangles is the section of
/// a body of revolution about the meridian's axis; places are in space all the same.
class StructureShape {
 public:
  explicit StructureShape(const fem::Mesh& mesh, const std::optional<Meridian>& meridian = {});

  const std::optional<Primitive>& built_in() const { return primitive_; }
  const std::shared_ptr<const HexahedralMesh>& mesh() const { return mesh_; }

  double signed_distance(const Vec3& x) const;
  Bounds extent() const;
  /// Where it is thinnest; of a gmsh mesh twice its volume over its surface [m].
  double thickness() const;
  /// Names of its faces, those that symmetry planes cut away left out.
  std::vector<std::string> faces(const std::array<bool, 3>& symmetric) const;
  std::vector<Vec3> face_points(const std::string& face) const;

 private:
  std::optional<Meridian> meridian_;  // of a mesh of quadrangles
  std::optional<Primitive> primitive_;
  std::shared_ptr<const HexahedralMesh> mesh_;
  std::shared_ptr<const MeshDistance> distance_;
};

/// Nothing for a gmsh mesh that was not read.
std::optional<StructureShape> structure_shape(const fem::Mesh& mesh, const std::optional<Meridian>& meridian);

}  // namespace undex::scene
