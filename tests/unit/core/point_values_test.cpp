// Quantities of points: columns and values of numbers, vectors and tensors, from the lists.
#include "core/point_values.hpp"

#include <gtest/gtest.h>

namespace {

using namespace undex;

TEST(PointQuantities, FillTheirColumnsInOrder) {
  MaterialPoint point;
  point.velocity = Vec3(1, 2, 3);
  point.stress << 11, 12, 31, 12, 22, 23, 31, 23, 33;
  point.temperature = 300;
  const std::vector<std::string> names{"temperature", "stress", "velocity"};
  std::vector<std::string> columns;
  std::vector<double> row;
  for (const auto& quantity : chosen(material_quantities, names)) {
    for (const std::string& column : columns_of(quantity, 2)) columns.push_back(column);
    append_values(quantity, point, 2, row);
  }
  EXPECT_EQ(columns, (std::vector<std::string>{"temperature", "stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz",
                                               "stress_zx", "velocity_x", "velocity_y"}));
  EXPECT_EQ(row, (std::vector<double>{300, 11, 22, 33, 12, 23, 31, 1, 2}));
}

TEST(PointQuantities, OfTheFluid) {
  FluidPoint point;
  point.pressure = 5;
  point.velocity = Vec3(1, 2, 3);
  std::vector<double> row;
  for (const auto& quantity : fluid_quantities) append_values(quantity, point, 3, row);
  EXPECT_EQ(row, (std::vector<double>{5, 1, 2, 3, 0, 0}));
  EXPECT_EQ(names_of(fluid_quantities), (std::vector<std::string>{"pressure", "velocity", "density", "void_fraction"}));
}

TEST(PointQuantities, UnknownNamesAreNone) { EXPECT_TRUE(chosen(fluid_quantities, std::vector<std::string>{"stress"}).empty()); }

}  // namespace
