#include "sph_fluid/water/signals.hpp"

#include <cmath>

namespace undex::sph {

void Signals::watch(const Settings& settings, ParticleSet& set) {
  share_ = settings.numerics.signal;
  rings_ = settings.axisymmetric;
  everywhere_ = share_ <= 0.0 || !settings.gravity.isZero();
  for (const Body& body : settings.bodies) everywhere_ = everywhere_ || body.burn.has_value();
  disturbed_ = Bounds{};
  if (everywhere_) return;
  Particles& p = set.particles;
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    const SumRow& rate = p.rate[i];
    const FluidRow& q = p.predicted[i];
    const double a2 = rate.fx * rate.fx + rate.fy * rate.fy + rate.fz * rate.fz;
    // Round-off of the pressure itself, too, is rest.
    if (std::sqrt(a2) * q.rho * q.h > 1e-10 * std::abs(q.p) + 1e-14 * q.rho * q.c * q.c) disturbed_.include(place_of(p, i));
  }
  find(set);
  for (std::uint32_t i = 0; i < p.size(); ++i)
    if (leaves_out(place_of(p, i), set.reach)) p.rate[i] = SumRow{};
}

void Signals::expect_within(const Bounds& box) {
  everywhere_ = false;
  disturbed_ = box;
  share_ = 1.0;
}

void Signals::find(const ParticleSet& set) {
  if (everywhere_) return;
  for (const Group& group : set.groups) {
    Bounds found;
#pragma omp parallel
    {
      Bounds mine;
#pragma omp for schedule(static)
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const FluidRow& q = set.particles.predicted[i];
        const double vz = rings_ ? 0.0 : q.vz, v2 = q.vx * q.vx + q.vy * q.vy + vz * vz, still = share_ * q.c;
        if (v2 > still * still || std::abs(q.rho - group.rest_density) > share_ * group.rest_density)
          mine.include(place_of(set.particles, i));
      }
#pragma omp critical
      found.include(mine);
    }
    disturbed_.include(found);
  }
}

void Signals::describe(PairInput& in, double margin) const {
  in.partly = !everywhere_;
  for (int a = 0; a < 3; ++a) {
    in.disturbed_low[a] = disturbed_.low[a];
    in.disturbed_high[a] = disturbed_.high[a];
  }
  in.margin = margin;
}

void Signals::visit_state(StateVisitor& state) {
  state("everywhere", everywhere_);
  state("low", disturbed_.low);
  state("high", disturbed_.high);
}

}  // namespace undex::sph
