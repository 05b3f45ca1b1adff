#include "sph_fluid/water/ssp_rk3.hpp"

#include <algorithm>
#include <cmath>

namespace undex::sph {
namespace {

/// From u and its rates to (1 - share) u_start + share (u + dt L(u)); `weight` is that of these rates in the step. False: a
/// particle is beyond `fastest` now.
bool advance(Water& water, double dt, double share, double weight) {
  const auto timer = water.timers.measure("integration");
  ParticleSet& set = water.all;
  water.book(set, weight * dt);
  Particles& p = set.particles;
  const ParticleState& start = p.start;
  const double kept = 1.0 - share, low = water.settings.numerics.alpha_min, high = water.settings.numerics.alpha;
  double largest_square = 0;
#pragma omp parallel for schedule(static) reduction(max : largest_square)
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    const SumRow& rate = p.rate[i];
    p.x[i] = kept * start.x[i] + share * (p.x[i] + dt * p.vx[i]);
    p.y[i] = kept * start.y[i] + share * (p.y[i] + dt * p.vy[i]);
    p.z[i] = kept * start.z[i] + share * (p.z[i] + dt * p.vz[i]);
    p.vx[i] = kept * start.vx[i] + share * (p.vx[i] + dt * rate.fx);
    p.vy[i] = kept * start.vy[i] + share * (p.vy[i] + dt * rate.fy);
    p.vz[i] = kept * start.vz[i] + share * (p.vz[i] + dt * rate.fz);
    largest_square = std::max(largest_square, p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
    p.rho[i] = start.rho[i] * std::exp(share * (std::log(p.rho[i] / start.rho[i]) + dt * rate.compression));
    if (!p.energy.empty()) p.energy[i] = kept * start.energy[i] + share * (p.energy[i] + dt * rate.heat);
    if (!p.viscosity.empty()) {
      const auto [decay, source] = Water::switch_rates(set, i);
      double& alpha = p.viscosity[i].alpha;
      alpha = kept * start.viscosity[i].alpha + share * (alpha + dt * (decay * (low - alpha) + source * (high - alpha)));
      alpha = std::clamp(alpha, low, high);  // left at steps beyond the limits only
    }
  }
  water.cross_mirrors(set);
  return largest_square < fastest * fastest;
}

}  // namespace

void step_ssp_rk3(Water& water, double dt) {
  const std::vector<WallMotion> before = water.walls_seen, after = water.walls.motions();
  const struct {
    double share, weight, at;  // see advance(); time of the stage's result as a share of the step
  } stages[] = {{1.0, 1.0 / 6.0, 1.0}, {0.25, 1.0 / 6.0, 0.5}, {2.0 / 3.0, 2.0 / 3.0, 1.0}};
  for (const auto& [share, weight, at] : stages) {
    water.require(advance(water, dt, share, weight), water.all);
    if (at < 1.0) water.walls.show_between(before, after, dt, at);
    else water.walls.show(after);
    water.evaluate_or_stop(water.all, {.time = water.clock.time + at * dt, .whole = &share == &stages[2].share});
  }
}

}  // namespace undex::sph
