// The door to deal.II. What uses it (deal_mesh.cpp) is a shared library of its own, undex_meshes, which the program loads when
// the first mesh is asked for: deal.II brings two hundred libraries, whose loading costs a third of a second and 110 MB, and
// runs without a structure do without.
#pragma once

#include <optional>

#include "core/hexahedral_mesh.hpp"
#include "fem_structure/blocks.hpp"
#include "fem_structure/grid.hpp"

namespace undex::fem {

/// What a mesh is made from: one of the two.
struct MeshSource {
  bool axisymmetric = false;
  const Blocks* blocks = nullptr;
  const HexahedralMesh* mesh = nullptr;
};

/// A mesh held by deal.II, and the plain arrays that were taken from it.
struct DealMesh {
  Grid grid;

  virtual ~DealMesh() = default;
  virtual std::optional<Place> containing_cell(const Vec3& reference_position) = 0;
};

}  // namespace undex::fem

/// All that undex_meshes exports. The caller owns the mesh. Throws what deal.II throws.
extern "C" undex::fem::DealMesh* undex_deal_mesh(const undex::fem::MeshSource& source);
