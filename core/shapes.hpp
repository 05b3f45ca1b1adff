// Solid shapes as signed distances: what a scene's bodies, charges and containers are made of.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
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

/// Ellipsoid with its axes along x, y, z [m] (ellipse in 2D, interval in 1D).
struct Ellipsoid {
  static constexpr const char* name = "ellipsoid";
  static constexpr const char* summary = "with its axes along x, y, z; an ellipse in 2D, an interval in 1D";
  static constexpr bool is_bounded = true, is_container = false;
  Vec3 center = Vec3::Zero(), semi_axes = Vec3::Ones();
};
template <class Visit>
void describe(Ellipsoid& ellipsoid, Visit&& visit) {
  visit(ellipsoid.center, {.name = "center", .unit = "m", .range = Range::position(), .meaning = "its middle"});
  visit(ellipsoid.semi_axes, {.name = "semi_axes",
                              .unit = "m",
                              .range = Range::length(),
                              .needed = true,
                              .remedy = "give half its length along x, y and z, e.g. semi_axes = [0.1, 0.1, 0.2]",
                              .values = "lengths, above 0",
                              .meaning = "half its length along x, y, z"});
}

/// Everything behind the plane through `point` [m] from which `normal` (of any length) points away.
struct HalfSpace {
  static constexpr const char* name = "half_space";
  static constexpr const char* summary =
      "everything on one side of a plane; unbounded, so only good to subtract, or in an intersection";
  static constexpr bool is_bounded = false, is_container = false;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitX();
};
template <class Visit>
void describe(HalfSpace& half, Visit&& visit) {
  visit(half.point, {.name = "point", .unit = "m", .range = Range::position(), .meaning = "in the plane"});
  visit(half.normal, {.name = "normal",
                      .needed = true,
                      .remedy = "say which way is out of it, e.g. normal = [1, 0, 0]",
                      .meaning = "out of it, of any length"});
}

/// Corners (r, z) of a meridian [m], in turn.
using Polygon = std::vector<std::array<double, 2>>;

/// The body that a polygon in (r, z) sweeps about `axis` through `center` (its component along the axis is ignored), z counted
/// along the axis. In 2D scenes, along x or y, its section through the axis.
struct Revolution {
  static constexpr const char* name = "revolution";
  static constexpr const char* summary = "what a polygon in (r, z) sweeps about `axis`; in 2D its section (axis \"x\", \"y\")";
  static constexpr bool is_bounded = true, is_container = false;
  int axis = 2;
  Vec3 center = Vec3::Zero();
  Polygon points;
};
template <class Visit>
void describe(Revolution& revolution, Visit&& visit) {
  describe_axis(revolution.axis, revolution.center, visit);
  visit(revolution.points, {.name = "points",
                            .unit = "m",
                            .range = Range::position(),
                            .needed = true,
                            .remedy = "give the corners of the meridian, e.g. points = [[0, 0], [0.1, 0], [0, 0.3]]",
                            .values = "[[r, z], ...], r at least 0",
                            .meaning = "corners of the meridian in turn; the last joins the first"});
}

class TriangleSurface;
/// The body that a closed surface of triangles encloses, read from an STL file; in three dimensions.
struct Stl {
  static constexpr const char* name = "stl";
  static constexpr const char* summary = "what a closed surface of triangles encloses, ASCII or binary STL; in 3D";
  static constexpr bool is_bounded = true, is_container = false;
  std::string file;
  double scale = 1;
  std::shared_ptr<const TriangleSurface> read = nullptr;  ///< what the file holds
};
template <class Visit>
void describe(Stl& stl, Visit&& visit) {
  visit(stl.file, {.name = "file",
                   .needed = true,
                   .remedy = "give the .stl file, relative to the scene file",
                   .values = "an STL file",
                   .meaning = "relative to the scene file"});
  visit(
      stl.scale,
      {.name = "scale", .range = Range::above(0, 1e6), .meaning = "times the file's lengths makes metres: 1e-3 for millimetres"});
}

struct Union;
struct Intersection;
struct Difference;
struct Placed;
using Primitive = std::variant<Box, Slab, Sphere, Cylinder, TubeShape, Cone, Ellipsoid, HalfSpace, Revolution, Stl, Union,
                               Intersection, Difference, Placed>;

