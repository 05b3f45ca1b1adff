// Solids as SPH particles: elastic-plastic bodies, each in a total or an updated Lagrangian description, their contact with
// each other and with rigid planes, advanced in time by central differences. Chen et al. 2019, eqs 7-23, in variational
// form: forces are the exact derivative of the power of the stresses, with corrected kernel gradients (Bonet and Lok 1999,
// doi 10.1016/S0045-7825(99)00051-1), so that a rigid motion makes no stress and momentum and angular momentum stay.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/timers.hpp"
#include "core/vector.hpp"
#include "sph_fluid/water/fluid.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::sph {

/// Energy [J], momentum and mass of the computed part, booked since the start.
struct SolidLedger {
  double kinetic = 0;
  double elastic = 0;            ///< stored, hourglass energy included
  double plastic = 0;            ///< plastic work
  double viscous = 0;            ///< by viscosity, and what contact between bodies has taken
  double external = 0;           ///< work of impulses received, and of rigid planes (never positive)
  double gravity = 0;            ///< work of gravity
  double integrator = 0;         ///< what central differences hold back: dt^2/8 m a.a, known exactly (fem::Energies::integrator)
  double mass = 0;               ///< [kg]
  Vec3 momentum = Vec3::Zero();  ///< [kg m/s]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the origin [kg m^2/s]

  /// Stays at its first value, but for what finite strain within a step leaves.
  double balance() const { return kinetic + integrator + elastic + plastic + viscous - external - gravity; }
};

class Solids {
 public:
  /// Lays out the particles of settings.solids. Throws std::invalid_argument naming the body and the remedy.
  explicit Solids(const Settings& settings);
  ~Solids();
  Solids(Solids&&) noexcept;
  Solids& operator=(Solids&&) noexcept;

  const Settings& settings() const;
  std::size_t particle_count() const;
  std::vector<std::size_t> particles_by_body() const;  ///< in the scene's order, as the particles themselves are
  std::size_t memory_bytes() const;
  double time() const;
  long steps() const;
  const PassTimers& timers() const;

  /// Largest stable step [s] times courant, and the particle that sets it, in words.
  double stable_step() const;
  std::string stable_step_owner() const;

  /// Advances to t_end in equal steps, none longer than stable_step(), while the particles receive exactly `impulse` [N s]
  /// each (may be empty), spread evenly. Throws NumericalStop naming step, time, body, particle and position; positions and
  /// velocities are then finite still, those of the middle of the failed step.
  void advance(double t_end, std::span<const Vec3> impulse = {});
  /// Changes velocities by impulse/mass, at once.
  void kick(std::span<const Vec3> impulse);

  SolidLedger ledger() const;
  std::span<const Vec3> positions() const;           ///< [m]
  std::span<const Vec3> velocities() const;          ///< [m/s], at time()
  std::span<const Vec3> accelerations() const;       ///< [m/s^2]
  double particle_mass(std::size_t particle) const;  ///< [kg]
  Mat3 stress(std::size_t particle) const;           ///< Cauchy [Pa]
  double maximum_pressure() const;                   ///< [Pa]

  /// Copies a field for output: position, displacement, velocity (3 components, interleaved); pressure, density, von_mises,
  /// plastic_strain, temperature, energy, damage, material, sound_speed, mass, id (1). Throws std::invalid_argument for
  /// other names.
  std::vector<double> field(std::string_view name) const;

  /// A material point of a body, given by its place at the start [m]: linear moving least squares over the particles near
  /// it, exact for linear fields, also a little outside (a surface lies half a spacing beyond the last particles).
  struct Point {
    std::vector<std::uint32_t> particles;
    std::vector<double> weights;        ///< their sum is 1
    std::vector<unsigned char> images;  ///< mirrored across which planes (bit a: axis a)
    double distance = 0;                ///< from the nearest particle [m]
  };
  Point locate(const Vec3& reference_position) const;
  struct PointValues {
    Vec3 position, displacement, velocity, acceleration;
    Mat3 stress;  ///< Cauchy [Pa]
    double plastic_strain, temperature;
  };
  PointValues read(const Point& point) const;
  /// Adds the impulse of a point to the particles that it is made of, by the same weights.
  void distribute(const Point& point, const Vec3& impulse, std::vector<Vec3>& particle_impulse) const;

  /// The particles that water may meet: indices, and a moving wall made of them (`ahead` [s] from now at the present
  /// acceleration).
  const std::vector<std::uint32_t>& wet_particles() const;
  MovingWall wet_wall(bool free_slip) const;
  void move_wall(MovingWall& wall, double ahead) const;

  struct Implementation;  ///< for the passes' own files

 private:
  std::unique_ptr<Implementation> self_;
};

}  // namespace undex::sph
