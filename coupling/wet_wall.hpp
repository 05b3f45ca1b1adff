// The wet surface of a structure as the fluid sees it: where the fluid slips, the faces themselves, in which it is mirrored
// (sph_fluid/walls/wall_images.hpp); elsewhere dummy particles behind them. These ride on the bilinear shape functions
// of the faces, at fixed depths along the surface normal, so that one set of weights serves both ways: motion maps
// consistently (a rigid motion arrives as itself) and force conservatively (the sum of forces and their virtual work
// arrive whole).
#pragma once

#include <array>
#include <span>
#include <variant>
#include <vector>

#include "core/surface.hpp"
#include "sph_fluid/water/fluid.hpp"

namespace undex::coupling {

/// A wall of the fluid, of either kind.
using WallIndex = std::variant<sph::MirrorIndex, sph::LinedIndex>;

class WetWall {
 public:
  /// As deep as the fluid's kernel reaches, at its spacing.
  WetWall(const WetSurface& surface, const sph::Settings& fluid);
  /// `spacing` [m] between the dummy particles along the surface and between layers; `depth` [m] to be filled behind it.
  /// Nodes on a symmetry plane (through the origin, normal to a marked axis) keep their normals in that plane.
  WetWall(const WetSurface& surface, double spacing, double depth, const std::array<bool, 3>& symmetry);

  std::size_t particle_count() const { return points_.size(); }
  std::size_t layer_count() const { return layers_; }

  /// Adds it to the fluid's walls: where the fluid slips and its scheme mirrors it the surface itself, else dummy particles.
  /// Throws std::invalid_argument in a meridian without slip.
  WallIndex add_to(sph::Fluid& fluid, bool free_slip) const;

  /// The surface itself at its reference position, at rest, for the fluid to be mirrored in.
  sph::MirrorWall mesh() const;
  /// Dummy particles at the surface's reference position, at rest.
  sph::LinedWall particles(bool free_slip) const;

  /// Places `wall` where the surface's nodes are. Velocity of a dummy particle is that of the surface point
  /// below the particle: beneath a rotating surface the tangential part lacks depth times spin, the normal part (all that free
  /// slip sees) is exact.
  void move(std::span<const Vec3> position, std::span<const Vec3> velocity, sph::MirrorWall& wall) const;
  void move(std::span<const Vec3> position, std::span<const Vec3> velocity, sph::LinedWall& wall) const;

  /// Adds what the points of a wall have received to the nodes, by the same weights.
  void hand_on(const sph::MirrorWall& wall, std::span<const Vec3> on_points, std::vector<Vec3>& on_nodes) const;
  void hand_on(const sph::LinedWall& wall, std::span<const Vec3> on_points, std::vector<Vec3>& on_nodes) const;
  /// Adds the wall's impulses [N s] to the nodes, and sets the wall's to zero.
  template <class Wall>
  void collect_impulse(Wall& wall, std::vector<Vec3>& nodal_impulse) const {
    hand_on(wall, wall.impulse, nodal_impulse);
    wall.impulse.assign(wall.impulse.size(), Vec3::Zero());
  }

 private:
  struct Point {
    int face;
    double depth;                  // [m] behind the surface
    std::array<double, 4> weight;  // shape functions
  };
  WetSurface surface_;
  std::array<bool, 3> symmetry_;
  std::vector<Point> points_;
  std::vector<double> volume_;  // [m^3]
  std::size_t layers_ = 0;
};

}  // namespace undex::coupling
