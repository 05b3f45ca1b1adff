// Solid shapes as signed distances: what a scene's bodies, charges and containers are made of.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/record.hpp"
#include "core/vector.hpp"

namespace undex {

/// Axis-aligned box low..high [m]. In 1D and 2D scenes the unused axes are ignored.
struct Box {
  static constexpr const char* name = "box";
  static constexpr const char* summary = "axis-aligned box; a rectangle in 2D, an interval in 1D";
  static constexpr bool is_bounded = true, is_container = true;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};
/// Everything with low <= x[axis] <= high [m].
struct Slab {
  static constexpr const char* name = "slab";
  static constexpr const char* summary =
      "everything between two planes across `axis`; unbounded, so only good to subtract (or in 1D)";
  static constexpr bool is_bounded = false, is_container = false;
  int axis = 0;
  double low = 0, high = 1;
};
/// Ball [m] (disc in 2D, interval in 1D).
struct Sphere {
  static constexpr const char* name = "sphere";
  static constexpr const char* summary = "ball; a disc in 2D, an interval in 1D";
  static constexpr bool is_bounded = true, is_container = true;
  Vec3 center = Vec3::Zero();
  double radius = 0;
};
/// Solid cylinder along `axis` through `center` (its component along the axis is ignored), low..high along the axis [m].
/// In 2D scenes with axis z it is a disc.
struct Cylinder {
  static constexpr const char* name = "cylinder";
  static constexpr const char* summary = "along `axis`; in 2D a disc (axis \"z\") or a strip (axis \"x\", \"y\")";
  static constexpr bool is_bounded = true, is_container = true;
  int axis = 2;
  Vec3 center = Vec3::Zero();
  double radius = 0, low = 0, high = 1;
};
/// Cylinder of radius `outer` less one of radius `inner` [m].
struct TubeShape {
  static constexpr const char* name = "tube";
  static constexpr const char* summary = "a cylinder less a smaller one; in 2D a ring";
  static constexpr bool is_bounded = true, is_container = false;
  int axis = 2;
  Vec3 center = Vec3::Zero();
  double inner = 0, outer = 0, low = 0, high = 1;
};

/// Truncated cone along `axis` through `center` (its component along the axis is ignored) [m]. Either radius may be zero: a tip.
/// In 2D scenes, along x or y, its section through the axis.
struct Cone {
  static constexpr const char* name = "cone";
  static constexpr const char* summary = "a truncated cone along `axis`, or a whole one; in 2D a trapezium (axis \"x\", \"y\")";
  static constexpr bool is_bounded = true, is_container = true;
  int axis = 2;
  Vec3 center = Vec3::Zero();
  double low_radius = 0, high_radius = 0, low = 0, high = 1;

  double radius_at(double along) const { return low_radius + (high_radius - low_radius) * (along - low) / (high - low); }
};

template <class Visit>
void describe_corners(Vec3& low, Vec3& high, Visit&& visit) {
  visit(low, {.name = "low",
              .unit = "m",
              .range = Range::position(),
              .needed = true,
              .remedy = "give the lowest corner, e.g. low = [0, 0, 0]",
              .meaning = "lowest corner"});
  visit(high, {.name = "high",
               .unit = "m",
               .range = Range::position(),
               .needed = true,
               .remedy = "give the highest corner, e.g. high = [1, 1, 1]",
               .greater = "low",
               .meaning = "highest corner"});
}
template <class Visit>
void describe(Box& box, Visit&& visit) {
  describe_corners(box.low, box.high, visit);
}
/// The ends of a shape along its axis.
template <class Visit>
void describe_ends(int axis, double& low, double& high, Visit&& visit) {
  constexpr const char* where = "say where it is, in m";
  visit(low, {.name = "low",
              .unit = "m",
              .range = Range::position(),
              .needed = true,
              .remedy = where,
              .form = Form::along,
              .axis = axis,
              .meaning = "lower end along `axis`"});
  visit(high, {.name = "high",
               .unit = "m",
               .range = Range::position(),
               .needed = true,
               .remedy = where,
               .greater = "low",
               .form = Form::along,
               .axis = axis,
               .meaning = "upper end"});
}
template <class Visit>
void describe(Slab& slab, Visit&& visit) {
  visit(slab.axis, {.name = "axis",
                    .needed = true,
                    .remedy = "say across which axis it lies, e.g. axis = \"x\"",
                    .form = Form::scene_axis,
                    .meaning = "across which it lies"});
  describe_ends(slab.axis, slab.low, slab.high, visit);
}
template <class Visit>
void describe(Sphere& sphere, Visit&& visit) {
  visit(sphere.center, {.name = "center", .unit = "m", .range = Range::position(), .meaning = "its middle"});
  visit(sphere.radius, {.name = "radius", .unit = "m", .range = Range::length(), .needed = true, .remedy = "give it in m"});
}
/// The axis of a round shape.
template <class Visit>
void describe_axis(int& axis, Vec3& center, Visit&& visit) {
  visit(axis, {.name = "axis", .form = Form::axis, .meaning = "along which it lies"});
  visit(center, {.name = "center",
                 .unit = "m",
                 .range = Range::position(),
                 .form = Form::across,
                 .axis = axis,
                 .meaning = "a point on the axis (its component along the axis is ignored)"});
}
template <class Visit>
void describe(Cylinder& cylinder, Visit&& visit) {
  describe_axis(cylinder.axis, cylinder.center, visit);
  visit(cylinder.radius, {.name = "radius", .unit = "m", .range = Range::length(), .needed = true, .remedy = "give it in m"});
  describe_ends(cylinder.axis, cylinder.low, cylinder.high, visit);
}
template <class Visit>
void describe(TubeShape& tube, Visit&& visit) {
  describe_axis(tube.axis, tube.center, visit);
  visit(tube.inner, {.name = "inner_radius", .unit = "m", .range = Range::length(), .needed = true, .remedy = "give it in m"});
  visit(tube.outer, {.name = "outer_radius",
                     .unit = "m",
                     .range = Range::length(),
                     .needed = true,
                     .remedy = "give it in m",
                     .greater = "inner_radius"});
  describe_ends(tube.axis, tube.low, tube.high, visit);
}
template <class Visit>
void describe(Cone& cone, Visit&& visit) {
  describe_axis(cone.axis, cone.center, visit);
  constexpr Range radius = Range::between(0, Range::farthest);
  visit(cone.low_radius, {.name = "low_radius",
                          .unit = "m",
                          .range = radius,
                          .needed = true,
                          .remedy = "give it in m (0: a tip)",
                          .meaning = "at `low`; 0: a tip"});
  visit(cone.high_radius, {.name = "high_radius",
                           .unit = "m",
                           .range = radius,
                           .needed = true,
                           .remedy = "give it in m (0: a tip)",
                           .meaning = "at `high`"});
  describe_ends(cone.axis, cone.low, cone.high, visit);
}

using Primitive = std::variant<Box, Slab, Sphere, Cylinder, TubeShape, Cone>;

/// A primitive less any number of others.
struct Shape {
  Primitive base;
  std::vector<Primitive> removed;
};

/// Have both the same numbers, those left out that mean nothing?
bool same_shape(const Primitive& one, const Primitive& other);

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
/// The same of the body of revolution about x = 0 of which a shape in two dimensions is the half at x > 0 [m^3].
double volume_of_revolution(const Shape& shape, const Bounds& window);

}  // namespace undex
