// Bodies and error norms that the verification tests share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sph_fluid/water/fluid.hpp"

namespace undex::sph::testing {

/// One-dimensional body between low and high [m].
inline Body slab(const std::string& name, double low, double high, const std::string& material, double velocity) {
  Body body;
  body.name = name;
  body.shape.base = Box{Vec3(low, -1, -1), Vec3(high, 1, 1)};
  body.material = materials::find_fluid(material).value();
  body.velocity = Vec3(velocity, 0, 0);
  return body;
}

inline Settings scene_1d(double spacing, SchemeName scheme) {
  Settings settings;
  settings.dimension = 1;
  settings.lattice.spacing = spacing;
  settings.numerics.scheme = scheme;
  settings.numerics.threads = 1;
  settings.numerics.courant = 0.25;  // what is measured here is the error in space, whatever the default
  return settings;
}

inline void run_until(Fluid& fluid, double end) {
  while (fluid.time() < end * (1 - 1e-12)) fluid.step(std::min(fluid.step_limit().step, end - fluid.time()));
}

/// Coordinates of a one-dimensional vector field.
inline std::vector<double> along_x(const std::vector<double>& field) {
  std::vector<double> x;
  for (std::size_t i = 0; i < field.size(); i += 3) x.push_back(field[i]);
  return x;
}

inline std::string name_of(SchemeName scheme) {
  return scheme == SchemeName::riemann ? "riemann" : scheme == SchemeName::riemann_corrected ? "riemann_corrected" : "monaghan";
}

inline std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

class Schemes : public ::testing::TestWithParam<SchemeName> {
 protected:
  /// A figure for the log and the test report.
  void report(const std::string& name, double value) {
    RecordProperty(name, scientific(value));
    std::printf("  %s: %s = %.5g\n", name_of(GetParam()).c_str(), name.c_str(), value);
  }
};

}  // namespace undex::sph::testing
