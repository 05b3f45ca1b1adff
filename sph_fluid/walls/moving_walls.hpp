// Walls that somebody else moves, a structure as a rule: its owner sets positions and velocities before each step and takes the
// impulse after it. A mirror wall is a mesh that the fluid slips along; a lined wall is dummy particles behind faces.
#pragma once

#include <array>
#include <vector>

#include "core/state.hpp"
#include "core/vector.hpp"

namespace undex::sph {

/// The points of a wall: nodes of a mesh, or dummy particles.
struct WallPoints {
  std::vector<Vec3> position;  ///< [m]
  std::vector<Vec3> velocity;  ///< [m/s]
  std::vector<Vec3> impulse;   ///< [N s] received from the fluid since the owner last set it to zero
};

/// A mesh in which the fluid is mirrored (wall_images.hpp).
struct MirrorWall : WallPoints {
  std::vector<std::array<int, 4>> faces;  ///< as WetSurface has them
  bool rigid = false;                     ///< it moves as one: its nodes share nothing (footprint.hpp)
  /// Of a radiating face (water/radiating_faces.hpp), else empty: its pressure less that of the layers before it [Pa], per node
  /// and layer. An image has twice that more than its particle.
  std::vector<double> pressure{};

  bool radiates() const { return !pressure.empty(); }
};

/// Dummy particles.
struct LinedWall : WallPoints {
  std::vector<Vec3> normal;       ///< unit, pointing away from the fluid; behind an edge, the edge's direction
  std::vector<double> volume;     ///< [m^3]
  std::vector<int> faces_before;  ///< how many faces of the wall a particle lies behind; empty: one, for all of them
  bool free_slip = true;
  /// The surface that they lie behind, as a mirror wall has it: nobody sees them past it (sight.hpp). Empty: nothing is hidden.
  std::vector<std::array<int, 4>> faces{};
  std::vector<Vec3> node{};  ///< [m]

  /// WallRow::slip of particle k: 1 behind a free-slip face, -1 behind an edge of two, else 0.
  double slip(std::size_t k) const {
    const int count = faces_before.empty() ? 1 : faces_before[k];
    return !free_slip || count > 2 ? 0.0 : count == 2 ? -1.0 : 1.0;
  }
};

/// Faces of the scene's containers that stand still: x_low, x_high, ... z_high, and all round ones. Of several containers those
/// of one direction are one.
inline constexpr int fixed_face_count = 7, round_face = 6;
using OnFixedFaces = std::array<Vec3, fixed_face_count>;
inline OnFixedFaces nothing_on_fixed_faces() {
  OnFixedFaces nothing;
  nothing.fill(Vec3::Zero());
  return nothing;
}

/// Numbers of a fluid's walls, by which their owners find them.
struct MirrorIndex {
  int number;
};
struct LinedIndex {
  int number;
};

/// What the points of walls receive: forces [N] or impulses [N s], per wall.
using PointLoads = std::vector<std::vector<Vec3>>;

/// Loads on walls of either kind.
struct WallLoads {
  PointLoads mirrors, lined;

  void visit_state(StateVisitor& state);
};

/// Where walls are, as an evaluation sees them.
struct WallMotion {
  std::vector<Vec3> position, velocity, normal;  ///< normals of lined walls only

  void visit_state(StateVisitor& state);
};

struct MovingWalls {
  std::vector<MirrorWall> mirrors;
  std::vector<LinedWall> lined;

  bool empty() const { return mirrors.empty() && lined.empty(); }

  /// Loads of zero.
  WallLoads unloaded() const;
  WallLoads impulses() const;
  void set_impulses(const WallLoads& impulse);
  /// Adds the impulse of `force` [N] over `duration` [s].
  void receive(const WallLoads& force, double duration);

  /// All walls' motions, and walls put where these say.
  std::vector<WallMotion> motions() const;
  void show(const std::vector<WallMotion>& motions);
  /// Walls as they are at a share of a step of dt [s], on the cubic through both its ends.
  void show_between(const std::vector<WallMotion>& before, const std::vector<WallMotion>& after, double dt, double share);

  /// Where all walls are, and what they have received.
  void visit_state(StateVisitor& state);
};

/// a + b.
WallLoads sum_of(const WallLoads& a, const WallLoads& b);

}  // namespace undex::sph
