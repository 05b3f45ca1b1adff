// Particles before the meshes of mirror walls: where each stands over them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/bilinear_patch.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/walls/footprint.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/walls/particles.hpp"
#include "sph_fluid/walls/sheets.hpp"

namespace undex::sph {

/// Particles sorted by cells, of which those nearer to a wall than `depth` have images.
struct ParticleRange {
  std::uint32_t first, last;
  const CellList* cells;
  double width;  ///< of the images' cells [m]
  double depth;  ///< [m]
};

/// Where a particle stands over a mirror wall. Beyond an open edge of a thin wall (sight.hpp) it is over the face drawn out.
struct WallFoot {
  std::uint32_t particle;
  int wall, face;
  PatchPoint at;
};

/// What a mirror wall is at a foot.
struct WallPoint {
  Vec3 foot, normal, velocity;
  double stretch;  ///< of the volume of an image, see image_volume
  double lead{};   ///< of a radiating face: MirrorWall::pressure [Pa]
};

/// Mirror walls at one moment, with normals at their nodes and the velocities that a particle's footprint shows.
class SeenMirrors {
 public:
  SeenMirrors(const std::vector<MirrorWall>& walls, const std::vector<Footprint>& footprints, const std::vector<Sheets>& sheets,
              const std::array<bool, 3>& symmetry, double spacing);

  /// The walls' velocities anew.
  void see_velocities(const std::vector<Footprint>& footprints);

  BilinearPatch patch(int wall, int face) const;
  WallPoint point(const WallFoot& foot) const;
  /// Do the faces of two feet stand before each other, as in a corner?
  bool face_each_other(const WallFoot& a, const WallFoot& b) const;

 private:
  const std::vector<MirrorWall>& walls_;
  const std::vector<Sheets>& sheets_;
  double spacing_;
  PointLoads normal_, velocity_;  // per wall and node
};

/// Between the middles of which of `count` layers of that thickness a place lies, and its share of the upper one.
std::pair<int, double> layer_of(double distance, double spacing, int count);

/// A lower bound of the distance [m] between particles within a box and any mirror wall.
double clearance(const std::vector<MirrorWall>& walls, const Bounds& box);

/// All feet of the ranges' particles within their depths, and behind the walls by less than `beyond` [m]; sorted by particle.
/// Bit e of open(wall, face): beyond edge e the face is drawn out by a range's depth.
std::vector<WallFoot> find_feet(const std::vector<MirrorWall>& walls, const SeenMirrors& seen, const Particles& particles,
                                std::span<const ParticleRange> ranges, double beyond,
                                const std::function<unsigned(int, int)>& open = {});

/// Adds a load at a foot to the nodes of its face.
void add_at(const WallFoot& foot, const std::vector<MirrorWall>& walls, const Vec3& load, PointLoads& loads);

}  // namespace undex::sph
