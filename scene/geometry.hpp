// Questions about shapes that a check of a scene asks: do two overlap, is one inside the other.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/shapes.hpp"

namespace undex::scene {

/// Depth [m] of a point in something: positive inside, changing by at most the distance moved.
using Depth = std::function<double(const Vec3&)>;
/// Of a surface whose distance is dear: where it is no less than `beyond`, any number that is no less either.
struct NearDepth : std::function<double(const Vec3&, double beyond)> {
  using function::function;
  NearDepth(const Depth& exact) : function([exact](const Vec3& x, double) { return exact(x); }) {}
};

Vec3 gradient(const Depth& depth, const Vec3& x, double step, int dimension);

NearDepth inside(const Shape& shape, int dimension);
NearDepth outside(const Shape& shape, int dimension);

/// A point of the window that is deeper than `depth` in both, if a search by samples finds one: on a grid, and from each
/// grid point just under the surface of either. So thin overlaps along surfaces are found; tiny ones at a corner may not be.
std::optional<Vec3> find_in_both(const NearDepth& a, const NearDepth& b, const Bounds& window, double depth, int dimension);

/// The common part of two boxes.
Bounds common(const Bounds& a, const Bounds& b);

/// The longest edge of a box [m].
double longest(const Bounds& box, int dimension);

/// Of obstacles: what is longer than so many times all bodies of fluid together is in other units.
inline constexpr double most_lengths_of_water = 10;

/// "; ...": asks whether a file of the shape is in millimetres, where it has no scale and is longer than `usual` [m]; else empty.
std::string in_millimetres(const Primitive& shape, double usual);

/// The part of space that is computed: x[axis] >= 0 where there is a symmetry plane.
Bounds kept_part(const std::array<bool, 3>& symmetric);

}  // namespace undex::scene
