// Walls that the fluid slips along, as mirrors. Every particle within reach of such a wall has an image behind it: same
// density, pressure and sound speed, velocity mirrored about the wall's,
//   v' = R v + 2 (v_w . n) n,   R = 1 - 2 n n^T,
// and a volume that answers to the wall's curvature (image_volume). Images are partners of particles like particles; of
// the pairs (i, image of j) and (j, image of i), which a plane wall makes equal, each counts one half. What an image receives
// goes back to the particle it shows, its force mirrored (F -> R F), and the wall receives the rest, 2 (F . n) n at the foot
// of the image. So a pair, its image and the wall exchange momentum and energy without loss, whatever the wall's shape and
// motion, and what changes along a wall is felt from both its sides. Where walls meet, images have images in the next.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/water/fluid.hpp"
#include "sph_fluid/walls/footprint.hpp"
#include "sph_fluid/walls/particles.hpp"

namespace undex::sph {

/// The free-slip faces of the scene's containers.
struct SlipFaces {
  /// Faces across one axis; either may be missing. Between both stand images of images, as in two mirrors.
  struct Pair {
    int axis;
    double low, high;  ///< [m]; -+1e300 where there is none
    bool symmetric;    ///< is `low` a symmetry plane, whose own images are not stored?
    Bounds window;     ///< of the container
  };
  std::vector<Cylinder> round;  ///< their sides
  std::vector<Pair> plane;
};
SlipFaces slip_faces(const Settings& settings);

/// A lower bound of the distance [m] between particles within a box and any slip wall, rigid or moving.
double clearance(const SlipFaces& faces, const std::vector<MovingWall>& moving, const Bounds& box);

/// Does the scheme mirror the fluid in slip walls? (The published one lines them with dummy particles.)
constexpr bool mirrors_fluid(SchemeName scheme) { return scheme != SchemeName::paper; }

/// A particle's foot on a moving wall's mesh: x = foot - distance * normal, both interpolated between the nodes.
struct Foot {
  std::uint32_t particle;
  int wall, face;
  double u, v, distance;  ///< [m], positive on the fluid's side
};

class WallImages {
 public:
  /// Images of a range of particles sorted by `cells`.
  struct Range {
    std::uint32_t first, last;  ///< particles
    const CellList* cells;
    double width;  ///< of the images' cells [m]
    double depth;  ///< particles nearer to a wall than this have images [m]
  };
  /// Finds the images of particles.
  void build(const Settings& settings, const SlipFaces& faces, const std::vector<MovingWall>& moving, const Particles& particles,
             std::span<const Range> ranges);

  /// A particle beyond a wall changes places with its image; what it loses of its momentum is `received` by the walls,
  /// per moving wall and node [N s], and returned is the work on them [J]. Uses the feet of the last build.
  double put_back(const Settings& settings, const SlipFaces& faces, const std::vector<MovingWall>& moving, Particles& particles,
                  std::vector<std::vector<Vec3>>& received) const;

  /// Particles are sorted anew: no images, no feet.
  void forget();

  /// Rows of the images from those of the particles: all but gradients, and these.
  void mirror_rows(const Particles& particles);
  void mirror_gradients(const Particles& particles);
  /// Hands what the images have received back to the particles, and the walls' share to `force`, per moving wall and node [N].
  /// Returns the power on the moving walls [W].
  double hand_back(Particles& particles, const std::vector<MovingWall>& moving, std::vector<std::vector<Vec3>>& force);

  std::size_t size() const { return images_.size(); }
  /// Images of range r: from first to last of the arrays below, sorted by cell.
  std::uint32_t begin(std::size_t r) const { return begin_[r]; }
  CellGrid grid(std::size_t r) const { return cells_[r].view(); }
  void describe(PairInput& in) const;
  SumRow* sums() { return sums_.data(); }
  std::size_t memory_bytes() const;

 private:
  struct Image {
    std::uint32_t owner;                // the particle
    int parent;                         // the image that this is an image of; -1: the particle itself
    int foot;                           // index into feet_, -1: a rigid wall
    double stretch;                     // volume over the parent's
    Vec3 place, normal, wall_velocity;  // normal zero: an even number of mirrors
  };
  void find_feet(const Settings& settings, const std::vector<MovingWall>& moving, const Particles& particles,
                 std::span<const Range> ranges);

  std::vector<Footprint> footprints_;          // per moving wall
  std::vector<std::vector<Vec3>> normals_;     // per moving wall and node, as the next
  std::vector<std::vector<Vec3>> velocities_;  // that the feet see
  std::vector<Foot> feet_;                     // sorted by particle
  std::vector<Image> images_;                  // by particle, parents before their images
  std::vector<std::uint32_t> slot_;            // place of an image in the arrays below
  std::vector<std::uint32_t> begin_;
  std::vector<CellList> cells_;
  std::vector<double> x_, y_, z_;  // sorted by cell, as the next
  std::vector<FluidRow> rows_;
  std::vector<GradientRow> gradients_;
  std::vector<CorrectedRow> corrected_;
  std::vector<ViscosityRow> viscosity_;
  std::vector<SumRow> sums_;
};

}  // namespace undex::sph
