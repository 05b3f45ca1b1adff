// What each named face of a wet surface receives. The nodes receive impulses; those on an edge of two faces share theirs.
#pragma once

#include <span>
#include <vector>

#include "core/state.hpp"
#include "core/surface.hpp"

namespace undex::coupling {

class FaceImpulses {
 public:
  FaceImpulses(const WetSurface& surface, std::vector<NamedFaces> faces);

  /// Adds the impulses of the nodes [N s], which are at `position` [m]. A node between faces gives each what a pressure there
  /// would give it, the pressure being that whose force comes nearest to the node's; what is no pressure goes by area. So the sum
  /// is exact, and so is the face's part under any pressure that does not jump at the edge.
  void book(std::span<const Vec3> impulse, std::span<const Vec3> position);

  const std::vector<NamedFaces>& faces() const { return faces_; }
  /// Since the start [N s], of each.
  const std::vector<Vec3>& impulse() const { return impulse_; }

  void visit_state(StateVisitor& state) { state("impulse of faces", impulse_); }

 private:
  struct Corner {
    std::array<int, 4> face;
    int named;  ///< which of faces_
  };
  struct Edge {
    std::size_t node;
    std::vector<Corner> corners;
  };

  std::vector<NamedFaces> faces_;
  std::vector<int> owner_;  // of each node which of faces_; -1: none, or one of edges_
  std::vector<Edge> edges_;
  std::vector<Vec3> impulse_;
};

}  // namespace undex::coupling
