// Walls that the fluid slips along, as mirrors. Every particle within reach of such a wall has an image behind it: same
// density, pressure (under gravity that of its own depth) and sound speed, velocity mirrored about the wall's,
//   v' = R v + 2 (v_w . n) n,   R = 1 - 2 n n^T,
// and a volume that answers to the wall's curvature (image_volume). Images are partners of particles like particles; of
// the pairs (i, image of j) and (j, image of i), which a plane wall makes equal, each counts one half. What an image receives
// goes back to the particle it shows, its force mirrored (F -> R F), and the wall receives the rest, 2 (F . n) n at the foot
// of the image. So a pair, its image and the wall exchange momentum and energy without loss, whatever the wall's shape and
// motion, and what changes along a wall is felt from both its sides. Where walls meet, images have images in the next.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/vector.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/pairs/ring_kernel.hpp"
#include "sph_fluid/walls/footprint.hpp"
#include "sph_fluid/walls/mirror_feet.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/walls/particles.hpp"
#include "sph_fluid/walls/sheets.hpp"
#include "sph_fluid/walls/sight.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::sph {

/// Power [W] or work [J] on walls that others move, and on radiating faces; forces [N] or impulses [N s] on slip faces at rest.
struct WallShare {
  double moving = 0, radiating = 0;
  OnFixedFaces fixed = nothing_on_fixed_faces();

  void add(const MirrorWall& wall, double more) { (wall.radiates() ? radiating : moving) += more; }
};

class WallImages {
 public:
  /// The surfaces of lined walls, which hide as mirrors do, and which dummies stand behind one. Before build().
  void see_linings(const std::vector<LinedWall>& walls, std::span<const char> behind_surface);

  /// Finds the images of ranges of particles, and who sees whom past thin walls; `reach` [m] of pairs. With the feet in hand
  /// `on_feet`, where there is one, may set the walls' velocities.
  void build(const Settings& settings, const SlipFaces& faces, const std::vector<MirrorWall>& walls, const Particles& particles,
             std::span<const ParticleRange> ranges, double reach,
             const std::function<void(std::span<const WallFoot>)>& on_feet = {});

  /// A particle beyond a wall changes places with its image; what it loses of its momentum is added to `received` [N s], and
  /// returned is the work on moving walls [J]. Uses the feet of the last build.
  WallShare put_back(const Settings& settings, const SlipFaces& faces, const std::vector<MirrorWall>& walls, Particles& particles,
                     PointLoads& received) const;

  /// The feet, by which the next step finds who has crossed a wall, and where thin walls were sought.
  void visit_state(StateVisitor& state) {
    state("feet", feet_);
    state.part("sight", [&] { sight_.visit_state(state); });
  }

  /// Particles are sorted anew: no images, no feet.
  void forget();

  /// Rows of the images from those of the particles: all but gradients, and these.
  void reflect_rows(const Particles& particles, const Vec3& gravity, const RingKernel* rings = nullptr);
  void reflect_gradients(const Particles& particles, const Vec3& gravity);
  /// Adds what the images have received to the sums of the particles that they show, and the walls' share to `force` [N]. Returns
  /// the power on moving walls [W].
  WallShare scatter(Particles& particles, const std::vector<MirrorWall>& walls, PointLoads& force);

  std::size_t size() const { return images_.size(); }
  /// Images of range r: from first to last of the arrays below, sorted by cell.
  std::uint32_t begin(std::size_t r) const { return begin_[r]; }
  CellGrid grid(std::size_t r) const { return cells_[r].view(); }
  void describe(PairInput& in) const;
  SumRow* sums() { return sums_.data(); }
  const Sight& sight() const { return sight_; }
  std::size_t memory_bytes() const;

