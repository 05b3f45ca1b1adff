// Which walls are thin: so thin, or ending so near, that particles on their sides are within reach of each other or of each
// other's images. Only there does it matter who sees whom (sight.hpp).
#pragma once

#include <vector>

#include "core/state.hpp"
#include "core/vector.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/walls/sheets.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::sph {

/// Cosine between normals of faces that look the same way.
constexpr double alike = 0.3;

class ThinWalls {
 public:
  /// Finds them where walls have moved since they were sought; `reach` [m] of pairs of liquid, `mirrors` of containers.
  void look(const std::vector<MirrorWall>& walls, const std::vector<Sheets>& sheets, const SlipFaces& mirrors,
            const Settings& settings, double reach);

  /// Is none thin?
  bool empty() const { return !any_; }
  /// Is it thin somewhere?
  bool contain(int wall) const { return any_ && thin_[wall]; }
  /// Has the face of a thin wall no open edge and no other wall within reach?
  bool is_plain(int wall, int face) const { return plain_[wall][face]; }
  /// Number of the face's sheet among those of all walls, from 1 on.
  int sheet(int wall, int face) const { return sheet_[wall][face]; }
  /// Bit e: edge e is open, and stands on no other wall.
  unsigned open(int wall, int face) const { return open_[wall][face]; }
  /// Bit e: beyond edge e the wall goes on.
  unsigned goes_on(int wall, int face) const { return goes_on_[wall][face]; }

  /// Where they were last sought.
  void visit_state(StateVisitor& state);
  std::size_t memory_bytes() const;

 private:
  class Search;
  bool have_moved(const std::vector<MirrorWall>& walls, double far) const;

  bool any_ = false, sought_ = false;
  std::vector<Vec3> looked_at_;           // nodes of all walls [m]
  std::vector<bool> thin_;                // per wall
  std::vector<std::vector<char>> plain_;  // per wall and face, as the next
  std::vector<std::vector<int>> sheet_;
  std::vector<std::vector<unsigned>> open_, goes_on_;
};

}  // namespace undex::sph
