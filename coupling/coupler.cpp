#include "coupling/coupler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "coupling/liquid_layers.hpp"

namespace undex::coupling {

sph::StepLimit added_mass_limit(const sph::Settings& fluid, const WetBody& structure) {
  const WetSurface& surface = structure.wet_surface();
  const std::vector<double> area = nodal_areas(surface.faces, surface.nodes, fluid.axisymmetric);
  const auto mass = structure.wet_masses();
  const LiquidLayers liquids(fluid);
  sph::StepLimit limit;
  limit.step = std::numeric_limits<double>::infinity();
  limit.criterion = "added mass";
  if (liquids.empty()) return limit;
  for (std::size_t n = 0; n < mass.size(); ++n) {
    const LiquidLayers::Layer& liquid = liquids.nearest(surface.nodes[n]);
    const double step = added_mass_share * std::sqrt(mass[n] / (area[n] * liquid.stiffness));
    if (step < limit.step) {
      limit.step = step;
      limit.position = surface.nodes[n];
      limit.body = liquid.body->name;
    }
  }
  return limit;
}

Coupler::Coupler(Flow& flow, WetBody& structure, const Settings& settings)
    : flow_(flow),
      fluid_(flow.fluid()),
      structure_(structure),
      settings_(settings),
      wall_(structure.wet_surface(), fluid_.settings()),
      wall_index_(wall_.add_to(fluid_, settings.free_slip)),
      added_mass_(added_mass_limit(fluid_.settings(), structure)),
      predicted_position_(structure.wet_surface().nodes.size()),
      predicted_velocity_(predicted_position_.size()),
      nodal_impulse_(predicted_position_.size(), Vec3::Zero()) {
  show_wall(0.0);
}

/// The wall `ahead` [s] after the structure's present state, at its present acceleration.
void Coupler::show_wall(double ahead) {
  const auto timer = timers_.measure("coupling");
  const auto x = structure_.wet_positions(), v = structure_.wet_velocities(), a = structure_.wet_accelerations();
  for (std::size_t n = 0; n < x.size(); ++n) {
    predicted_position_[n] = x[n] + ahead * (v[n] + 0.5 * ahead * a[n]);
    predicted_velocity_[n] = v[n] + ahead * a[n];
  }
  std::visit([&](auto index) { wall_.move(predicted_position_, predicted_velocity_, fluid_.wall(index)); }, wall_index_);
}

sph::StepLimit Coupler::step_limit() {
  const sph::StepLimit limit = flow_.step_limit();
  return added_mass_.step < limit.step && !fluid_.settings().numerics.fixed_step ? added_mass_ : limit;
}

template <class Wall>
void Coupler::collect_impulse(Wall& wall) {
  ledger_.book_given(wall.impulse);
  std::fill(nodal_impulse_.begin(), nodal_impulse_.end(), Vec3::Zero());
  wall_.collect_impulse(wall, nodal_impulse_);
}

Coupler::Window Coupler::advance(double end) {
  Window window;
  const double start = structure_.time();
  const double patience = std::min(settings_.window * structure_.stable_step(), added_mass_.step);
  const long structure_steps = structure_.steps();
  window.limit = step_limit();
  double target = std::min(end, start + std::max(patience, window.limit.step));
  // The last two windows before `end` share what is left, so that none is tiny.
  if (target < end && end - start < 2.0 * (target - start)) target = 0.5 * (start + end);
  do {
    if (window.fluid_steps > 0) window.limit = step_limit();
    const double left = target - fluid_.time();
    window.step = left / std::ceil(left / window.limit.step - 1e-9);
    show_wall(fluid_.time() + window.step - start);
    flow_.step(window.step);
    ++window.fluid_steps;
  } while (fluid_.time() < target * (1 - 1e-12));
  window.held_by_structure = window.fluid_steps > 1;

  {
    const auto timer = timers_.measure("coupling");
    std::visit([&](auto index) { collect_impulse(fluid_.wall(index)); }, wall_index_);
    ledger_.book_received(nodal_impulse_);
  }
  structure_.advance(fluid_.time(), nodal_impulse_);
  window.structure_steps = structure_.steps() - structure_steps;
  return window;
}

void Coupler::visit_state(StateVisitor& state) {
  ledger_.visit_state(state);
  state("timers", timers_);
}

InterfaceLedger Coupler::ledger() const {
  InterfaceLedger ledger = ledger_;
  ledger.work_given = fluid_.ledger().wall_work;
  ledger.work_received = structure_.ledger().received;
  return ledger;
}

}  // namespace undex::coupling
