// Structured cells of tubes, rods and plates, as vertices, cells and named boundary faces, before deal.II sees them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vector.hpp"
#include "fem_structure/settings.hpp"

namespace undex::fem {

/// Vertices of cells and faces run lexicographically (first direction fastest), as deal.II wants them. Those of a meridian's
/// quadrangles and of their sides come twice.
struct Blocks {
  struct Face {
    std::array<unsigned, 4> vertices;
    int name;  ///< index into names
  };
  std::vector<Vec3> vertices;
  std::vector<std::array<unsigned, 8>> cells;
  std::vector<Face> faces;
  std::vector<std::string> names;
};

/// The part of the body that the symmetry planes keep. Throw std::invalid_argument with every mistake found, each with
/// its value and remedy; `who` opens the message.
Blocks build_blocks(const TubeMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who);
Blocks build_blocks(const RodMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who);
Blocks build_blocks(const PlateMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who);

/// The same of the body's meridian (Settings::axisymmetric): a rectangle. A box has none.
Blocks build_meridian(const TubeMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who);
Blocks build_meridian(const RodMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who);
Blocks build_meridian(const PlateMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who);

}  // namespace undex::fem
