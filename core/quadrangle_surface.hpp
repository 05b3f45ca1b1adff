// A surface of quadrangles in space as a file gives it, and the layer of hexahedra that a thickness makes of it.
//
// At an edge of two quadrangles the layer goes on, bent by a mitre where they meet at an angle. Where more meet, the two that
// go on straightest (of several such pairs the thickest) are one layer, and each of the others is a layer of its own. That one
// begins at the face of the first, so that no volume is there twice, and its nodes there are tied to that face.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/hexahedral_mesh.hpp"
#include "core/record.hpp"

namespace undex {

struct QuadrangleSurface {
  std::vector<Vec3> nodes;                ///< [m], each a corner of some cell
  std::vector<std::array<int, 4>> cells;  ///< nodes in order round it
  std::vector<int> groups;                ///< physical group of each cell
  struct Edge {
    std::array<int, 2> nodes;
    int id;  ///< its physical group
  };
  std::vector<Edge> edges;  ///< those that a file lists
  GroupNames group_names, edge_names;
  std::vector<std::string> remarks;
};

/// Where a layer lies from its quadrangles, whose normals point to its top.
enum class ShellOffset {
  mid,     ///< half to either side
  top,     ///< all on the side of the normal
  bottom,  ///< all on the other side
};
constexpr auto words(ShellOffset) {
  return std::to_array<Word<ShellOffset>>(
      {{"mid", ShellOffset::mid}, {"top", ShellOffset::top}, {"bottom", ShellOffset::bottom}});
}
struct Layer {
  double thickness;  ///< [m]
  ShellOffset offset = ShellOffset::mid;
};

/// One hexahedron for each quadrangle, in their order, 0 to 3 at its bottom and 4 to 7 at its top (HexahedralMesh::is_shell).
/// Its faces are called "<group>.top" and "<group>.bottom", what stands on another layer "<group>.root", those over outer
/// edges by the group of the edge. Nodes lie along the mean normal of the cells, such that the layer is as thick as said over
/// each of them; where the thickness changes it does so within the cells at the change. Normals of one layer are made to
/// agree with most of it as listed, which is remarked. The surface is the part at and above the planes of symmetry through
/// the origin (axes 0, 1, 2), in which it is mirrored.
///
/// Throws std::invalid_argument, beginning with `path`, where the layer would cross itself: folded surfaces, Moebius strips,
/// thickness beyond what curvature and cells bear, three quadrangles of which no two go on in one another.
HexahedralMesh thickened(const QuadrangleSurface& surface, const std::function<Layer(int group)>& layer_of,
                         const std::vector<int>& symmetry_axes, const std::string& path);

}  // namespace undex
