// Solids as SPH particles: elastic-plastic bodies, each in a total or an updated Lagrangian description, their contact with
// each other and with rigid planes, advanced in time by central differences. Chen et al. 2019, eqs 7-23, in variational
// form: forces are the exact derivative of the power of the stresses, with corrected kernel gradients (Bonet and Lok 1999,
// doi 10.1016/S0045-7825(99)00051-1), so that a rigid motion makes no stress and momentum and angular momentum stay.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/deformable_body.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_solid/settings.hpp"

namespace undex::solid {

/// Which places are meant.
using Places = std::function<bool(const Vec3&)>;

class Solids : public DeformableBody {
 public:
  /// Lays out the bodies' particles. `around` says what they share with the water, or with each other: dimension, gravity,
  /// lattice, symmetry planes, threads and start. Throws std::invalid_argument naming the body and the remedy.
  Solids(const Settings& settings, const sph::Settings& around);
  ~Solids() override;
  Solids(Solids&&) noexcept;
  Solids& operator=(Solids&&) noexcept;

  std::size_t particle_count() const;
  std::vector<std::size_t> particles_by_body() const;  ///< in the scene's order, as the particles themselves are

  double time() const override;
  long steps() const override;
  double stable_step() const override;
  std::string stable_step_owner() const override;
  /// Equal steps. After a NumericalStop positions and velocities are those of the middle of the failed step.
  void advance(double t_end, std::span<const Vec3> impulse = {}) override;
  /// Gives the particles impulses [N s] at once.
  void kick(std::span<const Vec3> impulse);
  /// Gives them to the nodes of wet_surface().
  void kick_surface(std::span<const Vec3> impulse);

  /// Meshes the bodies' wet faces, a spacing wide, to be coupled by them: without those that symmetry planes, other bodies or
  /// `dry` places (all corners are) take up. A node is a material point: its motion is exact for linear fields, and what it
  /// receives goes to the particles by the same weights. Its mass is its share, by the weights' magnitudes, of the particles that
  /// it is made of: the layer within a kernel's reach. Throws std::invalid_argument naming the body where that cannot be.
  void mesh_wet_faces(const Places& dry = [](const Vec3&) { return false; });
  const WetSurface& wet_surface() const override;
  std::span<const Vec3> wet_positions() const override;
  std::span<const Vec3> wet_velocities() const override;
  std::span<const Vec3> wet_accelerations() const override;
  std::span<const double> wet_masses() const override;
  /// Mass [kg] that each node has at once, before waves pass on what it gets: its area over its velocity per impulse and area, at
  /// the start under a uniform pressure.
  std::span<const double> wet_skin_masses() const;

  /// Linear moving least squares over the particles near the place, exact for linear fields, also a little outside (a surface
  /// lies half a spacing beyond the last particles).
  BodyPoint locate(const Vec3& reference_position) const override;
  MaterialPoint read(const BodyPoint& point) const override;
  /// On the wet faces where they are meshed, else on the surface of the nearest body.
  std::function<Vec3()> follow_surface(const Vec3& reference_position, double reach) const override;

  void visit_state(StateVisitor& state) override;

  BodyLedger ledger() const override;
  std::span<const Vec3> positions() const override;
  std::span<const double> masses() const override;
  std::span<const Vec3> velocities() const;     ///< [m/s], at time()
  std::span<const Vec3> accelerations() const;  ///< [m/s^2]
  Mat3 stress(std::size_t particle) const;      ///< Cauchy [Pa]
  double maximum_pressure() const override;
  /// Pressure, speed, plastic strain, damage (of materials that can fail) and temperature of each body.
  std::vector<LargestOf> largest() const override;
  BodySnapshot snapshot(std::span<const std::string> fields) const override;
  /// Copies a field for output: position, displacement, velocity (3 components, interleaved); pressure, density, von_mises,
  /// plastic_strain, temperature, energy, damage, material, sound_speed, mass, id (1). Throws std::invalid_argument for
  /// other names.
  std::vector<double> field(std::string_view name) const;

  BodySize size() const override;
  std::string description() const override;
  std::size_t memory_bytes() const override;
  const PassTimers& timers() const override;

  struct Implementation;  ///< for the passes' own files

 private:
  std::unique_ptr<Implementation> self_;
};

}  // namespace undex::solid
