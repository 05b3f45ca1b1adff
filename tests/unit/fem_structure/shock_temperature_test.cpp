// Temperature behind plane shocks in elements of both kinds.
#include <gtest/gtest.h>

#include "bodies.hpp"
#include "materials/library.hpp"
#include "tests/unit/materials/solid_hugoniot.hpp"

namespace undex::fem::testing {
namespace {

/// Mean temperature [K] well behind the shock in a bar that is held sideways and meets a rigid plane at `u` [m/s].
double behind_the_shock(ElementKind element, double u, double length) {
  const double side = 0.0005;
  const int n = 120;
  Settings bar = plate(Vec3(0, 0, 0), Vec3(side, side, length), {1, 1, n}, *materials::find_solid("al-impact-table2"));
  bar.element = element;
  bar.initial_velocity = Vec3(0, 0, -u);
  bar.planes = {{2, 0.0, true}};
  bar.courant = 0.3;  // at 0.8 a shock of 3 km/s passes a cell in less than two steps, and its heat comes in waves
  for (const char* face : {"x_low", "x_high"}) bar.supports.push_back({face, {true, false, false}});
  for (const char* face : {"y_low", "y_high"}) bar.supports.push_back({face, {false, true, false}});
  Structure structure(bar);
  structure.advance(0.55 * length / (5300 + 1.5 * u), {});
  double sum = 0;
  const int count = 10;
  for (int k = 0; k < count; ++k)
    sum += structure.read(structure.locate(Vec3(0.5 * side, 0.5 * side, length * (0.1 + 0.015 * k)))).temperature;
  return sum / count;
}

TEST(ShockTemperature, IsThatOfTheHugoniot) {
  for (const ElementKind element : {ElementKind::hexahedron, ElementKind::shell})
    for (const double u : {1000.0, 3090.0}) {
      const double exact = materials::testing::hugoniot_temperature(*materials::find_solid("al-impact-table2"), u);
      EXPECT_NEAR(behind_the_shock(element, u, 0.03) / exact, 1.0, 0.01)
          << (element == ElementKind::shell ? "shells, " : "hexahedra, ") << u << " m/s, exact " << exact << " K";
    }
}

}  // namespace
}  // namespace undex::fem::testing
