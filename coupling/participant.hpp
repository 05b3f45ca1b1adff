// What the coupling asks of a structure, whatever it is made of.
#pragma once

#include <span>
#include <vector>

#include "core/surface.hpp"
#include "fem_structure/structure.hpp"
#include "sph_solid/solids.hpp"

namespace undex::coupling {

class Participant {
 public:
  virtual ~Participant() = default;
  virtual const WetSurface& wet_surface() const = 0;
  /// Of the wet surface's nodes, in its order, at time(): [m], [m/s], [m/s^2].
  virtual std::span<const Vec3> wet_positions() const = 0;
  virtual std::span<const Vec3> wet_velocities() const = 0;
  virtual std::span<const Vec3> wet_accelerations() const = 0;
  /// Mass [kg] that the water must move to move each of them, at the start.
  virtual std::span<const double> wet_masses() const = 0;
  virtual double time() const = 0;  ///< [s]
  virtual long steps() const = 0;
  virtual double stable_step() const = 0;  ///< [s]
  /// Advances to t_end [s] while the wet nodes receive exactly `impulse` [N s] each.
  virtual void advance(double t_end, std::span<const Vec3> impulse) = 0;
  virtual double external_work() const = 0;  ///< by the impulses received [J]
};

/// Finite elements.
class ElementParticipant : public Participant {
 public:
  explicit ElementParticipant(fem::Structure& structure) : structure_(structure) {}
  const WetSurface& wet_surface() const override { return structure_.wet_surface(); }
  std::span<const Vec3> wet_positions() const override { return structure_.wet_positions(); }
  std::span<const Vec3> wet_velocities() const override { return structure_.wet_velocities(); }
  std::span<const Vec3> wet_accelerations() const override { return structure_.wet_accelerations(); }
  std::span<const double> wet_masses() const override { return structure_.wet_masses(); }
  double time() const override { return structure_.time(); }
  long steps() const override { return structure_.steps(); }
  double stable_step() const override { return structure_.stable_step(); }
  void advance(double t_end, std::span<const Vec3> impulse) override { structure_.advance(t_end, impulse); }
  double external_work() const override { return structure_.energies().external; }

 private:
  fem::Structure& structure_;
};

/// Solids in particles. Their wet faces are meshed a spacing wide; a node of that mesh is a point of the body
/// (sph::Solids::Point): its motion is exact for linear fields, and what it receives goes back by the same weights. Its mass
/// is its share, by the weights' magnitudes, of the particles that it is made of: the layer within a kernel's reach.
class ParticleParticipant : public Participant {
 public:
  /// Throws std::invalid_argument where a wet face is none that can be meshed (flat or round).
  explicit ParticleParticipant(sph::Solids& solids);
  const WetSurface& wet_surface() const override { return surface_; }
  std::span<const Vec3> wet_positions() const override { return position_; }
  std::span<const Vec3> wet_velocities() const override { return velocity_; }
  std::span<const Vec3> wet_accelerations() const override { return acceleration_; }
  std::span<const double> wet_masses() const override { return mass_; }
  double time() const override { return solids_.time(); }
  long steps() const override { return solids_.steps(); }
  double stable_step() const override { return solids_.stable_step(); }
  void advance(double t_end, std::span<const Vec3> impulse) override;
  double external_work() const override { return solids_.ledger().external; }

 private:
  void share_mass();
  void read_motion();

  sph::Solids& solids_;
  WetSurface surface_;
  std::vector<sph::Solids::Point> points_;
  std::vector<Vec3> position_, velocity_, acceleration_, particle_impulse_;
  std::vector<double> mass_;
};

}  // namespace undex::coupling