 private:
  struct Image {
    std::uint32_t owner;                // the particle
    int parent;                         // the image that this is an image of; -1: the particle itself
    int foot;                           // index into feet_, -1: a rigid wall
    double stretch;                     // volume over the parent's
    Vec3 place, normal, wall_velocity;  // normal zero: an even number of mirrors
    bool radiating = false;
    int face = -1;    // of the fixed ones
    double lead = 0;  // half of what its pressure is more than its parent's [Pa]
  };
  void see_first_places(const Settings& settings, const std::vector<MirrorWall>& walls);
  /// Which walls are thin, the lined ones after the mirrors.
  void look(const Settings& settings, const SlipFaces& faces, const std::vector<MirrorWall>& walls);
  void see_past_walls(const Settings& settings, const SlipFaces& faces, const std::vector<MirrorWall>& walls,
                      const Particles& particles, std::span<const ParticleRange> ranges, double reach);
  /// Bit e: beyond edge e particles have feet, too.
  unsigned open_edges(int wall, int face, const Sheets& sheets) const;
  /// The images as questions of sight, in the order of the arrays.
  void find_shown(const Particles& particles);
  /// Appends the images of particle i to `images`, whose places the parents are.
  void add_images_of(std::uint32_t i, const Particles& particles, const SeenMirrors& seen, const SlipFaces& faces,
                     const std::vector<MirrorWall>& walls, double depth, const Settings& settings,
                     std::vector<Image>& images) const;
  void add_range(const ParticleRange& range, const Particles& particles, const SeenMirrors& seen, const SlipFaces& faces,
                 const std::vector<MirrorWall>& walls, const Settings& settings);
  /// What pairs read of an image as a ring; gives the row its area.
  RingRow ring_of(std::uint32_t c, const Particles& particles, const RingKernel& rings, FluidRow& row) const;
  /// Appends the images between walls that face each other, or meet: from `mark` on those in the walls themselves are there.
  void add_images_between(const SeenMirrors& seen, double depth, const Settings& settings, std::size_t mark,
                          std::vector<Image>& images) const;
  /// Sorts the images from `start` on by cell.
  void sort_from(std::uint32_t start, double width, CellList& cells);
  /// Calls visit(image) from the particle's own image on to image c of it.
  template <class Visit>
  void for_each_mirror(std::uint32_t c, Visit visit) const;
  WallShare put_back_from_mirrors(const Settings& settings, const std::vector<MirrorWall>& walls, Particles& particles,
                                  PointLoads& received) const;
  /// Appends the images of the images from `mark` on in the radiating face of this foot: walls meet it at right angles.
  void mirror_in_radiating(const WallFoot& foot, const WallPoint& face, const Settings& settings, std::size_t mark,
                           std::vector<Image>& images) const;
  /// What an image has received goes to whom it shows; the wall has its share.
  struct Left {
    Vec3 force;    // [N]
    double power;  // [W] that the image has taken and its particle cannot, whose pressure is another
  };
  Left scatter_one(std::uint32_t k, Particles& particles);

  std::vector<Footprint> footprints_;  // per mirror wall, as the next
  std::vector<Sheets> sheets_;
  std::vector<MirrorWall> linings_;  // surfaces of lined walls
  std::vector<Sheets> lining_sheets_;
  Sight sight_;
  std::vector<SeenImage::Glass> glasses_;
  std::vector<SeenImage> shown_;           // sorted by cell
  std::vector<WallFoot> feet_;             // sorted by particle
  std::vector<Image> images_;              // by particle, parents before their images
  std::vector<std::vector<Image>> found_;  // by each thread, of the present range
  std::vector<std::uint32_t> slot_;        // place of an image in the arrays below
  std::vector<std::uint32_t> begin_;
  std::vector<CellList> cells_;
  std::vector<double> x_, y_, z_;  // sorted by cell, as the next
  std::vector<FluidRow> rows_;
  std::vector<GradientRow> gradients_;
  std::vector<CorrectedRow> corrected_;
  std::vector<ViscosityRow> viscosity_;
  std::vector<RingRow> ring_;
  std::vector<SumRow> sums_;
};

}  // namespace undex::sph
