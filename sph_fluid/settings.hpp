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

#include "core/shapes.hpp"
#include "materials/burn.hpp"
#include "materials/hydrostatic.hpp"
#include "materials/library.hpp"
#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/schemes/table.hpp"

namespace undex::sph {

/// How the fluid advances in time (docs/equations.md, section 7).
enum class Integrator {
  leapfrog,  ///< kick-drift-kick, its one evaluation a step at a predicted state
  ssp_rk3,   ///< Runge-Kutta, strong-stability-preserving, third order: three evaluations a step
};

/// Courant number of a scene that names none. C6 is slim within its support: for its width, 0.35 is the step that 0.45 is for C2,
/// where waves grow (docs/performance.md).
inline double default_courant(Integrator integrator, KernelName kernel) {
  const double leapfrog = kernel == KernelName::wendland_c6 ? 0.27 : 0.35;
  return integrator == Integrator::ssp_rk3 ? 2.0 * leapfrog : leapfrog;
}

/// What a wall does to the flow along it.
enum class FaceCondition { no_slip, free_slip, open };

/// How particles are laid out at the start.
enum class LatticeType {
  cartesian,  ///< spacing dx along each axis, particles at the cells' centres
  rings,      ///< concentric rings about an axis, fitted to a radius: quietest beside a cylindrical wall
};

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
};

/// State of one particle at the start.
struct StartState {
  double density = 0;            ///< [kg/m^3]
  double energy = 0;             ///< specific internal energy [J/kg]; ignored where the law is barotropic
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
};

/// A start that is not uniform: a wave, or a computation before this one.
struct StartField {
  /// State of the particle at x [m] that stands for a cell of width `spacing` [m].
  std::function<StartState(const Vec3& x, double spacing)> state;
  /// Of the kept part [kg]; the particles' masses are scaled to it. Zero: nothing is scaled, the states are exact means.
  double mass = 0;
  /// Of the kept part [J]. What of it the particles have not (motion within a spacing) is heat: part of their internal energy,
  /// or dissipated where the law has none.
  double kinetic_energy = 0;
  double internal_energy = 0;  ///< of the kept part [J]; energies are scaled to it where the law has them
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
  std::shared_ptr<const StartField> start;  ///< null: uniform, as above
  double radial_velocity = 0;               ///< away from the middle of the shape's base, added to `velocity` [m/s]
  std::optional<Vec3> level{};              ///< a point where `pressure` is found; elsewhere it is hydrostatic [m]
};

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
  Primitive container;                         ///< Box or Cylinder (the fluid's side is inside)
  std::map<std::string, FaceCondition> faces;  ///< box: "x_low" .. "z_high"; cylinder: "side", "low", "high"
};

/// Symmetry planes through the origin; the part with x[axis] >= 0 is computed.
struct Symmetry {
  std::array<bool, 3> axis{false, false, false};
};

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

struct Settings {
  int dimension = 3;
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]; its image across a symmetry plane is mirrored
  Lattice lattice;
  std::vector<Body> bodies;
  std::vector<Wall> walls;
  Symmetry symmetry;
  Numerics numerics;
  double start_time = 0;   ///< [s]
  double heat_before = 0;  ///< dissipated before the start, in barotropic bodies of the kept part [J]
};

}  // namespace undex::sph
