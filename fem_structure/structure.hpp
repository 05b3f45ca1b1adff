// Explicit dynamics of a structure in hexahedra: large displacement, large strain, lumped mass, central differences.
// deal.II builds the mesh and the shape functions; it stays private to this module.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/surface.hpp"
#include "fem_structure/settings.hpp"

namespace undex::fem {

/// Energy of the structure [J], booked since the start (of the meshed part, e.g. an octant).
struct Energies {
  double kinetic = 0, elastic = 0, plastic = 0;
  double viscous = 0;   ///< bulk viscosity's dissipation
  double external = 0;  ///< work of impulses and pressure loads received
  double gravity = 0;   ///< work of gravity
  double impact = 0;    ///< kinetic energy of nodes lost as they hit rigid planes (vanishes with their mass)
  double reaction = 0;  ///< work of supports: zero for fixed ones, kept as a check
  /// What the time integrator has held back or made, a term of second order in the step that is known exactly: central
  /// differences conserve energy with the product of the two half-step velocities in place of the square of the mean,
  /// and lose or gain as much whenever the step or a force jumps. Zero at the start.
  double integrator = 0;

  /// Stays at its first value (the initial kinetic energy), but for what finite strain within a step leaves.
  double balance() const { return kinetic + integrator + elastic + plastic + viscous + impact - external - gravity - reaction; }
};

/// Fields at the cells' centres (averages over the quadrature points) and at the nodes, for output and probes.
struct FieldView {
  std::vector<Vec3> position, displacement, velocity;                    ///< per node
  std::vector<std::array<int, 8>> cells;                                 ///< VTK hexahedron order
  std::vector<double> pressure, von_mises, plastic_strain, temperature;  ///< per cell
};

class Structure {
 public:
  /// Builds the mesh. Throws std::invalid_argument (user's mistake: unknown face name, impossible radii, inverted or
  /// non-hexahedral mesh, unreadable gmsh file) with a message that names the value and the remedy.
  explicit Structure(const Settings& settings);
  ~Structure();
  Structure(Structure&&) noexcept;
  Structure& operator=(Structure&&) noexcept;

  std::size_t cell_count() const;
  std::size_t node_count() const;
  std::size_t memory_bytes() const;
  double total_mass() const;  ///< [kg]
  double time() const;        ///< [s]
  long steps() const;

  const WetSurface& wet_surface() const;
  /// Positions [m], velocities [m/s] and accelerations [m/s^2] of the wet surface's nodes, in its order, all at time():
  /// the velocity is the half-step one carried to the end of the step, v(t) = v(t - dt/2) + dt/2 a(t), and a(t) still
  /// holds the impulse of the last advance() as a steady force.
  std::span<const Vec3> wet_positions() const;
  std::span<const Vec3> wet_velocities() const;
  std::span<const Vec3> wet_accelerations() const;
  /// Mass [kg] of each wet node and of what is behind it (a sheet's whole thickness, half of it where both sides are wet):
  /// every node's lumped mass counts for the wet nodes nearest to it along the cells' edges, in equal shares.
  std::span<const double> wet_masses() const;

  /// Largest stable step [s] of central differences for the present mesh and state, times settings.courant.
  double stable_step() const;

  /// The cell that sets stable_step(), in words for a log line.
  std::string stable_step_owner() const;

  /// Advances to time t_end in equal steps (more, and shorter, where the mesh tightens on the way), none longer than
  /// stable_step(), while the wet nodes receive exactly `impulse` [N s] each (in wet_surface() order; may be empty), spread
  /// evenly over the interval. Throws NumericalStop (core/errors.hpp) naming step, time, cell and position when an element
  /// inverts or a value is not finite; nodes then stand where the failed step began.
  void advance(double t_end, std::span<const Vec3> impulse);

  Energies energies() const;
  Vec3 momentum() const;          ///< [kg m/s]
  Vec3 angular_momentum() const;  ///< about the origin [kg m^2/s]
  Vec3 plane_impulse() const;     ///< received from the rigid planes since the start [N s]
  FieldView fields() const;

  /// A material point on the mesh, found once by its reference position [m] (nearest point of the mesh; `distance` tells
  /// how far), then read at any time.
  struct Probe {
    std::size_t cell;
    std::array<double, 3> unit;  ///< reference-cell coordinates in [0,1]^3
    double distance;             ///< [m]
  };
  Probe locate(const Vec3& reference_position) const;
  struct ProbeValues {
    Vec3 position, displacement, velocity;
    Mat3 stress;  ///< Cauchy [Pa], tension positive
    double plastic_strain, temperature;
  };
  ProbeValues read(const Probe& probe) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace undex::fem
