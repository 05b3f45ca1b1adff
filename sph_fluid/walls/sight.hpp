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

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/vector.hpp"
#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/walls/mirror_feet.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/walls/sheets.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::sph {

/// An image as a question of sight: the mirrors of walls on the way to its particle, the one that it stands behind first.
/// Containers' faces hide nothing; what lies behind them is mirrored in them.
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
  /// Finds the thin walls where walls have moved since they were sought; `reach` [m] of pairs of liquid.
  void look(const std::vector<MirrorWall>& walls, const std::vector<Sheets>& sheets, double reach, double spacing);
  bool empty() const { return !thin_; }
  bool is_thin(int wall) const { return thin_ && thin_wall_[wall]; }

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
  std::size_t memory_bytes() const;

 private:
  /// Half a face, or an open edge: `across` and the normal are zero.
  struct Piece {
    Vec3 corner, along, across, normal;
    int sheet;
    double offset = 0;  // of its plane

    bool is_edge() const { return across.isZero(); }
  };
  struct Crossing {
    double at;  // share of the way
    bool entering;
    Vec3 normal;
    double offset;  // of the wall's plane
    int sheet;
  };
  struct Graze {
    int sheet;
    double share;  // 1/2 through the edge itself, 0 half a width beside it
  };
  /// What a straight way meets.
  struct Way {
    std::vector<Crossing> crossings;  // in order
    std::vector<Graze> grazed;

    bool is_free() const;
    /// Is the first wall one that looks as `normal` does?
    bool enters(const Vec3& normal) const;
    /// Of the open edges of a sheet, or of all (-1).
    double graze(int sheet) const;
    double beside(int but) const;
    double free_share() const;
  };
  /// A particle's or an image's sheet: 0 is none.
  using Code = std::uint16_t;
  static constexpr Code many = 0x7fff, edge = 0x8000;

  Code code_of(int wall, int face) const;
  void add_face(std::array<Vec3, 4> corner, int sheet, unsigned open, const SlipFaces& faces,
                const std::array<bool, 3>& symmetry);
  void sort_pieces();
  /// Calls visit(piece) once for each that may lie in the box.
  template <class Visit>
  void for_each_near(const Bounds& box, Visit visit) const;
  void follow(const Vec3& a, const Vec3& b, std::span<const Piece> pieces, Way& way) const;
  /// How much a particle sees of candidate j.
  template <class Pieces>
  float share(const Vec3& from, Code mine, const Vec3& at, const SightQuestion& question, std::uint32_t j, const PairInput& in,
              Pieces about, Way& way) const;
  /// The same of a dummy behind a container.
  bool sees_container(const Vec3& at, const Way& way) const;
  /// The same of an image in a thin wall.
  double mirrored_share(Vec3 from, Vec3 at, std::uint32_t j, unsigned axes, std::span<const Piece> pieces, Way& way) const;
  static void weigh(const void* self, const PairInput& in, const SightQuestion& question);
  void answer(const PairInput& in, const SightQuestion& question) const;

  double reach_ = 0, spacing_ = 0;
  bool thin_ = false;
  std::vector<bool> thin_wall_;               // per wall: is it thin somewhere?
  std::vector<std::vector<Vec3>> looked_at_;  // where the walls' nodes were [m]
  std::vector<std::vector<char>> plain_;      // per wall and face: no open edge and no other wall within reach
  std::vector<std::vector<int>> sheet_;       // per wall and face, as the next
  std::vector<std::vector<unsigned>> open_;

  std::vector<Piece> pieces_;
  Bounds box_;
  double cell_ = 1;
  int count_[3] = {1, 1, 1};
  std::vector<std::uint32_t> start_, member_;
  std::vector<Code> particle_, image_;
  std::optional<SlipFaces> lined_;  // of containers, with dummies behind them
  int dimension_ = 3;
  std::span<const SeenImage> images_;
  std::span<const char> behind_surface_;
  std::span<const SeenImage::Glass> glasses_;
};

}  // namespace undex::sph
