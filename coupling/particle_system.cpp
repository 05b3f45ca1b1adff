#include "coupling/particle_system.hpp"

#include <cmath>
#include <limits>

#include "coupling/coupler.hpp"
#include "coupling/liquid_layers.hpp"

namespace undex::coupling {
namespace {

/// Water answers to the velocity w of a solid's face with -rho c w per area, w being what the forces of the step's beginning have
/// made of it, and the rest of the step's impulse follows at its end. With g = rho c dt/m, m the mass that the face has at once,
///   w' = v - g w,   v' = w' - g (w' - w)/2:
/// errors turn round and grow from g = 1 on.
sph::StepLimit skin_limit(const sph::Settings& fluid, const solid::Solids& solids) {
  constexpr double share = 0.7;
  const WetSurface& surface = solids.wet_surface();
  const std::vector<double> area = nodal_areas(surface.faces, surface.nodes, fluid.axisymmetric);
  const LiquidLayers liquids(fluid);
  sph::StepLimit limit;
  limit.step = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < area.size() && !liquids.empty(); ++n) {
    const LiquidLayers::Layer& liquid = liquids.nearest(surface.nodes[n]);
    const double step = share * solids.wet_skin_masses()[n] / (area[n] * liquid.impedance);
    if (step < limit.step)
      limit = {.step = step, .criterion = "added mass", .particle = 0, .position = surface.nodes[n], .body = liquid.body->name};
  }
  return limit;
}

/// The shorter one.
sph::StepLimit least(const sph::StepLimit& a, const sph::StepLimit& b) { return b.step < a.step ? b : a; }

}  // namespace

ParticleSystem::ParticleSystem(Flow& flow, solid::Solids& solids, const Settings& settings)
    : flow_(flow),
      fluid_(flow.fluid()),
      solids_(solids),
      wall_(solids.wet_surface(), fluid_.settings()),
      wall_index_(wall_.add_to(fluid_, settings.free_slip)),
      added_mass_(least(added_mass_limit(fluid_.settings(), solids), skin_limit(fluid_.settings(), solids))) {
  show_wall();
}

void ParticleSystem::show_wall() {
  std::visit([&](auto index) { wall_.move(solids_.wet_positions(), solids_.wet_velocities(), fluid_.wall(index)); }, wall_index_);
}

std::vector<Vec3> ParticleSystem::unloaded() const { return std::vector<Vec3>(solids_.wet_surface().nodes.size(), Vec3::Zero()); }

sph::StepLimit ParticleSystem::step_limit() {
  const sph::StepLimit limit = flow_.step_limit();
  return fluid_.settings().numerics.fixed_step ? limit : least(limit, added_mass_);
}

ParticleSystem::Step ParticleSystem::advance(double end) {
  Step step;
  step.limit = step_limit();
  const double left = end - fluid_.time();
  // The last few steps before `end` share what is left, so that none is tiny.
  step.step = left < 3.0 * step.limit.step ? left / std::ceil(left / step.limit.step - 1e-9) : step.limit.step;

  std::vector<Vec3> held = unloaded();
  std::visit([&](auto index) { wall_.hand_on(fluid_.wall(index), fluid_.wall_force(index), held); }, wall_index_);
  for (Vec3& force : held) force *= step.step;
  const long before = solids_.steps();
  solids_.advance(fluid_.time() + step.step, held);
  step.solid_steps = solids_.steps() - before;

  show_wall();
  flow_.step(step.step);
  std::vector<Vec3> received = unloaded();
  const auto take = [&](auto index) {
    ledger_.book_given(fluid_.wall(index).impulse);
    wall_.collect_impulse(fluid_.wall(index), received);
  };
  std::visit(take, wall_index_);
  ledger_.book_received(received);
  for (std::size_t n = 0; n < received.size(); ++n) received[n] -= held[n];
  solids_.kick_surface(received);
  return step;
}

InterfaceLedger ParticleSystem::ledger() const {
  InterfaceLedger ledger = ledger_;
  ledger.work_given = fluid_.ledger().wall_work;
  ledger.work_received = solids_.ledger().received;
  return ledger;
}

}  // namespace undex::coupling
