// What others ask of a fluid: the stable step, sums, fields, values at points.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "core/errors.hpp"
#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/water/fluid_implementation.hpp"
#include "sph_fluid/pairs/sums.hpp"

namespace undex::sph {

// ---- What others ask ------------------------------------------------------------------------------------------------

BodyLimit limit_of(const ParticleSet& set, const Group& group, const Numerics& numerics) {
  const Particles& particles = set.particles;
  // Monaghan 1992, Annu. Rev. Astron. Astrophys. 30, eq. 10.2, for a viscosity; a Riemann flux moves with the fluid.
  const bool viscous = is_viscous(numerics.scheme);
  const double alpha = viscous ? 0.6 * numerics.alpha : 0.0, beta = viscous ? 0.6 * numerics.beta : 1.0;
  const double inverse_alpha = 1.0 / numerics.alpha;
  const bool parted = !particles.other.empty();
  BodyLimit limit;
  limit.particle = group.begin;
#pragma omp parallel
  {
    BodyLimit mine;
#pragma omp for schedule(static)
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const FluidRow& q = particles.predicted[i];
      SumRow rate = particles.rate[i];
      if (parted) {
        const SumRow& other = particles.other[i].rate;
        rate.fx += other.fx;
        rate.fy += other.fy;
        rate.fz += other.fz;
        rate.compression += other.compression;
        rate.closing = std::max(rate.closing, other.closing);
      }
      const double a2 = rate.fx * rate.fx + rate.fy * rate.fy + rate.fz * rate.fz;
      const double share = particles.viscosity.empty() ? 1.0 : particles.viscosity[i].alpha * inverse_alpha;
      const double signal = q.c + share * (alpha * q.c + beta * rate.closing);
      const double courant = numerics.courant * q.h / signal;
      const double push = 0.25 * std::sqrt(q.h / std::sqrt(a2 + 1e-300));
      const double squeeze = 0.2 / (std::abs(rate.compression) + 1e-300);
      const double least = std::min({courant, push, squeeze});
      if (least < mine.step) {
        mine.step = least;
        mine.particle = i;
        mine.criterion = least == courant ? "Courant" : least == push ? "force" : "density";
      }
    }
#pragma omp critical
    {
      // The particle's place breaks ties, so that the answer does not depend on who comes first.
      if (mine.step < limit.step || (mine.step == limit.step && mine.particle < limit.particle)) limit = mine;
    }
  }
  return limit;
}

StepLimit Fluid::Implementation::step_limit() {
  if (!evaluated) evaluate(all, {.time = clock.time});
  require(all.healthy, all);  // as the scene was given: a step does not end so
  std::vector<BodyLimit> limits;
  const auto find_limits = [&] {
    limits.clear();
    for (const Group& group : all.groups) limits.push_back(limit_of(all, group, settings.numerics));
  };
  find_limits();
  if (local_steps.may_part() && local_steps.choose(limits)) find_limits();
  limits_known = true;
  BodyLimit worst;
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    BodyLimit limit = limits[g];
    if (all.groups[g].fast) limit.step *= LocalSteps::most_substeps;
    if (limit.step < worst.step) worst = limit;
  }
  StepLimit limit;
  limit.step = worst.step;
  limit.criterion = worst.criterion;
  limit.particle = all.particles.id[worst.particle];
  limit.position = place_of(all.particles, worst.particle);
  limit.body = body_of(all, worst.particle).name;
  if (settings.numerics.fixed_step) {
    limit.step = *settings.numerics.fixed_step;
    limit.criterion = "fixed";
  }
  return limit;
}

double Fluid::Implementation::fall() const {
  const Particles& p = all.particles;
  const Vec3& g = settings.gravity;
  if (g.isZero()) return 0.0;
  return blocked_sum<double>(0, std::uint32_t(p.size()),
                             [&](std::uint32_t i) { return p.mass[i] * (g[0] * p.x[i] + g[1] * p.y[i] + g[2] * p.z[i]); });
}

double Fluid::Implementation::volume() const {
  const Particles& p = all.particles;
  if (settings.surroundings.pressure == 0.0) return 0.0;
  return blocked_sum<double>(0, std::uint32_t(p.size()), [&](std::uint32_t i) { return p.mass[i] / p.rho[i]; });
}

