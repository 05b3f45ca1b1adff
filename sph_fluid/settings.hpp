// What a scene says about the fluid: lattice, bodies, walls, symmetry, scheme. SI units throughout.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/radial_motion.hpp"
#include "core/record.hpp"
#include "core/shapes.hpp"
#include "materials/burn.hpp"
#include "materials/hydrostatic.hpp"
#include "materials/library.hpp"
#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/schemes/table.hpp"

namespace undex::sph {

constexpr auto words(SchemeName) {
  std::array<Word<SchemeName>, std::size(scheme_names)> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {scheme_names[i].first, scheme_names[i].second};
  return all;
}
inline auto words(KernelName) {
  std::array<Word<KernelName>, std::size(all_kernels)> all{};
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = {with_kernel(all_kernels[i], [](auto kernel) { return kernel.name; }), all_kernels[i]};
  return all;
}

constexpr auto words(Precision) {
  return std::to_array<Word<Precision>>({{"full", Precision::full}, {"mixed", Precision::mixed}});
}

/// How the fluid advances in time (docs/theory/equations.md, section 7).
enum class Integrator {
  leapfrog,  ///< kick-drift-kick, its one evaluation a step at a predicted state
  ssp_rk3,   ///< Runge-Kutta, strong-stability-preserving, third order: three evaluations a step
};
constexpr auto words(Integrator) {
  return std::to_array<Word<Integrator>>({{"leapfrog", Integrator::leapfrog}, {"ssp_rk3", Integrator::ssp_rk3}});
}

/// Courant number of a scene that names none. C6 is slim within its support: for its width, 0.35 is the step that 0.45 is for C2,
/// where waves grow (docs/results/performance.md).
inline double default_courant(Integrator integrator, KernelName kernel) {
  const double leapfrog = kernel == KernelName::wendland_c6 ? 0.27 : 0.35;
  return integrator == Integrator::ssp_rk3 ? 2.0 * leapfrog : leapfrog;
}

/// Kernel of a scene that names none, and its h/dx. riemann_corrected takes C4 at the least h/dx where the second moment of the
/// kernel on a lattice is stationary: a lattice that is stretched then keeps its sums (docs/theory/equations.md).
inline KernelName default_kernel(SchemeName scheme) {
  return scheme == SchemeName::paper               ? KernelName::gaussian
         : scheme == SchemeName::riemann_corrected ? KernelName::wendland_c4
                                                   : KernelName::wendland_c2;
}
inline double default_eta(SchemeName scheme, KernelName kernel) {
  if (scheme == SchemeName::riemann_corrected && kernel == KernelName::wendland_c4) return 1.3;
  return with_kernel(kernel, [](auto k) { return k.usual_eta; });
}

/// What a wall does to the flow.
enum class FaceCondition {
  no_slip,
  free_slip,
  open,       ///< no wall there
  radiating,  ///< waves leave: it moves as the same medium without end behind it would (water/radiating_faces.hpp)
};
constexpr auto words(FaceCondition) {
  return std::to_array<Word<FaceCondition>>({{"no_slip", FaceCondition::no_slip},
                                             {"free_slip", FaceCondition::free_slip},
                                             {"open", FaceCondition::open},
                                             {"radiating", FaceCondition::radiating}});
}

/// How particles are laid out at the start.
enum class LatticeType {
  cartesian,  ///< spacing dx along each axis, particles at the cells' centres
  rings,      ///< concentric rings about an axis, fitted to a radius: quietest beside a cylindrical wall
};
constexpr auto words(LatticeType) {
  return std::to_array<Word<LatticeType>>({{"cartesian", LatticeType::cartesian}, {"rings", LatticeType::rings}});
}

/// The lattice that bodies fill. One lattice serves all bodies that do not ask for a spacing of their own, so that
/// neighbouring bodies meet without gap or overlap.
struct Lattice {
  LatticeType type = LatticeType::cartesian;
  double spacing = 0;  ///< dx [m]
  /// Name of the body (or wall) to whose base shape the lattice is fitted: its extent along each axis (radius, for
  /// rings) is cut into a whole number of spacings. Empty: cell corners at multiples of dx from `origin`.
  std::string fit;
  Vec3 origin = Vec3::Zero();    ///< [m]
  Vec3 rotation = Vec3::Zero();  ///< of a Cartesian lattice about `origin`: axis times angle [deg]; not with `fit`
  /// Jitter of the start as a share of dx, from a fixed seed: 0 is a perfect lattice.
  double jitter = 0;
  bool settle = true;  ///< are particles moved until uniform pressure leaves them at rest (water/settle.hpp)?
};
template <class Visit>
void describe(Lattice& lattice, Visit&& visit) {
  visit(lattice.spacing, {.name = "spacing",
                          .unit = "m",
                          .range = Range::length(),
                          .rule = "required with bodies, and with solids without a spacing of their own",
                          .used = lattice.spacing > 0,
                          .meaning = "distance of particles, dx"});
  visit(lattice.type, {.name = "lattice",
                       .meaning = "\"rings\": concentric rings about an axis, quietest at a cylindrical wall; "
                                  "not in 1D"});
  visit(lattice.fit, {.name = "fit",
                      .values = "name of a body or wall",
                      .meaning = "its extents (for rings its radius) become whole spacings; rings need it"});
  visit(lattice.origin, {.name = "origin",
                         .unit = "m",
                         .range = Range::position(),
                         .meaning = "without `fit`: corners of the lattice's cells lie at multiples of dx from here"});
  visit(lattice.rotation, {.name = "rotation",
                           .unit = "deg",
                           .form = Form::turn,
                           .meaning = "turns a Cartesian lattice without `fit` about `origin`: axis times angle"});
  visit(lattice.jitter, {.name = "jitter",
                         .range = Range::between(0, 0.5),
                         .meaning = "random displacement of the start as a share of dx, always the same one"});
  visit(lattice.settle, {.name = "settle",
                         .meaning = "move particles before the start until uniform pressure leaves them at rest "
                                    "([how](../theory/equations.md#settled-starts))"});
}

/// State of one particle at the start.
struct StartState {
  double density = 0;            ///< [kg/m^3]
  double energy = 0;             ///< specific internal energy [J/kg]; ignored where the law is barotropic
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
};

/// The particles of a body as a start has laid them, in the order of their numbers, in the solver's frame.
struct LaidParticles {
  std::vector<Vec3> position, velocity;       ///< [m], [m/s]
  std::vector<double> density, mass, energy;  ///< [kg/m^3], [kg], [J/kg]
};

/// A start that is not uniform: a wave, or a computation before this one.
struct StartField {
  /// State of the particle at x [m] that stands for a cell of width `spacing` [m].
  std::function<StartState(const Vec3& x, double spacing)> state;
  /// Is the lattice's point x [m] the body's? In place of its shape, within `box`. Empty: the shape says it.
  std::function<bool(const Vec3& x)> covers;
  Bounds box;
  /// Of the kept part [kg]; the particles' masses are scaled to it. Zero: nothing is scaled, the states are exact means.
  double mass = 0;
  /// Of the kept part [J]. What of it the particles have not (motion within a spacing) is heat: part of their internal energy,
  /// or dissipated where the law has none.
  double kinetic_energy = 0;
  double internal_energy = 0;  ///< of the kept part [J]; energies are scaled to it where the law has them
  /// Are momentum and the sum of energies exact too? What particles lack of them is given to those in motion, and the compression
  /// energy that a barotropic body lacks is dissipated as well.
  bool exact = false;
  Vec3 momentum = Vec3::Zero();  ///< of the kept part [kg m/s], where it is exact; not across symmetry planes
  /// Where the body is hydrostatic: the pressure of the uniform rest that the state was computed for [Pa]. The column's pressure
  /// beyond it is added. Nothing: the state has the column in it.
  std::optional<double> rest_pressure;
  LaidParticles laid;  ///< where there are some they are the body, and nothing else counts
};

struct Body {
  std::string name;
  Shape shape;
  materials::Fluid material;
  std::optional<double> spacing;                  ///< own lattice [m]; default: the scene's
  Vec3 velocity = Vec3::Zero();                   ///< [m/s]
  std::optional<double> pressure;                 ///< [Pa]; gives the density where that is not named
  std::optional<double> density;                  ///< [kg/m^3]
  std::optional<double> energy;                   ///< specific internal energy [J/kg]; default: the material's own
  std::optional<materials::ProgrammedBurn> burn;  ///< charges: default is an instantaneous burn only where asked
  /// May the smoothing length follow the density? Default: gases and detonation products do, liquids do not.
  bool variable_h = false;
  /// Particles that have grown past twice their width split, one that was laid into this many at most; 1: never (split.hpp).
  int split = 1;
  std::shared_ptr<const StartField> start;  ///< null: uniform, as above
  double radial_velocity = 0;               ///< away from the middle of the shape's base, added to `velocity` [m/s]
  std::optional<RadialMotion> radial;       ///< added too
  Vec3 spin = Vec3::Zero();                 ///< about the middle of the shape's base, added too [rad/s]

