#include "coupling/particle_system.hpp"

#include <algorithm>
#include <cmath>

namespace undex::coupling {

ParticleSystem::ParticleSystem(Flow& flow, solid::Solids& solids, bool free_slip)
    : flow_(flow), fluid_(flow.fluid()), solids_(solids), wall_(fluid_.add_wall(solids.wet_wall(free_slip))) {}

ParticleSystem::Step ParticleSystem::advance(double end) {
  Step step;
  step.limit = flow_.step_limit();
  const double left = end - fluid_.time();
  // The last few steps before `end` share what is left, so that none is tiny.
  step.step = left < 3.0 * step.limit.step ? left / std::ceil(left / step.limit.step - 1e-9) : step.limit.step;
  const std::vector<std::uint32_t>& wet = solids_.wet_particles();
  impulse_.assign(solids_.particle_count(), Vec3::Zero());
  const std::vector<Vec3>& force = fluid_.wall_force(wall_);
  for (std::size_t k = 0; k < force.size(); ++k) impulse_[wet[k]] = 0.5 * step.step * force[k];
  solids_.kick(impulse_);
  const long before = solids_.steps();
  solids_.advance(fluid_.time() + step.step);
  step.solid_steps = solids_.steps() - before;

  sph::LinedWall& wall = fluid_.wall(wall_);
  solids_.move_wall(wall, 0.0);
  // The second half of the kick, as far as it is known.
  for (std::size_t k = 0; k < force.size(); ++k) wall.velocity[k] += impulse_[wet[k]] / solids_.masses()[wet[k]];
  flow_.step(step.step);
  for (std::size_t k = 0; k < wet.size(); ++k) {
    impulse_[wet[k]] = wall.impulse[k] - impulse_[wet[k]];
    wall.impulse[k].setZero();
  }
  solids_.kick(impulse_);
  return step;
}

}  // namespace undex::coupling