Ledger Fluid::Implementation::ledger() const {
  const Particles& p = all.particles;
  struct Part {
    double kinetic = 0, internal = 0, mass = 0;
    double momentum[3] = {0, 0, 0};
    void operator+=(const Part& o) {
      kinetic += o.kinetic;
      internal += o.internal;
      mass += o.mass;
      for (int a = 0; a < 3; ++a) momentum[a] += o.momentum[a];
    }
  };
  Ledger ledger;
  for (const Group& group : all.groups) {
    const materials::FluidLaw& law = group.body->material.law;
    const bool with_energy = materials::uses_energy(law);
    const Part part = blocked_sum<Part>(group.begin, group.end, [&](std::uint32_t i) {
      Part one;
      one.mass = p.mass[i];
      one.kinetic = 0.5 * p.mass[i] * (p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
      one.internal = p.mass[i] * (with_energy ? p.energy[i] : materials::barotropic_energy(law, p.rho[i]));
      one.momentum[0] = p.mass[i] * p.vx[i];
      one.momentum[1] = p.mass[i] * p.vy[i];
      one.momentum[2] = p.mass[i] * p.vz[i];
      return one;
    });
    ledger.kinetic += part.kinetic;
    ledger.internal += part.internal;
    ledger.mass += part.mass;
    for (int a = 0; a < 3; ++a) ledger.momentum[a] += part.momentum[a];
  }
  ledger.dissipated = exchange.dissipated;
  ledger.wall_work = exchange.wall_work;
  ledger.radiated = exchange.radiated;
  ledger.radiated_momentum = radiating.momentum();
  ledger.gravity = fall() - lifted;
  ledger.surroundings = settings.surroundings.pressure * (filled - volume());
  return ledger;
}

void BodyTotals::operator+=(const BodyTotals& other) {
  mass += other.mass;
  volume += other.volume;
  kinetic += other.kinetic;
  internal += other.internal;
  pressure_volume += other.pressure_volume;
  cavitated += other.cavitated;
  voids += other.voids;
  moment += other.moment;
  momentum += other.momentum;
}

std::vector<BodyTotals> Fluid::Implementation::totals() const {
  const Particles& p = all.particles;
  const double around = settings.surroundings.pressure;
  std::vector<BodyTotals> all_totals;
  for (const Group& group : all.groups)
    std::visit(
        [&](const auto& law) {
          using Law = std::remove_cvref_t<decltype(law)>;
          all_totals.push_back(blocked_sum<BodyTotals>(group.begin, group.end, [&](std::uint32_t i) {
            BodyTotals one;
            const Vec3 v(p.vx[i], p.vy[i], p.vz[i]);
            one.mass = p.mass[i];
            one.volume = p.mass[i] / p.rho[i];
            one.kinetic = 0.5 * p.mass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            if constexpr (Law::uses_energy) one.internal = p.mass[i] * p.energy[i];
            else one.internal = p.mass[i] * law.barotropic_energy(p.rho[i]);
            one.pressure_volume = one.volume * (p.predicted[i].p + around);
            if constexpr (!Law::is_gas)
              if (const double share = law.void_fraction(p.rho[i]); share > 0) {
                one.cavitated = one.volume;
                one.voids = share * one.volume;
              }
            one.moment = p.mass[i] * place_of(p, i);
            one.momentum = p.mass[i] * v;
            return one;
          }));
        },
        group.body->material.law);
  return all_totals;
}

std::vector<LargestOf> Fluid::Implementation::largest_of_bodies() const {
  struct Both {
    Largest pressure, speed;  // of the latter the square
    void operator+=(const Both& other) {
      pressure += other.pressure;
      speed += other.speed;
    }
  };
  const Particles& p = all.particles;
  constexpr std::uint32_t block = 4096;
  std::vector<LargestOf> all_largest;
  for (const Group& group : all.groups) {
    // A block at a time, so that one place a block is looked up and copied.
    const std::uint32_t blocks = (group.end - group.begin + block - 1) / block;
    Both both = blocked_sum<Both>(0, blocks, [&](std::uint32_t b) {
      const std::uint32_t from = group.begin + b * block, to = std::min(group.end, from + block);
      Both most;
      for (std::uint32_t i = from; i < to; ++i) {
        const auto place = [&] { return place_of(p, i); };
        most.pressure.take(p.predicted[i].p, p.id[i], place);
        most.speed.take(p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i], p.id[i], place);
      }
      return most;
    });
    both.pressure.value += settings.surroundings.pressure;
    both.speed.value = std::sqrt(std::max(0.0, both.speed.value));
    all_largest.push_back({group.body->name, {{"pressure", both.pressure}, {"speed", both.speed}}});
  }
  return all_largest;
}