/// What lies in any of `shapes`.
struct Union {
  static constexpr const char* name = "union";
  static constexpr const char* summary = "what lies in any of some shapes";
  static constexpr bool is_bounded = true, is_container = false;
  std::vector<Primitive> shapes;
};
/// What lies in all of `shapes`.
struct Intersection {
  static constexpr const char* name = "intersection";
  static constexpr const char* summary = "what lies in all of some shapes";
  static constexpr bool is_bounded = true, is_container = false;
  std::vector<Primitive> shapes;
};
/// What lies in the first of `shapes` and in none of the others.
struct Difference {
  static constexpr const char* name = "difference";
  static constexpr const char* summary = "what lies in the first of some shapes, and in none of the others";
  static constexpr bool is_bounded = true, is_container = false;
  std::vector<Primitive> shapes;
};
template <class Visit>
void describe_shapes(std::vector<Primitive>& shapes, Visit&& visit) {
  visit(shapes, {.name = "shapes",
                 .needed = true,
                 .remedy = "give a list of shapes, e.g. shapes = [{type = \"sphere\", radius = 0.1}, {type = \"box\", ...}]",
                 .values = "list of [shapes](#shapes)",
                 .meaning = "one or more, of any type"});
}
template <class Visit>
void describe(Union& of, Visit&& visit) {
  describe_shapes(of.shapes, visit);
}
template <class Visit>
void describe(Intersection& of, Visit&& visit) {
  describe_shapes(of.shapes, visit);
}
template <class Visit>
void describe(Difference& of, Visit&& visit) {
  describe_shapes(of.shapes, visit);
}

/// How a shape is turned and moved.
struct Placement {
  Vec3 rotate = Vec3::Zero();  ///< axis times angle [deg]
  std::optional<Vec3> about;   ///< a point that stays while it turns [m]; none: the middle of the shape
  Vec3 move = Vec3::Zero();    ///< after the turn [m]
};
template <class Visit>
void describe(Placement& placement, Visit&& visit) {
  visit(placement.rotate,
        {.name = "rotate", .unit = "deg", .form = Form::turn, .meaning = "turns the shape: axis times angle, e.g. [0, 0, 30]"});
  visit(placement.about, {.name = "about",
                          .unit = "m",
                          .range = Range::position(),
                          .rule = "middle of the shape",
                          .meaning = "the point that stays where it is while the shape turns"});
  visit(placement.move, {.name = "move", .unit = "m", .range = Range::position(), .meaning = "moves it, after the turn"});
}

/// A shape turned and moved: place -> turn (place - about) + about + move. In a scene any table of a shape may have the keys of a
/// placement beside its own.
struct Placed {
  static constexpr const char* name = "turned shape";
  static constexpr const char* summary = "";
  static constexpr bool is_bounded = true, is_container = false, is_modifier = true;
  Placement placement;
  std::vector<Primitive> shape;  ///< one
  Mat3 turn = Mat3::Identity();

  /// The place in the unturned shape of a place in space, and the reverse [m].
  Vec3 before(const Vec3& x) const { return turn.transpose() * (x - *placement.about - placement.move) + *placement.about; }
  Vec3 after(const Vec3& x) const { return turn * (x - *placement.about) + *placement.about + placement.move; }
};
template <class Visit>
void describe(Placed& placed, Visit&& visit) {
  describe(placed.placement, visit);
}
/// `about` is settled here.
Placed placed(const Primitive& shape, const Placement& placement, int dimension);

/// A primitive less any number of others.
struct Shape {
  Primitive base;
  std::vector<Primitive> removed;
};

/// Have both the same numbers, those left out that mean nothing?
bool same_shape(const Primitive& one, const Primitive& other);

inline constexpr double endless_distance = std::numeric_limits<double>::infinity();
/// Signed distance [m] from x to the surface, negative inside; exact outside corners of the base excepted for
/// subtractions, unions and intersections, where the sign is exact and the size the usual lower bound. Only the first `dimension`
/// coordinates count.
/// What asks for less than all of it says so: where it is no less than `beyond`, any number is right that is no less either.
double signed_distance(const Primitive& shape, const Vec3& x, int dimension, double beyond = endless_distance);
double signed_distance(const Shape& shape, const Vec3& x, int dimension, double beyond = endless_distance);

/// Smallest box round the shape (of an intersection, what the boxes of its parts have in common); +-1e300 where it has no end.
Bounds bounds(const Primitive& shape, int dimension);
Bounds bounds(const Shape& shape, int dimension);

/// Does it end in all directions that the scene has?
bool is_bounded(const Primitive& shape, int dimension);

/// Is the shape no box, slab, sphere, cylinder, tube or cone? Then its whole surface is one face, "side", and a general mesh.
bool has_one_face(const Primitive& shape);

/// Is the shape its own mirror image across x[axis] = at? Of shapes without a formula for it, at 29 places along each axis.
bool is_mirrored(const Primitive& shape, int axis, double at, int dimension);

/// The middle of those bounds; 0 along axes without any.
Vec3 middle(const Primitive& shape, int dimension);

/// Volume [m^3] (area [m^2] in 2D, length [m] in 1D) of the part of `shape` inside `window`, to about 1e-5 relative,
/// by recursive subdivision of the window with the signed distance.
double volume(const Shape& shape, const Bounds& window, int dimension);
/// The same of the body of revolution about x = 0 of which a shape in two dimensions is the half at x > 0 [m^3].
double volume_of_revolution(const Shape& shape, const Bounds& window);

/// Integrals of ten weights over shape and window, as volume() computes that of 1, to about 1e-4 relative.
using Integrals = Eigen::Array<double, 10, 1>;
Integrals integrals(const Shape& shape, const Bounds& window, int dimension,
                    const std::function<Integrals(const Vec3&)>& weights);

}  // namespace undex
