// The block of water that the benchmarks and the instruction counts step: a cube full of particles between six rigid
// slip walls, on a jittered lattice, with a weak standing wave in it. Everything that a run of water does happens
// (particles change cells, every wall is felt, limiters act); nothing is so violent that the cost would change with time.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "sph_fluid/water/fluid.hpp"

namespace undex::bench {

/// What is full of water: a cube, a square in the plane, or the cylinder of which the square is the meridian.
enum class Space { cube, square, cylinder };

/// A way to compute: the parts of the name and what they set.
struct Variant {
  std::string name;  ///< "riemann/wendland_c2_1.5"
  sph::Numerics numerics;
  Space space = Space::cube;
};

/// Every combination of the axes below. A further axis is one more entry; a choice without a name leaves the names alone,
/// so that what is compared by name (recorded counts, old results) stays comparable.
inline std::vector<Variant> variants() {
  using sph::KernelName, sph::Numerics, sph::Precision, sph::SchemeName;
  struct Choice {
    const char* name;
    void (*set)(Numerics&);
  };
  static const std::vector<std::vector<Choice>> axes = {
      {{"monaghan", [](Numerics& n) { n.scheme = SchemeName::monaghan; }},
       {"riemann", [](Numerics& n) { n.scheme = SchemeName::riemann; }}},
      {{"gaussian_1.2", [](Numerics& n) { n.kernel = KernelName::gaussian, n.eta = 1.2; }},
       {"wendland_c2_1.3", [](Numerics& n) { n.kernel = KernelName::wendland_c2, n.eta = 1.3; }},
       {"wendland_c2_1.5", [](Numerics& n) { n.kernel = KernelName::wendland_c2, n.eta = 1.5; }}},
      {{"", [](Numerics& n) { n.precision = Precision::full; }}, {"mixed", [](Numerics& n) { n.precision = Precision::mixed; }}},
  };
  std::vector<Variant> all = {{}};
  for (const std::vector<Choice>& axis : axes) {
    std::vector<Variant> longer;
    for (const Variant& variant : all)
      for (const Choice& choice : axis) {
        Variant next = variant;
        if (!next.name.empty() && *choice.name != '\0') next.name += '/';
        next.name += choice.name;
        choice.set(next.numerics);
        longer.push_back(next);
      }
    all = longer;
  }
  for (const Precision precision : {Precision::full, Precision::mixed}) {
    Variant corrected{
        precision == Precision::full ? "riemann_corrected/wendland_c4_1.3" : "riemann_corrected/wendland_c4_1.3/mixed", {}};
    corrected.numerics.scheme = SchemeName::riemann_corrected;
    corrected.numerics.kernel = sph::default_kernel(SchemeName::riemann_corrected);
    corrected.numerics.eta = sph::default_eta(SchemeName::riemann_corrected, corrected.numerics.kernel);
    corrected.numerics.precision = precision;
    all.push_back(corrected);
  }
  for (const auto& [name, space] : {std::pair("square", Space::square), {"cylinder", Space::cylinder}})
    for (const Variant& cube : std::vector<Variant>(all))
      if (cube.space == Space::cube && cube.numerics.kernel == KernelName::wendland_c2 && cube.numerics.eta == 1.5)
        all.push_back({cube.name + "/" + name, cube.numerics, space});
  return all;
}

/// A cube (square, meridian) of about `particles` particles, 1 mm apart.
inline sph::Settings block(const Variant& variant, double particles, int threads) {
  constexpr double spacing = 1e-3;    // [m]
  constexpr double pressure = 1e7;    // [Pa], of the water at rest: the wave's troughs do not cavitate
  constexpr double amplitude = 5e-4;  // of the wave's density: about 1.2 MPa
  const bool cube_of_water = variant.space == Space::cube, rings = variant.space == Space::cylinder;
  const double side = spacing * std::round(cube_of_water ? std::cbrt(particles) : std::sqrt(particles));
  const Box cube{Vec3(rings ? -side : 0.0, 0.0, 0.0), Vec3::Constant(side)};
  const materials::Fluid water = materials::find_fluid("water-tait").value();
  const double density = materials::density_at(water.law, pressure, 0.0);

  sph::StartField wave;
  wave.state = [=](const Vec3& x, double) {
    const double phase = 2.0 * std::numbers::pi / side;
    return sph::StartState{density * (1.0 + amplitude * std::cos(phase * x[0])), 0.0, Vec3::Zero()};
  };
  wave.mass = density * side * side * (rings ? std::numbers::pi * side : cube_of_water ? side : 1.0);

  sph::Wall wall;
  wall.name = "box";
  wall.container = cube;
  for (const char* face : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"})
    wall.faces[face] = sph::FaceCondition::free_slip;

  sph::Settings settings;
  settings.dimension = cube_of_water ? 3 : 2;
  settings.axisymmetric = rings;
  settings.symmetry.axis[0] = rings;
  settings.lattice.spacing = spacing;
  settings.lattice.jitter = 0.05;
  sph::Body body;
  body.name = "water";
  body.shape = Shape{cube, {}};
  body.material = water;
  body.variable_h = false;
  body.start = std::make_shared<const sph::StartField>(wave);
  settings.bodies = {body};
  settings.walls = {wall};
  settings.numerics = variant.numerics;
  settings.numerics.threads = threads;
  return settings;
}

}  // namespace undex::bench
