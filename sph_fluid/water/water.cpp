#include "sph_fluid/water/water.hpp"

#include <cmath>

#include "sph_fluid/pairs/sums.hpp"

namespace undex::sph {

Water::Water(const Settings& given)
    : settings(given), radiating(settings, walls), evaluation(settings, walls, radiating, clock, timers, clamps) {
  clock.time = settings.start_time;
  exchange.dissipated = settings.heat_before;
}

void Water::evaluate(ParticleSet& set, const Ahead& ahead) {
  evaluation.rates(set, ahead);
  exchange.dissipated -= evaluation.take_parted();
  if (settings.numerics.integrator == Integrator::ssp_rk3 || set.choice == PairChoice::slow) walls_seen = walls.motions();
  evaluated = true;
}

void Water::evaluate_or_stop(ParticleSet& set, const Ahead& ahead) {
  evaluate(set, ahead);
  require(set.healthy, set);
}

bool Water::half_kick(ParticleSet& set, double dt) {
  const double half = 0.5 * dt;
  Particles& p = set.particles;
  const bool has_energy = !p.energy.empty();
  long clamped = 0;
  double largest_square = 0;
#pragma omp parallel for schedule(static) reduction(+ : clamped) reduction(max : largest_square)
  for (std::size_t i = 0; i < p.size(); ++i) {
    const SumRow& rate = p.rate[i];
    if (has_energy) p.energy[i] += half * rate.heat;
    p.vx[i] += half * rate.fx;
    p.vy[i] += half * rate.fy;
    p.vz[i] += half * rate.fz;
    largest_square = std::max(largest_square, p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
    clamped += std::abs(half * rate.compression) > 1.0;
    p.rho[i] = advanced_density(p.rho[i], half * rate.compression);
  }
  clamps.density += clamped;
  if (!p.viscosity.empty()) advance_viscosity(set, half);
  book(set, half);
  return largest_square < fastest * fastest;
}

void Water::book(const ParticleSet& set, double duration) {
  const Particles& p = set.particles;
  // Heat counts as dissipated where no energy field takes it up.
  for (const Group& group : set.groups)
    if (!materials::uses_energy(group.body->material.law))
      exchange.dissipated +=
          duration * blocked_sum<double>(group.begin, group.end, [&](std::uint32_t i) { return p.mass[i] * p.rate[i].heat; });
  walls.receive(set.wall_force, duration);
  exchange.wall_work += duration * set.wall_power.moving;
  exchange.radiated += duration * set.wall_power.radiating;
  for (std::size_t k = 0; k < exchange.fixed.size(); ++k) exchange.fixed[k] += duration * set.wall_power.fixed[k];
}

void Water::drift(ParticleSet& set, double dt) {
  Particles& p = set.particles;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.x[i] += dt * p.vx[i];
    p.y[i] += dt * p.vy[i];
    p.z[i] += dt * p.vz[i];
  }
}

void Water::cross_mirrors(ParticleSet& set) {
  cross_symmetry_planes(set.particles);
  WallLoads received = walls.unloaded();
  const WallShare work = set.images.put_back(settings, evaluation.slip_faces(), walls.mirrors, set.particles, received.mirrors);
  exchange.wall_work += work.moving;
  exchange.radiated += work.radiating;
  for (std::size_t k = 0; k < exchange.fixed.size(); ++k) exchange.fixed[k] += work.fixed[k];
  walls.receive(received, 1.0);
}

void Water::cross_symmetry_planes(Particles& p) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!settings.symmetry.axis[axis]) continue;
    const std::vector<double>& x = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < p.size(); ++i)
      if (x[i] < 0.0)
        for_each_vector(p, i, [axis](Vector, auto& a, auto& b, auto& c) {
          auto& across = axis == 0 ? a : axis == 1 ? b : c;
          across = -across;
        });
  }
}

Water::SwitchRates Water::switch_rates(const ParticleSet& set, std::uint32_t i) {
  const Particles& p = set.particles;
  const FluidRow& q = p.predicted[i];
  double compression = p.rate[i].compression;
  if (!p.other.empty()) compression += p.other[i].rate.compression;
  return {0.2 * q.c / q.h, std::max(compression, 0.0)};
}

void Water::advance_viscosity(ParticleSet& set, double dt) const {
  const double low = settings.numerics.alpha_min, high = settings.numerics.alpha;
  for (const Group& group : set.groups) {
    if (!set.moves(group)) continue;  // each with its own step
#pragma omp parallel for schedule(static)
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const auto [decay, source] = switch_rates(set, i);
      // Linear in alpha: its solution stays within the bounds for any step.
      const double goal = (decay * low + source * high) / (decay + source);
      double& alpha = set.particles.viscosity[i].alpha;
      alpha = goal + (alpha - goal) * std::exp(-(decay + source) * dt);
    }
  }
}

}  // namespace undex::sph
