// Who sees whom past thin walls. A mirror wall that is thinner than two reaches of the kernel, or that turns away from the fluid
// at an edge, does not part the particles on its sides by distance alone. There a pair counts if light went between the two:
// - two particles, if the straight way between them meets no wall;
// - a particle and an image, if the way goes through the mirror whose image it is, meets no wall before it, and the way from
//   there to the particle shown is free too;
// - a particle and a dummy of a wall, if the first wall on the way is the one that the dummy stands behind;
// - a particle and a dummy of a container, if the way is free, or if what the first wall on it shows in the dummy's place stands
//   behind the container too: there no image is.
// In every direction a particle then sees either fluid or a mirror: at an edge real particles end where images begin, and a way
// through the edge itself counts one half in either. Mirrors in which thin walls end show these walls likewise: their faces have
// copies across symmetry planes and containers' faces.
//
// Most of this is decided without following the way. Every particle that has its foot on a thin face knows the sheet
// (sheets.hpp); where that face is plain, so that no edge and no other wall is within reach, a particle sees those with feet on
// the same sheet.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/vector.hpp"
#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/walls/mirror_feet.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/walls/screens.hpp"
#include "sph_fluid/walls/slip_faces.hpp"
#include "sph_fluid/walls/thin_walls.hpp"

namespace undex::sph {

/// An image of an image, and so on, at most.
constexpr int longest_chain = 8;

/// An image as a question of sight: the mirrors of walls on the way to its particle, the one that it stands behind first.
/// Containers' fixed faces hide nothing; what lies behind them is mirrored in them.
struct SeenImage {
  struct Glass {
    int wall, face;
    Vec3 shown;   ///< what it shows: the particle, or what the next shows [m]
    Vec3 normal;  ///< away from the fluid
  };
  std::uint32_t owner;        ///< the particle
  std::uint32_t first, last;  ///< of its glasses
};

class Sight {
 public:
  ThinWalls& walls() { return thin_; }
  bool empty() const { return thin_.empty(); }
  bool is_thin(int wall) const { return thin_.contain(wall); }

  /// Walls, particles with their feet, and images where they are now; arrays by particle and by image; `reach` [m] of all pairs.
  void see(double reach, const std::vector<MirrorWall>& walls, const SlipFaces& faces, const Settings& settings,
           std::span<const WallFoot> feet, std::size_t particles, std::span<const SeenImage> images,
           std::span<const SeenImage::Glass> glasses);

  /// Which dummies stand behind a wall's surface; the others are those of containers, which hide nothing.
  void see_dummies(std::span<const char> behind_surface) { behind_surface_ = behind_surface; }

  /// Hands it to a loop over pairs.
  void describe(PairInput& in) const;

  /// Is the straight way from a to b [m] free?
  bool sees(const Vec3& a, const Vec3& b) const;

  void forget();
  void visit_state(StateVisitor& state) { thin_.visit_state(state); }
  std::size_t memory_bytes() const;

 private:
  /// A particle's or an image's sheet: 0 is none.
  using Code = std::uint16_t;
  static constexpr Code many = 0x7fff, edge = 0x8000;

  Code code_of(int wall, int face) const;
  static void weigh(const void* self, const PairInput& in, const SightQuestion& question);
  void answer(const PairInput& in, const SightQuestion& question) const;
  /// How much a particle sees of candidate j.
  template <class About>
  float share(const Vec3& from, Code mine, const Vec3& at, const SightQuestion& question, std::uint32_t j, const PairInput& in,
              About about, Way& way) const;
  /// The same of a dummy behind a container.
  bool sees_container(const Vec3& at, const Way& way) const;
  /// The same of an image in thin walls.
  double mirrored_share(Vec3 from, Vec3 at, std::uint32_t j, unsigned axes, const Screens::Near& near, Way& way) const;

  ThinWalls thin_;
  Screens screens_;
  double reach_ = 0, spacing_ = 0;
  int dimension_ = 3;
  std::optional<SlipFaces> lined_;  // of containers, with dummies behind them
  std::vector<Code> particle_, image_;
  std::span<const SeenImage> images_;
  std::span<const SeenImage::Glass> glasses_;
  std::span<const char> behind_surface_;
};

}  // namespace undex::sph
