// Wet surfaces, and structures with one, that the tests of the coupling share.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/surface.hpp"

namespace undex::coupling::testing {

/// The plane z = 0 over 0..a x 0..b in nx x ny faces, wetted from below: normals point to +z. `skew` moves the inner nodes
/// within the plane.
inline WetSurface plate(double a, double b, int nx, int ny, double skew = 0.0) {
  WetSurface surface;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      Vec3 x(a * i / nx, b * j / ny, 0.0);
      if (i > 0 && i < nx && j > 0 && j < ny) x += skew * Vec3(std::sin(7.0 * i + j), std::cos(3.0 * i - 2.0 * j), 0);
      surface.nodes.push_back(x);
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int n = j * (nx + 1) + i;
      surface.faces.push_back({n, n + 1, n + nx + 2, n + nx + 1});
    }
  return surface;
}

/// Inside of a cylinder of radius R about z, from `low` to `high`: normals point outwards. `angle` is the part of the turn
/// that is there, from the x axis on; 2 pi closes it.
inline WetSurface cylinder(double R, double low, double high, int around, int along, double angle) {
  WetSurface surface;
  const bool closed = std::abs(angle - 2 * std::numbers::pi) < 1e-9;
  const int columns = closed ? around : around + 1;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < columns; ++i) {
      const double at = angle * i / around;
      surface.nodes.push_back({R * std::cos(at), R * std::sin(at), low + (high - low) * j / along});
    }
  if (!closed && std::abs(angle - 0.5 * std::numbers::pi) < 1e-9)
    for (int j = 0; j <= along; ++j) surface.nodes[j * columns + around][0] = 0.0;  // on the plane, not nearly
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int right = (i + 1) % columns;
      surface.faces.push_back({j * columns + i, j * columns + right, (j + 1) * columns + right, (j + 1) * columns + i});
    }
  return surface;
}

}  // namespace undex::coupling::testing
