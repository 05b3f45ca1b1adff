// Scenes that need one coordinate: their bodies and solids as layers from the inside out, along a radius or along x.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace undex::scene {

/// All that a body (or solid) has between two places, radii or positions along x [m].
struct LineLayer {
  bool is_solid;
  std::size_t index;  ///< of the scene's bodies, or solids
  double inner, outer;
};

/// What does not fit on a line: of the list "bodies", "solids" or "walls", the element of that index at that key.
struct LineFlaw {
  std::string list;
  std::size_t index;
  const char* key;
  std::string message;
};

struct Line {
  Vec3 center = Vec3::Zero();          ///< of the spheres [m]
  std::vector<LineLayer> layers;       ///< from the inside out, each beginning where the last ends
  std::array<bool, 2> closed{};        ///< is there a rigid wall, a plane of symmetry or the middle at the inner, the outer end?
  std::array<bool, 2> radiating{};     ///< or do waves leave there?
  double core_low = 0, core_high = 0;  ///< of the core: the first charge, or the innermost layer [m]
  bool graded = false;                 ///< do cells grow away from the core?
  /// Is all beyond the core at rest until the core's wave comes, so that the wave's front can be followed? Pressures on the two
  /// sides of a contact may differ by `held` [Pa], a thousandth of the core's: a body without stress in water under pressure.
  bool rests_ahead = false;
  double held = 0;
  /// At open ends [Pa]: the surroundings' pressure; without one, that which a fluid that lies round others has at the start.
  double outside_pressure = 0;
  std::vector<LineFlaw> flaws;

  double inner() const { return layers.front().inner; }
  double outer() const { return layers.back().outer; }
  /// Of a cell at that place where those of the core are `spacing` wide [m]: with the distance d from the core, whose thickness
  /// is L, it grows as (1 + d/(2 L))^(1/4), as a blast wave grows longer on its way.
  double cell_width(double place, double spacing) const;
  /// Of a cell that the followed front leaves behind there [m]: 4 s from d = 3/4 L on, and wider as (1 + d/(20 L))^(1/4).
  double front_width(double place, double spacing) const;
};

/// The line of a scene whose geometry has one; with flaws, as much of it as there is.
Line line_of(const Scene& scene);

/// Width of cells in the core unless the scene names one [m].
double default_spacing(const Line& line);

}  // namespace undex::scene
