// Local steps: bodies whose stable step is much shorter than the others' ("fast") take several substeps in one step of the
// rest ("slow"). An impulse method of Tuckerman, Berne, Martyna 1992, J. Chem. Phys. 97, doi 10.1063/1.463137, split by pairs:
// what two slow particles (or a slow one and a wall) give each other acts in two halves about the step; every pair with a fast
// particle is evaluated at every substep and acts on both its partners with the substep. Each pair's exchange therefore has one
// step on both sides, and mass, momentum and energy are conserved as with one step for all.
//   slow half kick (Dt);  { fast half kick (dt), drift, fast pairs, fast half kick (dt) } x n;  slow pairs, slow half kick (Dt)
// In the substeps the fast particles stand in a set of their own, with the slow ones near them; the passes are those of a step.
// The slow half kick comes before the substeps: what fast pairs see of a slow partner's velocity and density is therefore
// corrected to its time t of 0..Dt by (t - Dt/2) R + B (t/Dt)^2 (R - R_before), R being the rate from slow pairs and B the
// leapfrog's bend: at t = Dt that is the state predicted for the end of the step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sph_fluid/water/solver.hpp"

namespace undex::sph {
namespace {

/// Ratio of the steps from which bodies part, and below which they join again: each change costs an evaluation.
constexpr double part_at = 2.0, join_at = 1.6;
/// What a near particle costs in a substep in terms of a particle in a step, and the least gain that is worth a change.
constexpr double near_cost = 1.2, least_gain = 1.15;

double distance_to_box(const Vec3& x, const Vec3& low, const Vec3& high) {
  return (low - x).cwiseMax(x - high).cwiseMax(0.0).norm();
}

/// Puts a set of particles in the place of all, for the passes to work on, and back again.
class InHand {
 public:
  InHand(ParticleSet& all, ParticleSet& set) : all_(all), set_(set) { std::swap(all_, set_); }
  ~InHand() { std::swap(all_, set_); }
  InHand(const InHand&) = delete;
  InHand& operator=(const InHand&) = delete;

 private:
  ParticleSet &all_, &set_;
};

}  // namespace

bool Fluid::Implementation::choose_fast_bodies(const std::vector<BodyLimit>& limits) {
  std::vector<std::size_t> order;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].begin < groups[g].end) order.push_back(g);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return limits[a].step < limits[b].step; });
  const bool parted = choice == PairChoice::slow;
  const double least = limits[order[0]].step, all = double(particles.size());
  std::size_t fast_count = 0;
  double best = parted ? 1.0 : least_gain;
  for (std::size_t m = 1; m < order.size(); ++m) {
    const double ratio = limits[order[m]].step / least;
    if (ratio < (parted ? join_at : part_at)) continue;
    double near_count = 0;
    Disturbed box;
    for (std::size_t k = 0; k < m; ++k) {
      const Group& group = groups[order[k]];
      near_count += group.end - group.begin;
      for (std::uint32_t i = group.begin; i < group.end; ++i) box.add({particles.x[i], particles.y[i], particles.z[i]});
    }
    for (std::size_t k = m; k < order.size(); ++k)
      for (std::uint32_t i = groups[order[k]].begin; i < groups[order[k]].end; ++i)
        near_count += distance_to_box({particles.x[i], particles.y[i], particles.z[i]}, box.low, box.high) < reach;
    const double substeps = std::ceil(std::min(ratio, double(most_substeps)));
    const double gain = std::min(ratio, substeps) * all / (all + substeps * near_cost * near_count);
    if (gain > best) {
      best = gain;
      fast_count = m;
    }
  }
  std::vector<char> fast(groups.size(), 0);
  for (std::size_t k = 0; k < fast_count; ++k) fast[order[k]] = 1;
  bool changed = false;
  for (std::size_t g = 0; g < groups.size(); ++g) changed = changed || groups[g].fast != bool(fast[g]);
  if (!changed) return false;

  for (std::size_t g = 0; g < groups.size(); ++g) groups[g].fast = fast[g];
  last_step = last_substep = 0;
  near = {};
  choice = fast_count > 0 ? PairChoice::slow : PairChoice::all;
  particles.other.assign(fast_count > 0 ? particles.size() : 0, {});
  particles.start = {};
  evaluate(0.0, 0.0);
  require(sound);
  if (fast_count == 0) return true;
  gather_near(0.0);
  {
    const InHand near_set(*this, near);
    evaluate(0.0, 0.0);
    require(sound);
  }
  scatter_near();
  add_wall_forces();
  return true;
}

