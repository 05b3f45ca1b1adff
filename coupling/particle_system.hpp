// Fluid and solids as one system of particles, without a coupling layer: every solid particle within reach of the water is a
// wall particle of the pair loop, and what a pair gives to it is its own force, in the same evaluation. Solids take as many
// steps of their own within a step of the fluid as they need (impulse method of Tuckerman, Berne, Martyna 1992,
// doi 10.1063/1.463137: half of the fluid's kick before them, half after): momentum is conserved to round-off.
#pragma once

#include "coupling/flow.hpp"
#include "sph_solid/solids.hpp"

namespace undex::coupling {

class ParticleSystem {
 public:
  /// Both must outlive it.
  ParticleSystem(Flow& flow, solid::Solids& solids, bool free_slip);

  struct Step {
    double step = 0;       ///< [s]
    sph::StepLimit limit;  ///< the fluid's
    long solid_steps = 0;
  };
  /// One step of the fluid, not beyond `end` [s].
  Step advance(double end);

 private:
  Flow& flow_;
  sph::Fluid& fluid_;
  solid::Solids& solids_;
  sph::LinedIndex wall_;
  std::vector<Vec3> impulse_;  ///< [N s], per solid particle
};

}  // namespace undex::coupling
