// What is known at a point of the fluid and at a material point of a body, and the quantities that a probe may ask of it. To add
// one is to add a member and its line below: scene files, the columns of histories and their units follow from the lists.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/vector.hpp"

namespace undex {

/// Fluid at a fixed point: averages over the particles near it.
struct FluidPoint {
  double pressure = 0, density = 0, void_fraction = 0;  ///< [Pa], [kg/m^3], [-]
  Vec3 velocity = Vec3::Zero();                         ///< [m/s]
  int neighbours = 0;                                   ///< 0: no fluid there, the values are zero
};

/// A material point of a body.
struct MaterialPoint {
  Vec3 position = Vec3::Zero(), displacement = Vec3::Zero();  ///< [m]
  Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero();  ///< [m/s], [m/s^2]
  Mat3 stress = Mat3::Zero();                                 ///< Cauchy, tension positive [Pa]
  double plastic_strain = 0, temperature = 0;                 ///< [-], [K]
};

/// A quantity of a point: a number, a vector (as many columns as the scene has dimensions) or a symmetric tensor (six).
template <class Point>
struct PointQuantity {
  const char* name;
  const char* unit;
  std::variant<double Point::*, Vec3 Point::*, Mat3 Point::*> value;
};

inline constexpr PointQuantity<FluidPoint> fluid_quantities[] = {
    {"pressure", "Pa", &FluidPoint::pressure},
    {"velocity", "m/s", &FluidPoint::velocity},
    {"density", "kg/m3", &FluidPoint::density},
    {"void_fraction", "", &FluidPoint::void_fraction},
};
inline constexpr PointQuantity<MaterialPoint> material_quantities[] = {
    {"displacement", "m", &MaterialPoint::displacement},
    {"velocity", "m/s", &MaterialPoint::velocity},
    {"stress", "Pa", &MaterialPoint::stress},
    {"plastic_strain", "", &MaterialPoint::plastic_strain},
    {"temperature", "K", &MaterialPoint::temperature},
};

/// Their names, in the order of a list.
template <class Point, std::size_t count>
std::vector<std::string> names_of(const PointQuantity<Point> (&list)[count]) {
  std::vector<std::string> names;
  for (const PointQuantity<Point>& quantity : list) names.emplace_back(quantity.name);
  return names;
}

/// Those that are named, in the order of the names; names that the list has not are passed over.
template <class Point, std::size_t count>
std::vector<PointQuantity<Point>> chosen(const PointQuantity<Point> (&list)[count], std::span<const std::string> names) {
  std::vector<PointQuantity<Point>> quantities;
  for (const std::string& name : names)
    for (const PointQuantity<Point>& quantity : list)
      if (name == quantity.name) quantities.push_back(quantity);
  return quantities;
}

/// Names of the columns that a quantity fills: "density"; "velocity_x", "velocity_y", ...; "stress_xx", ...
template <class Point>
std::vector<std::string> columns_of(const PointQuantity<Point>& quantity, int dimension) {
  static constexpr const char* axes[] = {"_x", "_y", "_z"};
  const std::string name = quantity.name;
  if (std::holds_alternative<double Point::*>(quantity.value)) return {name};
  std::vector<std::string> columns;
  if (std::holds_alternative<Vec3 Point::*>(quantity.value))
    for (int a = 0; a < dimension; ++a) columns.push_back(name + axes[a]);
  else
    for (const char* part : {"_xx", "_yy", "_zz", "_xy", "_yz", "_zx"}) columns.push_back(name + part);
  return columns;
}

/// Appends the values of those columns.
template <class Point>
void append_values(const PointQuantity<Point>& quantity, const Point& point, int dimension, std::vector<double>& row) {
  if (const auto* number = std::get_if<double Point::*>(&quantity.value)) {
    row.push_back(point.**number);
  } else if (const auto* vector = std::get_if<Vec3 Point::*>(&quantity.value)) {
    const Vec3& value = point.**vector;
    row.insert(row.end(), value.data(), value.data() + dimension);
  } else {
    const Mat3& value = point.*std::get<Mat3 Point::*>(quantity.value);
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}) row.push_back(value(i, j));
  }
}

}  // namespace undex
