#include "sph_fluid/water/local_steps.hpp"

#include <algorithm>
#include <cmath>

namespace undex::sph {
namespace {

/// Ratio of the steps from which bodies part, and below which they join again: each change costs an evaluation.
constexpr double part_at = 2.0, join_at = 1.6;
/// What a near particle costs in a substep in terms of a particle in a step, and the least gain that is worth a change.
constexpr double near_cost = 1.2, least_gain = 1.15;

/// The box of a group's particles.
void add_group(const ParticleSet& set, const Group& group, Bounds& box) {
  for (std::uint32_t i = group.begin; i < group.end; ++i) box.include(place_of(set.particles, i));
}

/// Cells as wide as the reach about a box: those of fast particles and their neighbours hold all whom a fast one may meet.
class MarkedCells {
 public:
  MarkedCells(const Bounds& box, double width) : low_(box.low), cell_(width) {
    for (;; cell_ *= 1.5) {
      double cells = 1;
      for (int a = 0; a < 3; ++a) {
        count_[a] = int(std::min((box.high[a] - box.low[a]) / cell_, 1e6)) + 3;
        cells *= count_[a];
      }
      if (cells <= 1e6) break;
    }
    marked_.assign(std::size_t(count_[0]) * count_[1] * count_[2], 0);
  }

  /// Marks the cell of x and its neighbours.
  void mark(const Vec3& x) {
    int at[3];
    if (!cell_of(x, at)) return;
    int first[3], last[3];
    for (int a = 0; a < 3; ++a) first[a] = std::max(0, at[a] - 1), last[a] = std::min(count_[a] - 1, at[a] + 1);
    for (int iz = first[2]; iz <= last[2]; ++iz)
      for (int iy = first[1]; iy <= last[1]; ++iy)
        for (int ix = first[0]; ix <= last[0]; ++ix) marked_[number(ix, iy, iz)] = 1;
  }
  bool holds(const Vec3& x) const {
    int at[3];
    return cell_of(x, at) && marked_[number(at[0], at[1], at[2])];
  }

 private:
  std::size_t number(int ix, int iy, int iz) const { return (std::size_t(iz) * count_[1] + iy) * count_[0] + ix; }
  bool cell_of(const Vec3& x, int at[3]) const {
    for (int a = 0; a < 3; ++a) {
      const double c = std::floor((x[a] - low_[a]) / cell_) + 1.0;
      if (!(c >= 0.0 && c < count_[a])) return false;
      at[a] = int(c);
    }
    return true;
  }

  Vec3 low_;
  double cell_;
  int count_[3];
  std::vector<char> marked_;
};

}  // namespace

bool LocalSteps::may_part() const {
  const Numerics& n = water_.settings.numerics;
  return n.local_steps && n.integrator == Integrator::leapfrog && !n.fixed_step && water_.all.groups.size() > 1;
}

std::vector<char> LocalSteps::best_fast_bodies(const std::vector<BodyLimit>& limits) const {
  const ParticleSet& all = water_.all;
  std::vector<std::size_t> order;
  for (std::size_t g = 0; g < all.groups.size(); ++g)
    if (all.groups[g].begin < all.groups[g].end) order.push_back(g);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return limits[a].step < limits[b].step; });
  const double least = limits[order[0]].step, count = double(all.particles.size());
  std::size_t fast_count = 0;
  double best = parted() ? 1.0 : least_gain;
  for (std::size_t m = 1; m < order.size(); ++m) {
    const double ratio = limits[order[m]].step / least;
    if (ratio < (parted() ? join_at : part_at)) continue;
    double near_count = 0;
    Bounds box;
    for (std::size_t k = 0; k < m; ++k) {
      const Group& group = all.groups[order[k]];
      near_count += group.end - group.begin;
      add_group(all, group, box);
    }
    for (std::size_t k = m; k < order.size(); ++k)
      for (std::uint32_t i = all.groups[order[k]].begin; i < all.groups[order[k]].end; ++i)
        near_count += box.distance(place_of(all.particles, i)) < all.reach;
    const double substeps = std::ceil(std::min(ratio, double(most_substeps)));
    const double gain = std::min(ratio, substeps) * count / (count + substeps * near_cost * near_count);
    if (gain > best) {
      best = gain;
      fast_count = m;
    }
  }
  std::vector<char> fast(all.groups.size(), 0);
  for (std::size_t k = 0; k < fast_count; ++k) fast[order[k]] = 1;
  return fast;
}

bool LocalSteps::choose(const std::vector<BodyLimit>& limits) {
  ParticleSet& all = water_.all;
  const std::vector<char> fast = best_fast_bodies(limits);
  bool changed = false, any = false;
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    changed = changed || all.groups[g].fast != bool(fast[g]);
    any = any || fast[g];
  }
  if (!changed) return false;
  for (std::size_t g = 0; g < all.groups.size(); ++g) all.groups[g].fast = fast[g];
  all.last_step = 0;
  near_ = {};
  all.choice = any ? PairChoice::slow : PairChoice::all;
  all.particles.other.assign(any ? all.particles.size() : 0, {});
  all.particles.start = {};
  water_.evaluate_or_stop(all, {.time = water_.clock.time});
  if (any) evaluate_both();
  return true;
}

