// What a scene says about the coupling of water and structure, of water and solids in particles, and about rigid bodies in the
// water.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/record.hpp"
#include "core/shapes.hpp"

namespace undex::coupling {

struct Settings {
  /// Slip of the water along the wet faces.
  bool free_slip = true;
  /// Longest coupling window, in structure steps: the structure is advanced once the fluid has covered this share of the
  /// structure's stable step (or at every fluid step, when the fluid's is the longer one).
  double window = 1.0;
};

template <class Visit>
void describe(Settings& coupling, Visit&& visit) {
  visit(coupling.free_slip, {.name = "slip", .meaning = "water slips along the wet faces and solids"});
  visit(coupling.window, {.name = "window",
                          .range = Range::between(0.01, 100),
                          .meaning = "longest coupling window, in stable steps of the structure"});
}

/// How a rigid body in the water moves: not at all; as water, gravity and a force drive it; or as it is told to.
enum class Motion { fixed, free, prescribed };
constexpr auto words(Motion) {
  return std::to_array<Word<Motion>>({{"fixed", Motion::fixed}, {"free", Motion::free}, {"prescribed", Motion::prescribed}});
}
enum class Skin { free_slip, no_slip };
constexpr auto words(Skin) { return std::to_array<Word<Skin>>({{"free_slip", Skin::free_slip}, {"no_slip", Skin::no_slip}}); }

/// A rigid body that stands in the water. Of bodies that symmetry planes cut, mass and inertia are those of the whole; in two
/// dimensions those of a metre of depth, in one of a square metre.
struct Obstacle {
  std::string name;
  Primitive shape;
  Motion motion = Motion::fixed;
  Skin condition = Skin::free_slip;
  std::optional<double> density;   ///< [kg/m^3]
  std::optional<double> mass;      ///< [kg]
  std::vector<double> inertia;     ///< [kg m^2] about the middle of mass: xx, yy, zz, or also xy, yz, zx; in 2D zz
  std::vector<std::string> fixed;  ///< of "x", "y", "z", "rx", "ry", "rz"
  Vec3 velocity = Vec3::Zero();    ///< of a free one at the start [m/s]
  Vec3 spin = Vec3::Zero();        ///< [rad/s]
  Vec3 direction = Vec3::Zero();   ///< of `speed` or `force`
  std::vector<double> time;        ///< [s]
  std::vector<double> speed;       ///< at those times [m/s]; linear between them, constant before and after
  std::vector<double> force;       ///< [N], likewise
};

template <class Visit>
void describe(Obstacle& obstacle, Visit&& visit) {
  visit(obstacle.name,
        {.name = "name", .rule = "its number", .form = Form::name, .meaning = "of its history's file: no probe has the same"});
  visit(ByHand{}, {.name = "shape",
                   .needed = true,
                   .remedy = "give the body's shape, e.g. shape = {type = \"sphere\", center = [0, 0, 0], radius = 0.1}",
                   .values = "[shape](#shapes)",
                   .meaning = "its place at the start; the bodies of water leave room for it by themselves"});
  visit(obstacle.motion,
        {.name = "motion", .meaning = "at rest; driven by water, gravity and `force`; or with the given `speed`"});
  visit(obstacle.condition, {.name = "condition", .meaning = "the water slips along it; \"no_slip\" is not built, and refused"});
  const bool free = obstacle.motion == Motion::free, told = obstacle.motion == Motion::prescribed;
  visit(obstacle.density, {.name = "density",
                           .unit = "kg/m3",
                           .range = Range::positive(),
                           .used = free,
                           .meaning = "of a free body; at least a hundredth of the water's. It or `mass`"});
  visit(obstacle.mass, {.name = "mass",
                        .unit = "kg",
                        .range = Range::positive(),
                        .rule = "`density` times the shape's volume",
                        .used = free,
                        .meaning = "of a free body, whole where symmetry planes cut it; in 2D per metre of depth"});
  visit(obstacle.inertia, {.name = "inertia",
                           .unit = "kg m2",
                           .rule = "that of a uniform density",
                           .values = "[xx, yy, zz] or [xx, yy, zz, xy, yz, zx]; in 2D [zz]",
                           .used = free,
                           .meaning = "moments of inertia of a free body about the middle of the shape"});
  visit(obstacle.fixed, {.name = "fixed",
                         .values = "list of \"x\", \"y\", \"z\", \"rx\", \"ry\", \"rz\"",
                         .used = free,
                         .meaning = "what a free body does not do: move along x, y, z, or turn about them"});
  visit(obstacle.velocity, {.name = "velocity", .unit = "m/s", .used = free, .meaning = "of a free body at the start"});
  visit(obstacle.spin,
        {.name = "spin", .unit = "rad/s", .form = Form::turn, .used = free, .meaning = "of a free body at the start"});
  visit(obstacle.direction, {.name = "direction",
                             .rule = "none",
                             .used = told || !obstacle.force.empty(),
                             .meaning = "of `speed` or `force`, of any length"});
  visit(obstacle.time, {.name = "time",
                        .unit = "s",
                        .values = "list, increasing",
                        .used = told || !obstacle.force.empty(),
                        .meaning = "of the values of `speed` or `force`: linear between, constant before and after"});
  visit(obstacle.speed, {.name = "speed",
                         .unit = "m/s",
                         .values = "list",
                         .used = told,
                         .meaning = "\"prescribed\": along `direction` at these times, as of a piston"});
  visit(obstacle.force, {.name = "force",
                         .unit = "N",
                         .values = "list",
                         .used = free,
                         .meaning = "\"free\": acts along `direction` at these times, at the middle of mass"});
}

}  // namespace undex::coupling