void Fluid::Implementation::step_local(double dt) {
  const double bend = bend_of(dt, last_step);
  const std::vector<WallMotion> walls_before = walls_seen, walls_after = wall_motions();
  {
    const auto timer = timers.measure("integration");
    require(half_kick(dt));
  }
  gather_near(dt);
  {
    const auto timer = timers.measure("integration");
    drift(dt);
  }
  {
    const InHand near_set(*this, near);
    for (double done = 0; done < dt * (1 - 1e-12); ++substeps) {
      double limit = std::numeric_limits<double>::infinity();
      for (const Group& group : groups)
        if (group.fast) limit = std::min(limit, limit_of(group).step);
      const double left = dt - done, h = left / std::ceil(left / limit - 1e-9);
      {
        const auto timer = timers.measure("integration");
        require(half_kick(h));
        drift(h);
        cross_mirrors();
      }
      done += h;
      evaluation_time = time + done;
      slow_ahead = done - 0.5 * dt;
      slow_bend = bend * (done / dt) * (done / dt);
      if (near_walls)
        for (std::size_t w = 0; w < moving.size(); ++w) show(moving[w], between(walls_before[w], walls_after[w], dt, done / dt));
      evaluate(0.5 * h, bend_of(h, last_substep));
      require(sound);
      const auto timer = timers.measure("integration");
      half_kick(h);
      last_substep = h;
    }
    slow_ahead = slow_bend = 0;
  }
  scatter_near();
  cross_mirrors();
  if (near_walls)
    for (std::size_t w = 0; w < moving.size(); ++w) show(moving[w], walls_after[w]);
  evaluation_time = time + dt;
  evaluate(0.5 * dt, bend);
  require(sound);
  const auto timer = timers.measure("integration");
  half_kick(dt);
  add_wall_forces();
}

void Fluid::Implementation::add_wall_forces() {
  whole_force = moving_force;
  for (std::size_t w = 0; w < moving.size(); ++w)
    for (std::size_t k = 0; k < whole_force[w].size(); ++k) whole_force[w][k] += near.moving_force[w][k];
}

void Fluid::Implementation::gather_near(double dt) {
  const auto timer = timers.measure("local steps");
  const Particles& p = particles;
  Disturbed box;
  double fastest = 0;
  for (const Group& group : groups)
    if (group.fast)
      for (std::uint32_t i = group.begin; i < group.end; ++i) box.add({p.x[i], p.y[i], p.z[i]});
  for (std::size_t i = 0; i < p.size(); ++i) fastest = std::max(fastest, std::hypot(p.vx[i], p.vy[i], p.vz[i]));
  // Until the next choice particles move, and the smoothing length of gas may grow.
  const double width = 1.25 * reach + 2.0 * dt * fastest;

  // Cells as wide as the reach: those of fast particles and their neighbours hold all whom a fast one may meet.
  double cell = width;
  int count[3];
  for (;; cell *= 1.5) {
    double cells = 1;
    for (int a = 0; a < 3; ++a) {
      count[a] = int(std::min((box.high[a] - box.low[a]) / cell, 1e6)) + 3;
      cells *= count[a];
    }
    if (cells <= 1e6) break;
  }
  const auto cell_of = [&](std::uint32_t i, int at[3]) {
    const double x[3] = {p.x[i], p.y[i], p.z[i]};
    for (int a = 0; a < 3; ++a) {
      const double c = std::floor((x[a] - box.low[a]) / cell) + 1.0;
      if (!(c >= 0.0 && c < count[a])) return false;
      at[a] = int(c);
    }
    return true;
  };
  std::vector<char> marked(static_cast<std::size_t>(count[0]) * count[1] * count[2], 0);
  const auto flag = [&](int ix, int iy, int iz) -> char& { return marked[(std::size_t(iz) * count[1] + iy) * count[0] + ix]; };
  int at[3];
  for (const Group& group : groups)
    if (group.fast)
      for (std::uint32_t i = group.begin; i < group.end; ++i)
        if (cell_of(i, at))
          for (int z = std::max(0, at[2] - 1); z <= std::min(count[2] - 1, at[2] + 1); ++z)
            for (int y = std::max(0, at[1] - 1); y <= std::min(count[1] - 1, at[1] + 1); ++y)
              for (int x = std::max(0, at[0] - 1); x <= std::min(count[0] - 1, at[0] + 1); ++x) flag(x, y, z) = 1;

  if (near.groups.size() != groups.size()) {
    near.groups = groups;
    near.choice = PairChoice::fast;
    for (const std::vector<Vec3>& force : moving_force) near.moving_force.emplace_back(force.size(), Vec3::Zero());
  }
  std::vector<std::uint32_t>& place = near.particles.place;
  place.clear();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Group& group = near.groups[g];
    group.begin = std::uint32_t(place.size());
    for (std::uint32_t i = groups[g].begin; i < groups[g].end; ++i)
      if (group.fast || (cell_of(i, at) && flag(at[0], at[1], at[2]))) place.push_back(i);
    group.end = std::uint32_t(place.size());
    group.h_max = groups[g].h_max;
  }
  near.images.forget();
  near.particles.gather(p);

  near_walls = std::any_of(moving.begin(), moving.end(), [](const MovingWall& wall) { return !wall.mesh.empty(); });
  for (std::size_t k = 0; k < wall_origin.size() && !near_walls; ++k)
    near_walls = distance_to_box({wall_place[0][k], wall_place[1][k], wall_place[2][k]}, box.low, box.high) < width;
}

void Fluid::Implementation::scatter_near() {
  const auto timer = timers.measure("local steps");
  near.particles.scatter(particles);
}

void Fluid::Implementation::join() {
  for (Group& group : groups) group.fast = false;
  choice = PairChoice::all;
  near = {};
  particles.other = {};
  particles.start = {};
  last_step = 0;
}

}  // namespace undex::sph