template <class Visit>
void Fluid::Implementation::around(const Vec3& point, double radius_over_h, Visit visit) const {
  for (const Group& group : all.groups) {
    if (group.cells.order().empty()) continue;
    const CellGrid grid = group.cells.view();
    const double reach = radius_over_h * group.h_max;
    for (int image = 0; image < 8; ++image) {
      Vec3 at = point;
      bool wanted = true;
      for (int a = 0; a < 3; ++a)
        if (image >> a & 1) {
          wanted = wanted && settings.symmetry.axis[a] && point[a] < reach;
          at[a] = -at[a];
        }
      if (!wanted) continue;
      int first[3], last[3];
      for (int a = 0; a < 3; ++a) {
        first[a] = std::max(0, int(std::floor((at[a] - reach - grid.low[a]) / grid.size[a])));
        last[a] = std::min(grid.count[a] - 1, int(std::floor((at[a] + reach - grid.low[a]) / grid.size[a])));
      }
      for (int iz = first[2]; iz <= last[2]; ++iz)
        for (int iy = first[1]; iy <= last[1]; ++iy)
          for (int ix = first[0]; ix <= last[0]; ++ix) {
            const std::size_t cell = (std::size_t(iz) * grid.count[1] + iy) * grid.count[0] + ix;
            for (std::uint32_t i = grid.start[cell]; i < grid.start[cell + 1]; ++i) {
              const double r = (place_of(all.particles, i) - at).norm();
              if (r < radius_over_h * all.particles.predicted[i].h && all.images.sight().sees(at, place_of(all.particles, i)))
                visit(i, r, group, image);
            }
          }
    }
  }
}

FluidPoint Fluid::Implementation::at(const Vec3& point) const {
  const double shrink = 1.2 / settings.numerics.eta;
  FluidPoint values;
  double weight = 0;
  around(point, WendlandC2::support * shrink, [&](std::uint32_t i, double r, const Group& group, int image) {
    const FluidRow& q = all.particles.predicted[i];
    const double size = settings.axisymmetric ? q.vz : q.volume;  // of a ring its area
    const double w = size * value<WendlandC2>(r, shrink * q.h, settings.dimension);
    weight += w;
    values.pressure += w * (q.p + settings.surroundings.pressure);
    values.density += w * q.rho;
    values.void_fraction += w * std::visit([&](const auto& law) { return law.void_fraction(q.rho); }, group.body->material.law);
    const double v[3] = {q.vx, q.vy, settings.axisymmetric ? 0.0 : q.vz};
    for (int a = 0; a < 3; ++a) values.velocity[a] += w * (image >> a & 1 ? -v[a] : v[a]);
    ++values.neighbours;
  });
  if (weight > 0) {
    values.pressure /= weight;
    values.density /= weight;
    values.void_fraction /= weight;
    values.velocity /= weight;
  }
  return values;
}

std::vector<double> Fluid::Implementation::field(std::string_view name) const {
  const Particles& p = all.particles;
  const std::size_t n = p.size();
  std::vector<double> out(n);
  const auto scalar = [&](auto f) {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) out[i] = f(i);
  };
  if (name == "pressure") {
    scalar([&](std::size_t i) { return p.predicted[i].p + settings.surroundings.pressure; });
  } else if (name == "sound_speed") {
    scalar([&](std::size_t i) { return p.predicted[i].c; });
  } else if (name == "smoothing_length") {
    scalar([&](std::size_t i) { return p.predicted[i].h; });
  } else if (name == "void_fraction" || name == "material" || name == "energy") {
    for (std::size_t g = 0; g < all.groups.size(); ++g) {
      const Group& group = all.groups[g];
      const materials::FluidLaw& law = group.body->material.law;
      for (std::uint32_t i = group.begin; i < group.end; ++i)
        out[i] = name == "material"            ? double(g)
                 : name == "void_fraction"     ? std::visit([&](const auto& l) { return l.void_fraction(p.rho[i]); }, law)
                 : materials::uses_energy(law) ? p.energy[i]
                                               : materials::barotropic_energy(law, p.rho[i]);
    }
  } else if (!p.copy(name, out)) {
    throw std::invalid_argument("no particle field is named '" + std::string(name) + "'");
  }
  return out;
}

}  // namespace undex::sph
