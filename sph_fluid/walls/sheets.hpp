// The sheets of a mirror mesh: faces joined by edges across which the surface turns by less than seventy degrees. A sheet ends at
// its open edges: where the mesh ends, and where the wall turns away from the fluid, as a box does at its edges. Where the mesh
// ends at a radiating face of a container the wall goes on.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vector.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::sph {

class Sheets {
 public:
  /// Of a mesh that is one sheet without open edges.
  Sheets() = default;
  /// Where meshes end without an open edge: at symmetry planes and containers' faces they go on as their own images, at those
  /// that radiate as they are.
  struct Ends {
    std::array<bool, 3> symmetry{};
    SlipFaces fixed{}, radiating{};
    double tolerance = 0;  ///< [m]
  };
  /// Of faces (core/surface.hpp) with their nodes at `position` [m].
  Sheets(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position, const Ends& ends);

  int count() const { return count_; }
  int sheet(int face) const { return sheet_.empty() ? 0 : sheet_[face]; }
  /// Bit e: edge e of the face, from corner e to the next, is open.
  unsigned open(int face) const { return open_.empty() ? 0u : open_[face]; }
  /// Bit e: it is open and the wall goes on behind it.
  unsigned sharp(int face) const { return sharp_.empty() ? 0u : sharp_[face]; }
  /// Bit e: there the wall goes on beyond the mesh.
  unsigned goes_on(int face) const { return goes_on_.empty() ? 0u : goes_on_[face]; }

  /// Replaces normals at the corners of a face that lie on an edge between sheets: there they are those of the face's own sheet.
  /// Of nodes on a symmetry plane they lie in it.
  void part_normals(int face, std::span<const std::array<int, 4>> faces, std::span<const Vec3> position,
                    std::array<Vec3, 4>& normal) const;

 private:
  struct Corner {
    int face, corner;
    std::vector<int> mates;    // faces of the sheet at the corner's node, itself included
    std::array<bool, 3> kept;  // axes across which a symmetry plane holds the node
  };
  int count_ = 1;
  std::vector<int> sheet_;
  std::vector<unsigned> open_, sharp_, goes_on_;
  std::vector<Corner> corners_;  // on edges between sheets, sorted by face
};

}  // namespace undex::sph
