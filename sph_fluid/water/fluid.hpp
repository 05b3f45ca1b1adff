// The fluid: water, charge and bubble as SPH particles between walls and symmetry planes, advanced in time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/largest.hpp"
#include "core/point_values.hpp"
#include "core/state.hpp"
#include "core/timers.hpp"
#include "core/vector.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_fluid/walls/moving_walls.hpp"

namespace undex::sph {

/// Is told while a start settles how many particles are moved, and how uneven their pressure is, as a share of it (settle.hpp).
using SettleNews = std::function<void(std::size_t moved, double unevenness)>;

/// The largest stable step and what set it.
struct StepLimit {
  double step = 0;        ///< [s]
  std::string criterion;  ///< "Courant", "force", "density" (it may change by a fifth) or "fixed"
  std::uint32_t particle = 0;
  Vec3 position = Vec3::Zero();
  std::string body;
};

/// Energy [J], momentum [kg m/s] and mass [kg] of the computed part (an octant's, say), booked since the start.
struct Ledger {
  double kinetic = 0;
  double internal = 0;    ///< internal energy; compression energy where the law is barotropic
  double dissipated = 0;  ///< viscous heat of barotropic bodies (where there is an energy field it is in `internal`)
  double wall_work = 0;   ///< work that the fluid has done on moving walls
  double radiated = 0;    ///< and on radiating faces: what has left through them
  double gravity = 0;     ///< work that gravity has done on the fluid
  /// Work of the surroundings' pressure on it, less what moving walls have of that: - p (change of the fluid's volume).
  double surroundings = 0;
  double mass = 0;
  Vec3 momentum = Vec3::Zero();
  Vec3 radiated_momentum = Vec3::Zero();  ///< that has left through radiating faces
};

/// One body of the fluid, of the computed part: in two dimensions a metre deep, of revolution whole rings.
struct BodyTotals {
  double mass = 0;               ///< [kg]
  double volume = 0;             ///< [m^3]
  double kinetic = 0;            ///< [J]
  double internal = 0;           ///< as that of the ledger [J]
  double pressure_volume = 0;    ///< integral of the pressure, the surroundings' included, over the volume [J]
  double cavitated = 0;          ///< volume of particles of liquid that have a void fraction [m^3]
  double voids = 0;              ///< integral of the void fraction [m^3]
  Vec3 moment = Vec3::Zero();    ///< integral of place over mass [kg m]
  Vec3 momentum = Vec3::Zero();  ///< [kg m/s]

  void operator+=(const BodyTotals& other);
};

/// Counts of floors and clamps that acted since the start.
struct Clamps {
  long density = 0;    ///< change of density in half a step held at a factor of e
  long smoothing = 0;  ///< smoothing length held at a bound of [h_low, h_high]
  long filling = 0;    ///< filling held at its lower bound (free surfaces of gas)
  long energy = 0;     ///< gas with a negative energy, whose sound speed its law may hold at a lower bound
};

class Fluid {
 public:
  /// Lays out the particles. Throws std::invalid_argument naming the body and the remedy where none result.
  explicit Fluid(const Settings& settings);
  ~Fluid();
  Fluid(Fluid&&) noexcept;

  const Settings& settings() const;
  std::size_t particle_count() const;
  std::size_t wall_particle_count() const;
  /// Particles of each body, in the scene's order; gas that expands splits its own (split.hpp).
  std::vector<std::size_t> particles_by_body() const;
  std::vector<std::size_t> particles_by_body_at_start() const;
  long long updates() const;  ///< of particles, over all steps
  std::size_t memory_bytes() const;
  double time() const;
  long steps() const;
  long substeps() const;                         ///< of fast bodies, where bodies have steps of their own
  std::vector<std::string> fast_bodies() const;  ///< those that take substeps at present

  /// Adds a wall that somebody else moves; keep its index. Its points count from the next step on.
  MirrorIndex add_wall(MirrorWall wall);
  LinedIndex add_wall(LinedWall wall);
  MirrorWall& wall(MirrorIndex index);
  LinedWall& wall(LinedIndex index);
  /// Forces [N] on its points at the last evaluation.
  const std::vector<Vec3>& wall_force(MirrorIndex index) const;
  const std::vector<Vec3>& wall_force(LinedIndex index) const;

  /// To be called once all walls are there and before the first step: particles that uniform pressure would set in motion are
  /// moved to where it does not (settle.hpp), unless the settings say otherwise.
  void settle(const SettleNews& news = {});

  /// Valid from construction on: rates are evaluated at once.
  StepLimit step_limit();
  /// Advances by dt [s]. Throws NumericalStop when the state that results, or its rates, are not finite or beyond all physics.
  /// What is left then is the last healthy state, before the step or in its middle (see time()), for output.
  void step(double dt);

  /// What the next step goes on from. Walls are as their owners have shown them.
  void visit_state(StateVisitor& state);
  /// The state of a step that went wrong (see step) is gone on with: its rates are found anew, as at a start.
  void find_rates_anew();

  Ledger ledger() const;
  /// Impulses [N s] that slip faces at rest have received since the start, of the computed part.
  const OnFixedFaces& on_fixed_faces() const;
  std::vector<BodyTotals> totals() const;  ///< of each body, in the scene's order
  std::vector<LargestOf> largest() const;  ///< pressure, the surroundings' included, and speed of each body
  /// Shepard averages.
  FluidPoint at(const Vec3& point) const;
  double maximum_pressure() const;  ///< [Pa]
  double maximum_speed() const;     ///< [m/s]
  Clamps clamps() const;
  long long neighbour_interactions() const;  ///< true neighbours, directed, summed over all steps
  const PassTimers& timers() const;

  /// Copies a field for output: position, velocity (3 components each, interleaved); pressure, density, void_fraction,
  /// energy, smoothing_length, material, sound_speed, mass, id (1). Throws std::invalid_argument for other names.
  std::vector<double> field(std::string_view name) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace undex::sph
