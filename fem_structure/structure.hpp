// Explicit dynamics of a structure in hexahedra: large displacement, large strain, lumped mass, central differences.
// deal.II builds the mesh and the shape functions; it stays private to this module.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/deformable_body.hpp"
#include "fem_structure/settings.hpp"

namespace undex::fem {

/// Loads the library that builds meshes, which the first structure would do: for those who time what comes then. Throws FileError
/// where it is not to be found.
void load_meshes();

class Structure : public DeformableBody {
 public:
  /// Builds the mesh. Throws std::invalid_argument (user's mistake: unknown face name, impossible radii, inverted or
  /// non-hexahedral mesh, unreadable gmsh file) with a message that names the value and the remedy.
  explicit Structure(const Settings& settings);
  ~Structure() override;
  Structure(Structure&&) noexcept;
  Structure& operator=(Structure&&) noexcept;

  std::size_t cell_count() const;
  std::size_t node_count() const;

  double time() const override;
  long steps() const override;
  /// Of central differences for the present mesh and state, times settings.courant.
  double stable_step() const override;
  std::string stable_step_owner() const override;
  /// Equal steps (more, and shorter, where the mesh tightens on the way). After a NumericalStop (an element inverts or a value is
  /// not finite) nodes stand where the failed step began.
  void advance(double t_end, std::span<const Vec3> impulse = {}) override;

  const WetSurface& wet_surface() const override;
  std::vector<NamedFaces> wet_faces() const override;
  /// The velocity is the half-step one carried to the end of the step, v(t) = v(t - dt/2) + dt/2 a(t), and a(t) holds the impulse
  /// of the last advance() as a steady force.
  std::span<const Vec3> wet_positions() const override;
  std::span<const Vec3> wet_velocities() const override;
  std::span<const Vec3> wet_accelerations() const override;
  /// Of each wet node and of what is behind it (a sheet's whole thickness, half of it where both sides are wet): every node's
  /// lumped mass counts for the wet nodes nearest to it along the cells' edges, in equal shares.
  std::span<const double> wet_masses() const override;

  BodyPoint locate(const Vec3& reference_position) const override;
  MaterialPoint read(const BodyPoint& point) const override;

  void visit_state(StateVisitor& state) override;

  BodyLedger ledger() const override;
  Vec3 plane_impulse() const;  ///< received from the rigid planes since the start [N s]
  std::span<const Vec3> positions() const override;
  std::span<const double> masses() const override;
  /// Speed of nodes; plastic strain, temperature and damage (of materials that can fail) of points, at the middles of their
  /// cells.
  std::vector<LargestOf> largest() const override;
  /// displacement and velocity of nodes; pressure, von_mises, plastic_strain and temperature of cells, means over their points.
  BodySnapshot snapshot(std::span<const std::string> fields = {}) const override;

  BodySize size() const override;
  std::string description() const override;
  std::size_t memory_bytes() const override;
  const PassTimers& timers() const override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace undex::fem
