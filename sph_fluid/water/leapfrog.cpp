#include "sph_fluid/water/leapfrog.hpp"

namespace undex::sph {
namespace {

void stand_half_way(Water& water, double dt) {
  water.drift(water.all, -0.5 * dt);
  water.cross_mirrors(water.all);
  water.clock.time += 0.5 * dt;
  water.evaluation.rest(water.all, water.clock.time);
}

}  // namespace

void step_leapfrog(Water& water, double dt) {
  ParticleSet& all = water.all;
  {
    const auto timer = water.timers.measure("integration");
    if (!water.half_kick(all, dt)) {
      const std::string what = what_is_wrong(all, water.settings, water.clock);
      water.half_kick(all, -dt);
      throw NumericalStop(what, /*resumable=*/true);
    }
    water.drift(all, dt);
    water.cross_mirrors(all);
  }
  water.evaluate(all, {.time = water.clock.time + dt, .half = 0.5 * dt, .bend = bend_of(dt, all.last_step), .whole = true});
  if (!all.healthy) {
    const std::string what = what_is_wrong(all, water.settings, water.clock);
    stand_half_way(water, dt);
    throw NumericalStop(what, /*resumable=*/true);
  }
  const auto timer = water.timers.measure("integration");
  water.half_kick(all, dt);
}

}  // namespace undex::sph
