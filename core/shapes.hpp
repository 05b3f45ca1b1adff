// Solid shapes as signed distances: what a scene's bodies, charges and containers are made of.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/vector.hpp"

namespace undex {

/// Axis-aligned box low..high [m]. In 1D and 2D scenes the unused axes are ignored.
struct Box {
  Vec3 low, high;
};
/// Everything with low <= x[axis] <= high [m].
struct Slab {
  int axis;
  double low, high;
};
/// Ball [m] (disc in 2D, interval in 1D).
struct Sphere {
  Vec3 center;
  double radius;
};
/// Solid cylinder along `axis` through `center` (its component along the axis is ignored), low..high along the axis [m].
/// In 2D scenes with axis z it is a disc.
struct Cylinder {
  int axis;
  Vec3 center;
  double radius, low, high;
};
/// Cylinder of radius `outer` less one of radius `inner` [m].
struct TubeShape {
  int axis;
  Vec3 center;
  double inner, outer, low, high;
};

using Primitive = std::variant<Box, Slab, Sphere, Cylinder, TubeShape>;

/// A primitive less any number of others.
struct Shape {
  Primitive base;
  std::vector<Primitive> removed;
};

/// Signed distance [m] from x to the surface, negative inside; exact outside corners of the base excepted for
/// subtractions, where it is the usual lower bound. Only the first `dimension` coordinates count.
double signed_distance(const Primitive& shape, const Vec3& x, int dimension);
double signed_distance(const Shape& shape, const Vec3& x, int dimension);

/// Smallest box round the shape; a Slab is unbounded (+-1e300) across its axis.
Bounds bounds(const Primitive& shape, int dimension);
Bounds bounds(const Shape& shape, int dimension);

/// The middle of those bounds; 0 along axes without any.
Vec3 middle(const Primitive& shape, int dimension);

/// Volume [m^3] (area [m^2] in 2D, length [m] in 1D) of the part of `shape` inside `window`, to about 1e-5 relative,
/// by recursive subdivision of the window with the signed distance.
double volume(const Shape& shape, const Bounds& window, int dimension);

}  // namespace undex
