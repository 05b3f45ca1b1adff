// Fluid and solids as one system of particles, without windows and predicted walls: the water is mirrored in the solids' wet
// faces where these are at the end of its step. Solids take as many steps of their own within it as they need, under the forces
// of its beginning held; what the step's impulse turns out to be more or less they receive at once at its end, so that momentum
// is conserved to round-off.
#pragma once

#include "coupling/flow.hpp"
#include "coupling/interface_ledger.hpp"
#include "coupling/settings.hpp"
#include "coupling/wet_wall.hpp"
#include "sph_solid/solids.hpp"

namespace undex::coupling {

class ParticleSystem {
 public:
  /// Both must outlive it. The solids' wet faces are meshed. Throws std::invalid_argument where they cannot be such a wall.
  ParticleSystem(Flow& flow, solid::Solids& solids, const Settings& settings);

  struct Step {
    double step = 0;       ///< [s]
    sph::StepLimit limit;  ///< the fluid's, or the wall's mass where that is less
    long solid_steps = 0;
  };
  /// One step of the fluid, not beyond `end` [s].
  Step advance(double end);

  InterfaceLedger ledger() const;
  void visit_state(StateVisitor& state) { ledger_.visit_state(state); }

 private:
  sph::StepLimit step_limit();
  void show_wall();
  std::vector<Vec3> unloaded() const;

  Flow& flow_;
  sph::Fluid& fluid_;
  solid::Solids& solids_;
  WetWall wall_;
  WallIndex wall_index_;
  sph::StepLimit added_mass_;
  InterfaceLedger ledger_;
};

}  // namespace undex::coupling
