// What a scene says about solids in particles: bodies, their scheme, rigid planes. SI units. Dimension, gravity, symmetry planes,
// lattice, threads and start are those of all particles (sph::Settings).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/rigid_plane.hpp"
#include "core/shapes.hpp"
#include "materials/solid.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::solid {

/// What the particles of a solid body call their neighbours.
enum class Description {
  total_lagrangian,    ///< those of the start, for ever: no tensile instability, and no fragments
  updated_lagrangian,  ///< those of the moment: any deformation, and fracture
};

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
  /// Stress in equilibrium at the start, of discs and cylinders: with R the radius, S (1 - r^2/R^2) radial and
  /// S (1 - 3 r^2/R^2) along the circumference (quenching leaves such a stress) [Pa].
  double residual_stress = 0;
  /// Faces that water touches ("inner", "outer", "low", "high", "side", "x_low" ...); what lies deeper behind them than the
  /// water's kernel reaches is not shown to it. Empty: every face.
  std::vector<std::string> wet;
};

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

struct Settings {
  std::vector<Body> bodies;
  Numerics numerics;
  std::vector<RigidPlane> planes;
};

}  // namespace undex::solid