/// The near set's rates, beside those of the whole.
void LocalSteps::evaluate_both() {
  gather(0.0);
  water_.evaluate_or_stop(near_, {.time = water_.clock.time});
  scatter();
  wall_force_ = sum_of(water_.all.wall_force, near_.wall_force);
}

void LocalSteps::step(double dt) {
  ParticleSet& all = water_.all;
  const double bend = bend_of(dt, all.last_step);
  const std::vector<WallMotion> before = water_.walls_seen, after = water_.walls.motions();
  {
    const auto timer = water_.timers.measure("integration");
    water_.require(water_.half_kick(all, dt), all);
  }
  gather(dt);
  {
    const auto timer = water_.timers.measure("integration");
    water_.drift(all, dt);
  }
  take_substeps(dt, bend, before, after);
  scatter();
  water_.cross_mirrors(all);
  if (near_.meets_walls) water_.walls.show(after);
  water_.evaluate_or_stop(all, {.time = water_.clock.time + dt, .half = 0.5 * dt, .bend = bend, .whole = true});
  const auto timer = water_.timers.measure("integration");
  water_.half_kick(all, dt);
  wall_force_ = sum_of(all.wall_force, near_.wall_force);
}

void LocalSteps::take_substeps(double dt, double bend, const std::vector<WallMotion>& before,
                               const std::vector<WallMotion>& after) {
  const double start = water_.clock.time;
  for (double done = 0; done < dt * (1 - 1e-12); ++substeps_) {
    const double h = substep(dt - done);
    {
      const auto timer = water_.timers.measure("integration");
      water_.require(water_.half_kick(near_, h), near_);
      water_.drift(near_, h);
      water_.cross_mirrors(near_);
    }
    done += h;
    if (near_.meets_walls) water_.walls.show_between(before, after, dt, done / dt);
    water_.evaluate_or_stop(near_, {.time = start + done,
                                    .half = 0.5 * h,
                                    .bend = bend_of(h, near_.last_step),
                                    .slow_half = done - 0.5 * dt,
                                    .slow_bend = bend * (done / dt) * (done / dt)});
    const auto timer = water_.timers.measure("integration");
    water_.half_kick(near_, h);
    near_.last_step = h;
  }
}

double LocalSteps::substep(double left) const {
  double limit = std::numeric_limits<double>::infinity();
  for (const Group& group : near_.groups)
    if (group.fast) limit = std::min(limit, limit_of(near_, group, water_.settings.numerics).step);
  return left / std::ceil(left / limit - 1e-9);
}

void LocalSteps::begin_near_set() {
  near_ = {};
  near_.groups = water_.all.groups;
  near_.choice = PairChoice::fast;
  near_.wall_force = water_.walls.unloaded();
}

void LocalSteps::gather(double dt) {
  const auto timer = water_.timers.measure("local steps");
  const ParticleSet& all = water_.all;
  const Particles& p = all.particles;
  Bounds box;
  for (const Group& group : all.groups)
    if (group.fast) add_group(all, group, box);
  double fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) fastest = std::max(fastest, std::hypot(p.vx[i], p.vy[i], p.vz[i]));
  // Until the next choice particles move, and the smoothing length of gas may grow.
  const double width = 1.25 * all.reach + 2.0 * dt * fastest;
  MarkedCells cells(box, width);
  for (const Group& group : all.groups)
    if (group.fast)
      for (std::uint32_t i = group.begin; i < group.end; ++i) cells.mark(place_of(p, i));

  if (near_.groups.size() != all.groups.size()) begin_near_set();
  std::vector<std::uint32_t>& place = near_.particles.place;
  place.clear();
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    Group& group = near_.groups[g];
    group.begin = std::uint32_t(place.size());
    for (std::uint32_t i = all.groups[g].begin; i < all.groups[g].end; ++i)
      if (group.fast || cells.holds(place_of(p, i))) place.push_back(i);
    group.end = std::uint32_t(place.size());
    group.h_max = all.groups[g].h_max;
  }
  near_.images.forget();
  near_.particles.gather(p);
  near_.meets_walls = !water_.walls.mirrors.empty() || water_.evaluation.lining().reaches(box.low, box.high, width);
}

void LocalSteps::scatter() {
  const auto timer = water_.timers.measure("local steps");
  near_.particles.scatter(water_.all.particles);
}

void LocalSteps::join() {
  ParticleSet& all = water_.all;
  for (Group& group : all.groups) group.fast = false;
  all.choice = PairChoice::all;
  near_ = {};
  all.particles.other = {};
  all.particles.start = {};
  all.last_step = 0;
}

void LocalSteps::visit_state(StateVisitor& state) {
  state("substeps", substeps_);
  if (!parted()) return;
  if (state.restores()) {
    begin_near_set();
    wall_force_ = water_.walls.unloaded();
  }
  state.part("near", [&] { near_.visit_loads(state); });
  state.part("wall force", [&] { wall_force_.visit_state(state); });
}

}  // namespace undex::sph
