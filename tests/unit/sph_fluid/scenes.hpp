// Small scenes that several tests of the fluid share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sph_fluid/water/fluid.hpp"

namespace undex::sph::testing {

inline Shape box(const Vec3& low, const Vec3& high) { return Shape{Box{low, high}, {}}; }

inline Body body(const std::string& name, const Shape& shape, const std::string& material) {
  Body body;
  body.name = name;
  body.shape = shape;
  body.material = materials::find_fluid(material).value();
  return body;
}

/// What a closed fluid keeps [J].
inline double total(const Ledger& l) { return l.kinetic + l.internal + l.dissipated + l.wall_work; }

inline Wall box_wall(const Vec3& low, const Vec3& high, FaceCondition condition = FaceCondition::free_slip) {
  Wall wall;
  wall.name = "box";
  wall.container = Box{low, high};
  for (const char* face : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"}) wall.faces[face] = condition;
  return wall;
}

inline Vec3 vector_of(const std::vector<double>& field, std::size_t i) {
  return {field[3 * i], field[3 * i + 1], field[3 * i + 2]};
}

/// A vector field in the order of the particles' ids.
inline std::vector<Vec3> by_id(const Fluid& fluid, std::string_view name) {
  const std::vector<double> id = fluid.field("id"), values = fluid.field(name);
  std::vector<Vec3> result(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) result[std::size_t(id[i])] = vector_of(values, i);
  return result;
}

}  // namespace undex::sph::testing
