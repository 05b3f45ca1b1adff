#include "sph_fluid/water/leapfrog.hpp"
#include "sph_fluid/water/fluid_implementation.hpp"
#include "sph_fluid/water/ssp_rk3.hpp"

namespace undex::sph {

void Fluid::Implementation::step(double dt) {
  if (!evaluated || (local_steps.may_part() && !limits_known)) step_limit();
  if (local_steps.parted()) {
    step_or_stay(dt, [&] { local_steps.step(dt); });
  } else if (settings.numerics.integrator == Integrator::ssp_rk3) {
    step_or_stay(dt, [&] { step_ssp_rk3(*this, dt); });
  } else {
    radiating.advance(dt);
    step_leapfrog(*this, dt);
  }
  clock.time += dt;
  all.last_step = dt;
  ++clock.steps;
  clock.updates += (long long)(all.particles.size());
  limits_known = false;
}

template <class Step>
void Fluid::Implementation::step_or_stay(double dt, Step step) {
  const std::vector<WallMotion> shown = walls.motions();
  const WallLoads impulses = walls.impulses();
  const RadiatingFaces::State faces = radiating.state();
  const Exchange booked = exchange;
  all.particles.keep_start();
  try {
    radiating.advance(dt);
    step();
  } catch (const NumericalStop& stop) {
    all.particles.restore_start();
    cross_mirrors(all);
    exchange = booked;
    radiating.go_back_to(faces);
    walls.show(shown);
    walls.set_impulses(impulses);
    if (local_steps.parted()) local_steps.join();
    evaluation.rest(all, clock.time);
    throw NumericalStop(stop.what(), /*resumable=*/true);
  }
}

void Fluid::Implementation::expect_walls() {
  all.wall_force = walls.unloaded();
  evaluation.signals().expect_everywhere();
  local_steps.join();
  evaluated = false;
}

}  // namespace undex::sph
