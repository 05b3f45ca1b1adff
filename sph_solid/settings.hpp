// What a scene says about solids in particles: bodies, their scheme, rigid planes. SI units. Dimension, gravity, symmetry planes,
// lattice, threads and start are those of all particles (sph::Settings).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/radial_motion.hpp"
#include "core/record.hpp"
#include "core/rigid_plane.hpp"
#include "core/shapes.hpp"
#include "core/support.hpp"
#include "materials/solid.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::solid {

/// What the particles of a solid body call their neighbours.
enum class Description {
  total_lagrangian,    ///< those of the start, for ever: no tensile instability, and no fragments
  updated_lagrangian,  ///< those of the moment: any deformation, and fracture
};
constexpr auto words(Description) {
  return std::to_array<Word<Description>>(
      {{"total_lagrangian", Description::total_lagrangian}, {"updated_lagrangian", Description::updated_lagrangian}});
}

/// A solid in particles (solids.hpp).
struct Body {
  std::string name;
  Shape shape;
  materials::Solid material;
  Description description = Description::total_lagrangian;
  std::optional<double> spacing;                           ///< [m]; default: the scene's
  sph::LatticeType lattice = sph::LatticeType::cartesian;  ///< fitted to the body's own shape, always; rings: cylinders and tubes
  Vec3 velocity = Vec3::Zero();                            ///< [m/s]
  Vec3 spin = Vec3::Zero();                                ///< [rad/s], about the middle of the shape
  std::optional<RadialMotion> radial;                      ///< added to both
  bool moves() const { return !velocity.isZero(0.0) || !spin.isZero(0.0) || radial; }
  /// Stress in equilibrium at the start, of discs and cylinders: with R the radius, S (1 - r^2/R^2) radial and
  /// S (1 - 3 r^2/R^2) along the circumference (quenching leaves such a stress) [Pa].
  double residual_stress = 0;
  /// Faces that water touches ("inner", "outer", "low", "high", "side", "x_low" ...): it does not see others. Empty: every face.
  std::vector<std::string> wet;
  std::vector<Support> supports;  ///< their particles are those within a spacing of the face at the start
};
template <class Visit>
void describe(Body& solid, Visit&& visit) {
  visit(solid.name, {.name = "name",
                     .needed = true,
                     .remedy = "every solid has a name",
                     .form = Form::name,
                     .meaning = "different from all bodies'"});
  visit(ByHand{}, {.name = "shape",
                   .needed = true,
                   .remedy = "e.g. shape = {type = \"sphere\", radius = 0.01}",
                   .values = "a [shape](#shapes)",
                   .meaning = "its outside; not a slab"});
  visit(solid.shape.removed, {.name = "subtract",
                              .values = "list of [shapes](#shapes) and names",
                              .meaning = "what is taken out, as for [bodies](#bodies)"});
  visit(ByHand{}, {.name = "material",
                   .needed = true,
                   .remedy = "e.g. material = \"al-5083-h116\" ('undex materials' lists them)",
                   .values = "a solid",
                   .meaning = "see [materials](#materials)"});
  visit(solid.description,
        {.name = "description",
         .meaning = "neighbours of a particle are those of the start (no fragments), or those of the moment (fracture)"});
  visit(solid.spacing, {.name = "spacing",
                        .unit = "m",
                        .range = Range::length(),
                        .rule = "that of `resolution`",
                        .meaning = "a distance of particles of its own"});
  visit(solid.lattice, {.name = "lattice",
                        .rule = "\"rings\" for cylinders and tubes, else \"cartesian\"",
                        .meaning = "rings follow a curved surface; in 2D a cylinder or tube with axis \"z\" has them"});
  visit(solid.velocity, {.name = "velocity", .unit = "m/s", .meaning = "at the start"});
  visit(solid.spin,
        {.name = "spin", .unit = "rad/s", .form = Form::turn, .meaning = "at the start, about the middle of the shape"});
  visit(ByHand{}, {.name = "radial",
                   .rule = "none",
                   .values = "a [table](#radial-motion)",
                   .meaning = "at the start, towards or away from a point or an axis; added to `velocity`"});
  visit(solid.residual_stress, {.name = "residual_stress",
                                .unit = "Pa",
                                .meaning = "S of a stress in equilibrium at the start; of whole cylinders, in 2D discs"});
  visit(solid.wet, {.name = "wet",
                    .values = "list of faces",
                    .meaning = "those that water touches; empty: all that do not lie on solids, walls or symmetry planes"});
  visit(
      ByHand{},
      {.name = "supports", .rule = "[]", .values = "list of tables", .meaning = "held faces, as of the [structure](#structure)"});
}

/// Kernel (Wendland's) and steps of solid particles.
struct Numerics {
  double eta = 1.3;                ///< h/dx
  double courant = 0.5;            ///< of the stable step, as estimated from h and the longitudinal wave
  double linear_viscosity = 0.06;  ///< bulk viscosity on compression, as the elements have it (fem_structure)
  double quadratic_viscosity = 1.2;
  double hourglass = 0.1;          ///< total Lagrangian: stiffness of what no deformation gradient sees, in shear moduli
  double alpha = 1.0, beta = 2.0;  ///< updated Lagrangian: viscosity of pairs (solid_schemes.hpp)
  double artificial_stress = 0.3;  ///< updated Lagrangian: share of a tension that repels particles nearer than a spacing
};
template <class Visit>
void describe(Numerics& numerics, Visit&& visit) {
  visit(numerics.eta,
        {.name = "eta", .range = Range::between(0.8, 3), .meaning = "smoothing length h/dx of the solids' kernel (Wendland's)"});
  visit(numerics.courant, {.name = "courant",
                           .range = Range::above(0, 1),
                           .meaning = "share of the stable step, as estimated from h and the longitudinal wave"});
  visit(numerics.linear_viscosity, {.name = "linear_viscosity",
                                    .range = Range::between(0, 10),
                                    .meaning = "total Lagrangian: bulk viscosity on compression, as the structure's"});
  visit(numerics.quadratic_viscosity,
        {.name = "quadratic_viscosity", .range = Range::between(0, 100), .meaning = "and its quadratic term"});
  visit(numerics.hourglass, {.name = "hourglass",
                             .range = Range::between(0, 10),
                             .meaning = "total Lagrangian: stiffness of motions without strain, in shear moduli"});
  visit(numerics.alpha, {.name = "alpha",
                         .range = Range::between(0, 100),
                         .meaning = "updated Lagrangian and contact: linear coefficient of Monaghan's viscosity"});
  visit(numerics.beta, {.name = "beta", .range = Range::between(0, 1000), .meaning = "and the quadratic one"});
  visit(numerics.artificial_stress, {.name = "artificial_stress",
                                     .range = Range::between(0, 1),
                                     .meaning = "updated Lagrangian: share of a tension that keeps particles from clumping"});
}

struct Settings {
  std::vector<Body> bodies;
  Numerics numerics;
  std::vector<RigidPlane> planes;
};

}  // namespace undex::solid
