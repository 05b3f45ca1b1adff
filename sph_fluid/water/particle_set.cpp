#include "sph_fluid/water/particle_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace undex::sph {
namespace {

const char* remedy(const Settings& settings) {
  if (settings.numerics.fixed_step) return "a smaller scheme.fixed_step, or none,";
  return is_viscous(settings.numerics.scheme) ? "a smaller scheme.courant or a larger scheme.beta" : "a smaller scheme.courant";
}

}  // namespace

double share_burnt(const Group& group, std::uint32_t k, double time) {
  if (k >= group.lighting.size()) return 1.0;  // only what has burnt splits
  const materials::ProgrammedBurn& burn = *group.body->burn;
  // The front is timed from where the zone was at the start.
  const double since = time - group.lighting[k];
  // The front lies in the middle of the ramp: particles see half of the burn from either side, and no delay.
  return burn.width > 0 ? std::clamp(0.5 + since * burn.D / burn.width, 0.0, 1.0) : since >= 0 ? 1.0 : 0.0;
}

std::size_t ParticleSet::memory_bytes() const {
  std::size_t bytes = particles.memory_bytes() + images.memory_bytes() + blocks.memory_bytes();
  for (const Group& group : groups) bytes += group.cells.memory_bytes();
  return bytes + interactions.capacity() * sizeof(long long);
}

void ParticleSet::visit_loads(StateVisitor& state) {
  state("last step", last_step);
  state.part("wall force", [&] { wall_force.visit_state(state); });
  state("wall power", wall_power.moving);
  state("radiated power", wall_power.radiating);
  for (std::size_t k = 0; k < wall_power.fixed.size(); ++k) state("fixed face " + std::to_string(k), wall_power.fixed[k]);
}

void ParticleSet::visit_state(StateVisitor& state) {
  state("pairs", choice);
  for (std::size_t g = 0; g < groups.size(); ++g)
    state.part("body " + std::to_string(g), [&] {
      state("first", groups[g].begin);
      state("end", groups[g].end);
      state("fast", groups[g].fast);
      state("largest h", groups[g].h_max);
    });
  state.part("particles", [&] { particles.visit_state(state, choice != PairChoice::all); });
  state("reach", reach);
  visit_loads(state);
  images.visit_state(state);
}

const Body& body_of(const ParticleSet& set, std::uint32_t i) {
  for (const Group& group : set.groups)
    if (i < group.end) return *group.body;
  return *set.groups.back().body;
}

std::string what_is_wrong(const ParticleSet& set, const Settings& settings, const Clock& clock) {
  const Particles& p = set.particles;
  char text[400];
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    const std::pair<const char*, double> values[] = {{"position", p.x[i] + p.y[i] + p.z[i]},
                                                     {"velocity", p.vx[i] + p.vy[i] + p.vz[i]},
                                                     {"density", p.rho[i]},
                                                     {"acceleration", p.rate[i].fx + p.rate[i].fy + p.rate[i].fz},
                                                     {"pressure", p.predicted[i].p},
                                                     {"sound speed", p.predicted[i].c},
                                                     {"heating", p.rate[i].heat}};
    for (const auto& [name, value] : values)
      if (!std::isfinite(value)) {
        std::snprintf(text, sizeof text,
                      "step %ld, time %.6g s: %s of particle %u (body '%s') is not finite, near (%.5g, %.5g, %.5g) m; "
                      "%s may hold it",
                      clock.steps, clock.time, name, p.id[i], body_of(set, i).name.c_str(), p.x[i], p.y[i], p.z[i],
                      remedy(settings));
        return text;
      }
  }
  const auto speed = [&](std::uint32_t i) { return std::sqrt(p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]); };
  std::uint32_t i = 0;
  for (std::uint32_t k = 0; k < p.size(); ++k)
    if (speed(k) > speed(i)) i = k;
  std::snprintf(text, sizeof text,
                "step %ld, time %.6g s: speeds beyond all physics; the fastest is particle %u (body '%s') with %.3g m/s at "
                "(%.5g, %.5g, %.5g) m; %s may hold it",
                clock.steps, clock.time, p.id[i], body_of(set, i).name.c_str(), speed(i), p.x[i], p.y[i], p.z[i],
                remedy(settings));
  return text;
}

}  // namespace undex::sph