  bool moves() const { return !velocity.isZero(0.0) || !spin.isZero(0.0) || radial_velocity != 0 || radial; }
  std::optional<Vec3> level{};  ///< a point where `pressure` is found; elsewhere it is hydrostatic [m]
};

template <class Visit>
void describe(Body& body, Visit&& visit) {
  visit(body.name, {.name = "name", .needed = true, .remedy = "every body has a name", .form = Form::name});
  visit(ByHand{}, {.name = "shape",
                   .needed = true,
                   .remedy = "e.g. shape = {type = \"box\", low = [0, 0, 0], high = [1, 1, 1]}",
                   .values = "a [shape](#shapes)",
                   .meaning = "its outside; bounded on all sides"});
  visit(ByHand{}, {.name = "mass",
                   .unit = "kg",
                   .range = Range::positive(),
                   .rule = "from the shape",
                   .meaning = "of a whole sphere, also where symmetry planes cut it; gives the radius"});
  visit(body.shape.removed, {.name = "subtract",
                             .values = "list of [shapes](#shapes) and names",
                             .meaning = "what is taken out: shapes, or the shapes of other bodies and of solids by name"});
  visit(ByHand{}, {.name = "material",
                   .needed = true,
                   .remedy = "e.g. material = \"water-tait\" ('undex materials' lists them)",
                   .values = "name or table",
                   .meaning = "see [materials](#materials); `undex materials` lists the names"});
  visit(body.spacing, {.name = "spacing",
                       .unit = "m",
                       .range = Range::length(),
                       .rule = "that of `resolution`",
                       .meaning = "a lattice of its own"});
  visit(body.velocity, {.name = "velocity", .unit = "m/s", .meaning = "at the start"});
  visit(body.radial_velocity, {.name = "radial_velocity",
                               .unit = "m/s",
                               .meaning = "at the start, away from the middle of the shape; added to `velocity`"});
  visit(body.spin, {.name = "spin",
                    .unit = "rad/s",
                    .form = Form::turn,
                    .meaning = "at the start, about the middle of the shape; added to `velocity`"});
  visit(ByHand{}, {.name = "radial",
                   .rule = "none",
                   .values = "a [table](#radial-motion)",
                   .meaning = "at the start, towards or away from a point or an axis; added to `velocity`"});
  visit(body.pressure, {.name = "pressure",
                        .unit = "Pa",
                        .values = "attainable",
                        .meaning = "at the start; gives the density, or with `density` the energy"});
  visit(body.level, {.name = "level",
                     .unit = "m",
                     .range = Range::position(),
                     .rule = "none: uniform",
                     .form = Form::height,
                     .meaning = "with `gravity`: where the body has `pressure`; elsewhere the start is hydrostatic"});
  visit(body.density, {.name = "density",
                       .unit = "kg/m^3",
                       .range = Range::positive(),
                       .rule = "`rho0` of the material, or from `pressure`",
                       .meaning = "at the start"});
  visit(body.energy, {.name = "energy",
                      .unit = "J/kg",
                      .rule = "from `pressure` and `density`, else the material's own (`E0` of a charge, else 0)",
                      .meaning = "internal energy at the start; not for barotropic laws"});
  visit(ByHand{}, {.name = "burn",
                   .rule = "programmed, from the middle of the shape",
                   .values = "table, \"programmed\" or \"instantaneous\"",
                   .meaning = "how a charge (law \"jwl\") burns"});
  visit(body.variable_h, {.name = "variable_h",
                          .rule = "true for gases and charges, else false",
                          .meaning = "the smoothing length follows the density"});
  visit(body.split,
        {.name = "split",
         .range = Range::between(1, 10000),
         .used = body.variable_h,
         .meaning = "where it does: particles that have grown past twice their width on the lattice split in two, one that was "
                    "laid into this many at most; 1: never"});
}

/// Specific internal energy [J/kg] of a uniform body at the start.
inline double start_energy(const Body& body) {
  if (body.energy) return *body.energy;
  const auto* products = std::get_if<materials::Jwl>(&body.material.law);
  return products ? products->parameters().E0 : 0.0;
}

/// Its density [kg/m^3]. Throws std::domain_error where the law has none at the body's pressure.
inline double start_density(const Body& body) {
  if (body.density) return *body.density;
  if (body.pressure) return materials::density_at(body.material.law, *body.pressure, start_energy(body));
  return body.material.rho0;
}

/// Pressure of a body with a level over the depth x . g/|g| below it, x from the level. Throws std::domain_error where the law
/// has no density at a pressure of the column.
inline materials::HydrostaticColumn hydrostatic_column(const Body& body, const Vec3& gravity, int dimension) {
  const Vec3 down = gravity.norm() > 0.0 ? Vec3(gravity.normalized()) : Vec3::Zero();
  const Bounds box = bounds(body.shape, dimension);
  double low = 0, high = 0;
  for (int a = 0; a < dimension; ++a) {
    const double one = down[a] * (box.low[a] - (*body.level)[a]), other = down[a] * (box.high[a] - (*body.level)[a]);
    low += std::min(one, other);
    high += std::max(one, other);
  }
  return {body.material.law, start_energy(body), body.pressure.value(), gravity.norm(), low, high};
}

/// A rigid container: fluid stays inside `container`; faces that are not open carry dummy particles.
struct Wall {
  std::string name;
  Primitive container;  ///< Box, Cylinder, Cone or Sphere (the fluid's side is inside)
  std::map<std::string, FaceCondition>
      faces;                     ///< box: "x_low" .. "z_high"; cylinder, cone: "side", "low", "high"; sphere: "side"
  std::optional<Vec3> source{};  ///< of the spherical waves that leave through radiating faces [m]; none: plane waves

