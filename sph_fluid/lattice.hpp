// The start: shapes filled with particles, and rigid walls lined with dummy particles.
#pragma once

#include <string>
#include <vector>

#include "sph_fluid/water/fluid.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::sph {

struct BodyParticles {
  std::vector<Vec3> position;  ///< [m]
  std::vector<double> volume;  ///< [m^d]; their sum is the exact volume of the kept part of the body
};

/// A lattice ready to be walked: Cartesian cells, or rings about an axis.
struct Grid {
  int dimension = 3;
  Vec3 origin = Vec3::Zero();    // a cell's corner
  Vec3 step = Vec3::Ones();      // cell edges; along the axis only, for rings
  Mat3 turn = Mat3::Identity();  // of Cartesian cells, about the origin
  bool rings = false;
  int axis = 2;
  double ring_start = 0, ring_width = 0;
  long around = 0;  // particles of every ring; 0: as many as its own length asks for
};

/// Cells with an edge of dx [m] from a corner at `origin`; then fitted: each extent of the shape is cut into whole steps.
Grid cartesian(const Vec3& origin, double dx, int dimension);
void fit_grid(Grid& grid, const Primitive& shape, double dx, const Symmetry& symmetry);
/// Particles on a ring, symmetric in quadrants.
long ring_count(double radius, double width);

/// The points of a grid inside a shape, on the kept side of the symmetry planes. Throws std::invalid_argument, as `who`, where
/// there are none.
BodyParticles fill(const Grid& grid, const Settings& settings, const Shape& shape, const std::string& who);

/// Particles of every body, in the scene's order. Throws std::invalid_argument where a body gets none.
std::vector<BodyParticles> fill_bodies(const Settings& settings);

/// Symmetry planes and slip walls that lie between the lattice's cell faces, and what to do about it; one sentence each.
std::vector<std::string> lattice_warnings(const Settings& settings);

/// Dummy particles of the rigid walls: the lattice continued beyond every face that is not open, as deep as the kernel
/// reaches (at least three layers). One MovingWall per slip condition; their velocity is zero.
std::vector<MovingWall> line_walls(const Settings& settings);

/// The smoothing length of the scene's lattice [m], and the reach of its kernel [m].
double smoothing_length(const Settings& settings, double spacing);
double kernel_support(KernelName kernel);
/// See kernels.hpp.
double lattice_factor(KernelName kernel, double eta, int dimension);

}  // namespace undex::sph
