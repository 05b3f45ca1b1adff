// The lattices that bodies, solids and walls are laid out on: Cartesian cells or rings, and a walk over their points.
#pragma once

#include <functional>
#include <memory>

#include "core/shapes.hpp"
#include "sph_fluid/lattice_rings.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::sph {

/// A lattice ready to be walked: Cartesian cells, or rings about an axis.
struct Grid {
  int dimension = 3;
  Vec3 origin = Vec3::Zero();    // a cell's corner
  Vec3 step = Vec3::Ones();      // cell edges; along the axis only, for rings
  Mat3 turn = Mat3::Identity();  // of Cartesian cells, about the origin
  bool rings = false;
  int axis = 2;
  double ring_start = 0, ring_width = 0;
  long around = 0;                               // particles of every ring; 0: as many as its own length asks for
  std::shared_ptr<const RingSection> section{};  // where they stand; null: on circles
};

/// Is given a point [m] and its cell's volume [m^d].
using Visit = std::function<void(const Vec3& x, double volume)>;

/// Cells with an edge of dx [m] from a corner at `origin`; then fitted: each extent of the shape is cut into whole steps.
Grid cartesian(const Vec3& origin, double dx, int dimension);
void fit_grid(Grid& grid, const Primitive& shape, double dx, const Symmetry& symmetry);
/// Particles on a ring, symmetric in quadrants.
long ring_count(double radius, double width);

/// The scene's lattice. Throws std::invalid_argument where it cannot be, as the next.
Grid scene_grid(const Settings& settings);
/// That of the scene, or a body's own.
Grid body_grid(const Settings& settings, const Body& body);
/// Visits every lattice point in `box` (or just outside) on the kept side of the symmetry planes.
void walk(const Grid& grid, const Settings& settings, Bounds box, const Visit& visit);

}  // namespace undex::sph