  bool radiates() const {
    return std::any_of(faces.begin(), faces.end(), [](const auto& face) { return face.second == FaceCondition::radiating; });
  }
};
template <class Visit>
void describe(Wall& wall, Visit&& visit) {
  visit(wall.name, {.name = "name", .needed = true, .remedy = "every wall has a name", .form = Form::name});
  visit(ByHand{}, {.name = "shape",
                   .needed = true,
                   .remedy = "a box, cylinder, cone or sphere round the fluid",
                   .values = "a [shape](#shapes)",
                   .meaning = "the inside; box, cylinder, cone or sphere along the axes have faces by name"});
  visit(ByHand{}, {.name = "condition",
                   .rule = "\"free_slip\"",
                   .values = "\"free_slip\", \"no_slip\", \"open\", \"radiating\"",
                   .meaning = "of all faces not named in `faces`; \"open\": no wall; \"radiating\": waves leave "
                              "([how](../theory/equations.md#radiating-faces))"});
  visit(wall.source, {.name = "source",
                      .unit = "m",
                      .range = Range::position(),
                      .rule = "the middle of the only round charge or bubble of gas in the scene; else none",
                      .used = wall.radiates(),
                      .meaning = "of a wall with radiating faces: where the waves come from; none: plane waves"});
  visit(ByHand{}, {.name = "faces", .rule = "{}", .values = "table of face = condition", .meaning = "the faces below"});
}

/// Symmetry planes through the origin; the part with x[axis] >= 0 is computed.
struct Symmetry {
  std::array<bool, 3> axis{false, false, false};
};
template <class Visit>
void describe(Symmetry& symmetry, Visit&& visit) {
  visit(symmetry.axis,
        {.name = "planes", .meaning = "mirror planes through the origin across these axes; x >= 0 (y, z) is computed"});
}

/// Kernel, pair scheme and steps.
struct Numerics {
  KernelName kernel = KernelName::wendland_c2;
  SchemeName scheme = SchemeName::riemann;
  Precision precision = Precision::full;
  double eta = WendlandC2::usual_eta;  ///< h/dx
  double alpha = 1.0;                  ///< Monaghan's linear coefficient (eq. 6); with a switch, its upper bound
  double beta = 10.0;                  ///< and the quadratic one; with a switch, where alpha is at its bound
  double alpha_min = 0.1;              ///< with a switch: alpha's lower bound
  Integrator integrator = Integrator::leapfrog;
  double courant = 0.35;             ///< dt = courant * min over particles of h/(signal speed)
  std::optional<double> fixed_step;  ///< [s]
  bool local_steps = false;          ///< may bodies with a much shorter step take substeps (leapfrog without fixed_step only)?
  double h_low = 0.9, h_high = 3.0;  ///< bounds of h/h0 where it follows density
  /// Particles at rest are worked on from when a signal of this share of the sound speed (or of the density) comes within
  /// reach; 0: always.
  double signal = 1e-12;
  int threads = 0;  ///< 0: all the machine has
};

/// Defaults of parameters that depend on others; given(key): does the scene name it? In three dimensions no figure of any scene
/// moves by more than 2e-6 in mixed precision (docs/results/performance.md); in one and two there is little to save.
void apply_defaults(Numerics& numerics, int dimension, auto&& given) {
  if (!given("kernel")) numerics.kernel = default_kernel(numerics.scheme);
  if (!given("precision")) numerics.precision = dimension == 3 ? Precision::mixed : Precision::full;
  if (!given("eta")) numerics.eta = default_eta(numerics.scheme, numerics.kernel);
  if (!given("beta") && numerics.scheme == SchemeName::monaghan_switch) numerics.beta = 2.0;
  if (!given("courant")) numerics.courant = default_courant(numerics.integrator, numerics.kernel);
}

template <class Visit>
void describe(Numerics& numerics, Visit&& visit) {
  visit(numerics.scheme, {.name = "name",
                          .meaning = "how a pair of particles dissipates: a Riemann flux or artificial viscosity "
                                     "([schemes](../theory/equations.md#3-pair-schemes))"});
  visit(numerics.kernel, {.name = "kernel",
                          .rule = "\"wendland_c2\"; riemann_corrected \"wendland_c4\", paper \"gaussian\"",
                          .meaning = "smoothing kernel; radius 2h, of the quintic spline and the Gaussian 3h"});
  visit(numerics.precision,
        {.name = "precision",
         .rule = "\"mixed\" in three dimensions, else \"full\"",
         .meaning = "of the loop over pairs: double, or single with a double state "
                    "([error](../results/performance.md#mixed-precision)); \"mixed\" for spacings from 2e-5 m on"});
  visit(numerics.eta, {.name = "eta",
                       .range = Range::between(0.8, 3),
                       .rule = "1.5; wendland_c4 1.75, with riemann_corrected 1.3; wendland_c6 2, cubic_spline 1.325, "
                               "quintic_spline 1.1, gaussian 1.2",
                       .meaning = "smoothing length h/dx"});
  visit(numerics.alpha, {.name = "alpha",
                         .range = Range::between(0, 100),
                         .meaning = "artificial viscosity: its linear coefficient; \"monaghan_switch\": the upper bound"});
  visit(numerics.beta, {.name = "beta",
                        .range = Range::between(0, 1000),
                        .rule = "10; monaghan_switch 2",
                        .meaning = "its quadratic coefficient; \"monaghan_switch\": the one that belongs to `alpha`"});
  visit(numerics.alpha_min,
        {.name = "alpha_min", .range = Range::between(0, 100), .meaning = "\"monaghan_switch\": the lower bound, up to `alpha`"});
  visit(numerics.integrator, {.name = "integrator",
                              .meaning = "second order with one evaluation a step, or third order with three "
                                         "([comparison](../results/performance.md#runge-kutta-instead-of-the-leapfrog))"});
  visit(numerics.courant, {.name = "courant",
                           .range = Range::above(0, 2),
                           .rule = "0.35; wendland_c6 0.27; ssp_rk3 twice that",
                           .meaning = "Courant number of the step: share of h over the signal speed"});
  visit(numerics.fixed_step, {.name = "fixed_step",
                              .unit = "s",
                              .range = Range::above(0, 1),
                              .meaning = "a fixed step in place of the Courant-limited one"});
  visit(numerics.local_steps, {.name = "local_steps",
                               .used = numerics.integrator == Integrator::leapfrog,
                               .meaning = "bodies with a short stable step take substeps where that saves work "
                                          "([gain](../results/performance.md#local-steps)); \"leapfrog\" without `fixed_step`"});
  visit(
      numerics.signal,
      {.name = "signal",
       .range = Range::between(0, 0.1),
       .meaning = "particles at rest are left out until a signal of this share of the sound speed comes within reach; 0: never"});
  visit(numerics.h_low,
        {.name = "h_low", .range = Range::between(0.1, 1), .meaning = "where h follows density: least h over its start"});
  visit(numerics.h_high, {.name = "h_high", .range = Range::between(1, 20), .meaning = "and the largest"});
}

/// What lies outside of everything.
struct Surroundings {
  /// On the fluid's free surfaces, and on the dry faces of structures and solids [Pa].
  double pressure = 0;
};
template <class Visit>
void describe(Surroundings& surroundings, Visit&& visit) {
  visit(surroundings.pressure,
        {.name = "pressure",
         .unit = "Pa",
         .range = Range::between(0, 1e9),
         .meaning = "on free surfaces of the fluid and on dry faces of structures and solids; the atmosphere's is 101325"});
}

struct Settings {
  int dimension = 3;
  /// Two dimensions as the meridian of bodies of revolution: x is the distance r from the axis, y runs along it, and the plane
  /// x = 0 is one of symmetry. Masses, energies, forces and impulses are those of the whole ring.
  bool axisymmetric = false;
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]; its image across a symmetry plane is mirrored
  Surroundings surroundings;
  Lattice lattice;
  std::vector<Body> bodies;
  std::vector<Wall> walls;
  Symmetry symmetry;
  Numerics numerics;
  double start_time = 0;   ///< [s]
  double heat_before = 0;  ///< dissipated before the start, in barotropic bodies of the kept part [J]
};

}  // namespace undex::sph
