// State of solid particles, in the order of the start for ever, and the pass that takes it over a step.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/state.hpp"
#include "core/vector.hpp"
#include "materials/stress_update.hpp"

namespace undex::solid {

struct SolidParticles {
  std::vector<Vec3> start;                      ///< place at the start [m]
  std::vector<Vec3> x, v;                       ///< [m], [m/s]
  std::vector<double> mass;                     ///< [kg]
  std::vector<double> rho;                      ///< [kg/m^3]
  std::array<std::vector<double>, 6> deviator;  ///< of the Cauchy stress: xx, yy, zz, yz, zx, xy [Pa]
  std::vector<double> pressure;                 ///< [Pa]
  std::vector<double> viscous_pressure;         ///< bulk viscosity [Pa]
  std::vector<double> plastic_strain, temperature, damage;
  std::vector<double> energy;                          ///< specific internal energy [J/kg]
  std::vector<double> plastic_energy, viscous_energy;  ///< the parts of it that are gone [J/kg]
  std::vector<double> contact_pressure;                ///< with other bodies (solid_schemes.hpp) [Pa]
  std::vector<double> contact_reference;               ///< least overlap with other bodies so far [-]
  std::vector<double> sound;                           ///< longitudinal wave speed [m/s]
  std::vector<std::uint32_t> touching;                 ///< which rigid planes, a bit each (plane_contact.hpp)

  // What the last evaluation gave.
  std::vector<Vec3> force;   ///< [N]
  std::vector<double> heat;  ///< by pairs [W/kg]
  std::vector<double> rate;  ///< what limits the step: see Solids::stable_step [1/s]

  std::size_t size() const { return x.size(); }
  void resize(std::size_t n);
  std::size_t memory_bytes() const;
  void visit_state(StateVisitor& state);
  Mat3 stress(std::size_t i) const;  ///< Cauchy, without viscosity [Pa]
};

/// What eight particles went through in a step.
struct Deformation {
  std::uint32_t index[materials::points_at_once];
  int count = 0;                          ///< how many of the eight are particles
  materials::EightPoints gradient[3][3];  ///< of the displacement, at the middle of the step
  materials::EightPoints density;         ///< at its end [kg/m^3]

  /// Appends a particle whose deformation gradient (with respect to any configuration) goes from `before` to `after`.
  void append(std::uint32_t particle, const Mat3& before, const Mat3& after, double density_after);
};

/// Bulk viscosity's two coefficients and the length that it smears a shock over [m].
struct BulkViscosity {
  double linear = 0, quadratic = 0, length = 0;
};

/// Stress, energy and temperature of the eight after a step dt [s]: materials::advance_deviator, the pressure law and the
/// heat of the pairs.
void update_stress(const materials::Solid& solid, const BulkViscosity& viscosity, Deformation& step, double dt,
                   SolidParticles& particles);

}  // namespace undex::solid
