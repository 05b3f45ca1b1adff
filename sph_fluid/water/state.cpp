// What a fluid is between two steps.
#include "sph_fluid/water/fluid_implementation.hpp"

namespace undex::sph {
namespace {

void visit_clamps(Clamps& clamps, StateVisitor& state) {
  state("density", clamps.density);
  state("smoothing", clamps.smoothing);
  state("filling", clamps.filling);
  state("energy", clamps.energy);
}

}  // namespace

void Fluid::Implementation::visit_state(StateVisitor& state) {
  // Footprints of mirror walls are those of the walls' first places, so what is restored has been evaluated once as well.
  if (!evaluated) evaluate(all, {.time = clock.time});
  state("time", clock.time);
  state("steps", clock.steps);
  state("updates", clock.updates);
  state("dissipated", exchange.dissipated);
  state("wall work", exchange.wall_work);
  state("radiated", exchange.radiated);
  for (std::size_t k = 0; k < exchange.fixed.size(); ++k) state("on fixed face " + std::to_string(k), exchange.fixed[k]);
  state.part("clamps", [&] { visit_clamps(clamps, state); });
  state.part("walls", [&] { walls.visit_state(state); });
  state.part("radiating", [&] { radiating.visit_state(state); });
  std::size_t seen = walls_seen.size();
  state("walls seen", seen);
  walls_seen.resize(seen);
  for (std::size_t w = 0; w < seen; ++w) state.part("wall seen " + std::to_string(w), [&] { walls_seen[w].visit_state(state); });
  all.visit_state(state);
  state.part("evaluation", [&] { evaluation.visit_state(state); });
  state.part("local steps", [&] { local_steps.visit_state(state); });
  state("timers", timers);
  if (state.restores()) {
    evaluation.pack_walls(all);
    limits_known = false;
  }
}

void Fluid::Implementation::find_rates_anew() {
  if (local_steps.parted()) local_steps.join();
  all.last_step = 0;
  evaluated = false;
}

}  // namespace undex::sph
