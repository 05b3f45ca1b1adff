// Dummy particles of all lined walls, rigid and moving, as pairs read them: packed into rows, sorted by cell. Where a moving wall
// ends at a face in which the fluid is mirrored, its particles have copies behind that face, as the fluid has images.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::sph {

class WallLining {
 public:
  /// Must they be packed (anew)?
  bool waits(const Settings& settings, const std::vector<LinedWall>& moving) const;
  /// Where no wall moves this is done once, and what they are made from is not kept. Throws std::invalid_argument in a meridian.
  void pack(const Settings& settings, const std::vector<LinedWall>& moving, const SlipFaces& faces);
  bool packed() const { return packed_; }

  void describe(PairInput& in) const;
  /// Is a particle behind the surface of its wall (LinedWall::faces)? In the rows' order.
  std::span<const char> behind_surface() const { return behind_surface_; }
  /// What pairs add to; null where no lined wall moves.
  ForceRow* forces() { return force_.empty() ? nullptr : force_.data(); }
  void clear_forces();
  /// Gives the forces to the moving walls' particles [N]; returns their power [W].
  double scatter(PointLoads& force) const;

  /// Is one of the particles nearer to the box than `reach` [m]?
  bool reaches(const Vec3& low, const Vec3& high, double reach) const;
  std::size_t size() const { return origin_.size(); }
  std::size_t memory_bytes() const;

 private:
  struct Origin {
    int wall;  // among the moving ones, or -1 - number of a rigid one
    std::uint32_t point;
    Vec3 place;         // [m]
    int mirrored = -1;  // a copy: the matrix that reflects its vectors, in mirrors_
  };
  /// Appends the copies of the origins from `first` on; none farther behind a face than `depth` [m].
  void mirror(const SlipFaces& faces, double depth, int dimension, std::size_t first, std::vector<Origin>& origins);
  std::vector<LinedWall> rigid_;
  std::vector<Origin> origin_;
  std::vector<Mat3> mirrors_;
  std::vector<double> place_[3];  // sorted by cell, as the next two
  std::vector<WallRow> rows_;
  std::vector<char> behind_surface_;
  std::vector<ForceRow> force_;
  CellList cells_;
  bool packed_ = false;
};

}  // namespace undex::sph
