// The top-level key `dimension`: a number of coordinates, or a symmetry that leaves fewer of them than the scene is written in.
#pragma once

#include <array>

#include "core/record.hpp"

namespace undex::scene {

/// What is computed of the space that a scene is written in.
enum class Geometry {
  cartesian,     ///< all of it: 1, 2 or 3 coordinates
  axisymmetric,  ///< bodies of revolution about one axis: their meridian; written in 3
  spherical,     ///< concentric spheres and shells: a radius; written in 3
  plane,         ///< layers across x: the one-dimensional mesh; written in 1
};
/// But for `cartesian`, which is written as a number.
constexpr auto words(Geometry) {
  return std::to_array<Word<Geometry>>(
      {{"axisymmetric", Geometry::axisymmetric}, {"spherical", Geometry::spherical}, {"plane", Geometry::plane}});
}
/// How many coordinates the scene file gives, of a geometry that has a word.
constexpr int coordinates_of(Geometry geometry) { return geometry == Geometry::plane ? 1 : 3; }

/// Is it run on the one-dimensional Lagrangian mesh, without particles?
constexpr bool on_a_line(Geometry geometry) { return geometry == Geometry::spherical || geometry == Geometry::plane; }

/// Both as one parameter.
struct Dimension {
  int& coordinates;
  Geometry& geometry;
};

}  // namespace undex::scene
