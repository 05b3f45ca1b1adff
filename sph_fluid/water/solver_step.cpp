// The passes of a step, in the order in which evaluate() and step() call them.
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "sph_fluid/lattice.hpp"
#include "sph_fluid/water/solver.hpp"
#include "sph_fluid/pairs/sums.hpp"

namespace undex::sph {
namespace {

/// Density after half a step: rho exp(D dt) to third order in D dt, positive however large the rate.
double advanced_density(double rho, double rate_times_step) {
  const double s = std::clamp(0.5 * rate_times_step, -0.5, 0.5);
  return rho * (1.0 + s) / (1.0 - s);
}

}  // namespace

void Fluid::Implementation::step(double dt) {
  if (!evaluated || (may_part() && !limits_known)) step_limit();
  if (settings.numerics.integrator == Integrator::ssp_rk3 || choice != PairChoice::all) step_or_stay(dt);
  else step_leapfrog(dt);
  time += dt;
  last_step = dt;
  ++steps;
  limits_known = false;
}

void Fluid::Implementation::step_leapfrog(double dt) {
  {
    const auto timer = timers.measure("integration");
    if (!half_kick(dt)) {
      const std::string what = what_is_wrong();
      half_kick(-dt);
      throw NumericalStop(what);
    }
    drift(dt);
    cross_mirrors();
  }
  evaluation_time = time + dt;
  evaluate(0.5 * dt, bend_of(dt, last_step));
  if (!sound) {
    const std::string what = what_is_wrong();
    stand_half_way(dt);
    throw NumericalStop(what);
  }
  const auto timer = timers.measure("integration");
  half_kick(dt);
}

void Fluid::Implementation::step_or_stay(double dt) {
  const std::vector<WallMotion> walls = wall_motions();
  const Exchange booked = exchange();
  particles.keep_start();
  try {
    if (settings.numerics.integrator == Integrator::ssp_rk3) step_ssp_rk3(dt);
    else step_local(dt);
  } catch (const NumericalStop&) {
    particles.restore_start();
    cross_mirrors();
    dissipated = booked.dissipated;
    wall_work = booked.wall_work;
    for (std::size_t w = 0; w < moving.size(); ++w) {
      show(moving[w], walls[w]);
      moving[w].impulse = booked.impulse[w];
    }
    evaluation_time = time;
    if (choice != PairChoice::all) join();
    stand_still();
    throw;
  }
}

Exchange Fluid::Implementation::exchange() const {
  Exchange booked{dissipated, wall_work, {}};
  for (const MovingWall& wall : moving) booked.impulse.push_back(wall.impulse);
  return booked;
}

void Fluid::Implementation::evaluate(double half, double bend) {
  omp_set_num_threads(threads);  // another fluid of this process may have asked for another number
  sort();
  equation_of_state(half, bend);
  particles.turn_rates();
  pack_walls();
  find_images();
  pairs(pair_input());
  wall_forces();
  finish_rates();
  if (settings.numerics.integrator == Integrator::ssp_rk3 || choice == PairChoice::slow) walls_seen = wall_motions();
  evaluated = true;
}

// ---- The passes of a step -------------------------------------------------------------------------------------------

void Fluid::Implementation::drift(double dt) {
  Particles& p = particles;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.x[i] += dt * p.vx[i];
    p.y[i] += dt * p.vy[i];
    p.z[i] += dt * p.vz[i];
  }
}

void Fluid::Implementation::cross_mirrors() {
  Particles& p = particles;
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
  std::vector<std::vector<Vec3>> received;
  for (const MovingWall& wall : moving) received.emplace_back(wall.position.size(), Vec3::Zero());
  wall_work += images.put_back(settings, slip_walls, moving, p, received);
  for (std::size_t w = 0; w < moving.size(); ++w)
    if (!moving[w].mesh.empty())
      for (std::size_t n = 0; n < received[w].size(); ++n) moving[w].impulse[n] += received[w][n];
}

bool Fluid::Implementation::half_kick(double dt) {
  const double half = 0.5 * dt;
  Particles& p = particles;
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
  if (!p.viscosity.empty()) advance_viscosity(half);
  book_exchange(half);
  return largest_square < fastest * fastest;
}

void Fluid::Implementation::book_exchange(double duration) {
  const Particles& p = particles;
  // Heat counts as dissipated where no energy field takes it up.
  for (const Group& group : groups)
    if (!materials::uses_energy(group.body->material.law))
      dissipated +=
          duration * blocked_sum<double>(group.begin, group.end, [&](std::uint32_t i) { return p.mass[i] * p.rate[i].heat; });
  for (std::size_t w = 0; w < moving.size(); ++w)
    for (std::size_t k = 0; k < moving_force[w].size(); ++k) moving[w].impulse[k] += duration * moving_force[w][k];
  wall_work += duration * wall_power;
}

void Fluid::Implementation::stand_half_way(double dt) {
  drift(-0.5 * dt);
  cross_mirrors();
  time += 0.5 * dt;
  evaluation_time = time;
  stand_still();
}

void Fluid::Implementation::stand_still() {
  std::fill(particles.rate.begin(), particles.rate.end(), SumRow{});
  sort();
  equation_of_state(0.0, 0.0);
}

Fluid::Implementation::SwitchRates Fluid::Implementation::switch_rates(std::uint32_t i) const {
  const FluidRow& q = particles.predicted[i];
  double compression = particles.rate[i].compression;
  if (!particles.other.empty()) compression += particles.other[i].rate.compression;
  return {0.2 * q.c / q.h, std::max(compression, 0.0)};
}

void Fluid::Implementation::advance_viscosity(double dt) {
  const double low = settings.numerics.alpha_min, high = settings.numerics.alpha;
  for (const Group& group : groups) {
    if (choice != PairChoice::all && group.fast != (choice == PairChoice::fast)) continue;  // each with its own step
#pragma omp parallel for schedule(static)
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const auto [decay, source] = switch_rates(i);
      // Linear in alpha: its solution stays within the bounds for any step.
      const double goal = (decay * low + source * high) / (decay + source);
      double& alpha = particles.viscosity[i].alpha;
      alpha = goal + (alpha - goal) * std::exp(-(decay + source) * dt);
    }
  }
}

void Fluid::Implementation::sort() {
  const auto timer = timers.measure("sort");
  images.forget();
  views.clear();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Group& group = groups[g];
    try {
      group.cells.build(particles.x.data(), particles.y.data(), particles.z.data(), group.begin, group.end,
                        2.0 * group.spacing * (group.body->variable_h ? group.h_max / group.h0 : 1.0));
    } catch (const std::domain_error&) {
      throw NumericalStop(what_is_wrong());
    }
    particles.permute(group.begin, group.cells.order());
  }
}

void Fluid::Implementation::equation_of_state(double half, double bend) {
  const auto timer = timers.measure("equation of state");
  double h_max = 0;
  for (Group& group : groups) {
    std::visit([&](const auto& law) { evaluate_group(law, group, half, bend); }, group.body->material.law);
    views.push_back({group.begin, group.end, group.cells.view(), group.h_max, group.body->variable_h, group.body->variable_h,
                     group.material, group.fast});
    h_max = std::max(h_max, group.h_max);
  }
  reach = loops.support * h_max;
  blocks.build(views, reach);
  find_signals();
}

template <class Law>
void Fluid::Implementation::evaluate_group(const Law& law, Group& group, double half, double bend) {
  Particles& p = particles;
  const bool variable = group.body->variable_h;
  const double inverse_dimension = 1.0 / settings.dimension, cell = std::pow(group.spacing, settings.dimension);
  const double low = settings.numerics.h_low, high = settings.numerics.h_high;
  const bool burning = group.body->burn.has_value();
  const bool beside = choice == PairChoice::fast && !group.fast;
  const Vec3& gravity = settings.gravity;
  double h_max = variable ? 0.0 : group.h0;
  long held = 0, empty = 0;
#pragma omp parallel for schedule(static) reduction(max : h_max) reduction(+ : held, empty)
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const SumRow& rate = p.rate[i];
    const EarlierRates earlier = p.earlier.empty() ? EarlierRates{} : p.earlier[i];
    double energy = has_energy ? p.energy[i] + half * rate.heat : 0.0;
    FluidRow& q = p.predicted[i];
    q.vx = p.vx[i] + half * rate.fx + bend * (rate.fx - earlier.ax);
    q.vy = p.vy[i] + half * rate.fy + bend * (rate.fy - earlier.ay);
    q.vz = p.vz[i] + half * rate.fz + bend * (rate.fz - earlier.az);
    double rho = advanced_density(p.rho[i], half * rate.compression + bend * (rate.compression - earlier.compression));
    if (beside) {
      const auto& [more, before] = p.other[i];
      if (has_energy) energy += slow_ahead * more.heat;
      q.vx += slow_ahead * (more.fx - gravity[0]) + slow_bend * (more.fx - before.ax);
      q.vy += slow_ahead * (more.fy - gravity[1]) + slow_bend * (more.fy - before.ay);
      q.vz += slow_ahead * (more.fz - gravity[2]) + slow_bend * (more.fz - before.az);
      rho = advanced_density(rho, slow_ahead * more.compression + slow_bend * (more.compression - before.compression));
    }
    q.rho = rho;
    q.volume = p.mass[i] / rho;
    materials::PressureSound state;
    if constexpr (std::is_same_v<Law, materials::Jwl>) {
      if (burning) {
        const std::uint32_t k = p.id[i] - group.first_id;
        state = burning_state(law, group, k, rho, energy);
      } else {
        state = law.evaluate(rho, energy);
      }
    } else {
      state = law.evaluate(rho, energy);
    }
    q.p = state.pressure;
    q.c = state.sound_speed;
    // A cavity closes against liquid: with the mixture's own few m/s neither the dissipation nor the step would see
    // that coming (energy error 5 % over the closing of a cavity instead of 0.3 %).
    if constexpr (requires { law.liquid_sound(); }) q.c = std::max(q.c, law.liquid_sound());
    q.h = group.h0;
    if (variable) {
      const double wanted = std::pow(q.volume / cell, inverse_dimension);
      held += wanted < low || wanted > high;
      q.h *= std::clamp(wanted, low, high);
      h_max = std::max(h_max, q.h);
      empty += energy < 0.0;
    }
  }
  clamps.energy += empty;
  clamps.smoothing += held;
  if (group.begin < group.end) group.h_max = h_max;
}

materials::PressureSound Fluid::Implementation::burning_state(const materials::Jwl& law, const Group& group, std::uint32_t k,
                                                              double rho, double energy) const {
  const materials::ProgrammedBurn& burn = *group.body->burn;
  double fraction = 1.0;
  if (!burn.instantaneous) {
    // The front is timed from where the zone was at the start.
    const double since = evaluation_time - group.lighting[k];
    // The front lies in the middle of the ramp: particles see half of the burn from either side, and no delay.
    const double timed = burn.width > 0 ? std::clamp(0.5 + since * burn.D / burn.width, 0.0, 1.0) : since >= 0 ? 1.0 : 0.0;
    // Burn by compression is not kept once the zone expands again: kept, the maximum would climb on the unburned
    // charge's own noise until it detonates by itself.
    fraction = std::max(timed, burn.fraction(burn.origin, -1.0, rho / group.body->material.rho0));
  }
  return materials::burning(law, rho, energy, fraction);
}

void Fluid::Implementation::find_signals() {
  if (everywhere) return;
  const double signal = settings.numerics.signal;
  for (const Group& group : groups) {
    Disturbed found;
#pragma omp parallel
    {
      Disturbed mine;
#pragma omp for schedule(static)
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const FluidRow& q = particles.predicted[i];
        const double v2 = q.vx * q.vx + q.vy * q.vy + q.vz * q.vz, still = signal * q.c;
        if (v2 > still * still || std::abs(q.rho - group.rest_density) > signal * group.rest_density)
          mine.add({particles.x[i], particles.y[i], particles.z[i]});
      }
#pragma omp critical
      found.add(mine);
    }
    disturbed.add(found);
  }
}

void Fluid::Implementation::pack_walls() {
  if (walls_packed && (moving.empty() || (choice == PairChoice::fast && !near_walls))) return;
  const auto lined = [](const MovingWall& wall) { return wall.mesh.empty(); };
  if (settings.walls.empty() && std::none_of(moving.begin(), moving.end(), lined)) return;
  const auto timer = timers.measure("walls");
  // Where no wall moves they are packed once, and what they are made from is not kept.
  if (rigid.empty()) rigid = line_walls(settings);
  std::vector<WallOrigin> origin;
  std::vector<double> place[3];
  const auto wall_of = [&](const WallOrigin& o) -> const MovingWall& {
    return o.wall >= 0 ? moving[o.wall] : rigid[-1 - o.wall];
  };
  const auto add = [&](const MovingWall& wall, int index) {
    if (!wall.mesh.empty()) return;
    for (std::size_t k = 0; k < wall.position.size(); ++k) {
      origin.push_back({index, std::uint32_t(k)});
      for (int a = 0; a < 3; ++a) place[a].push_back(wall.position[k][a]);
    }
  };
  for (std::size_t w = 0; w < moving.size(); ++w) add(moving[w], int(w));
  for (std::size_t w = 0; w < rigid.size(); ++w) add(rigid[w], -1 - int(w));
  const std::uint32_t n = std::uint32_t(origin.size());
  wall_cells.build(place[0].data(), place[1].data(), place[2].data(), 0, n, 2.0 * settings.lattice.spacing);
  wall_origin.resize(n);
  for (auto& axis : wall_place) axis.resize(n);
  wall_rows.resize(n);
  wall_force.resize(moving.empty() ? 0 : n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const WallOrigin& o = wall_origin[k] = origin[wall_cells.order()[k]];
    const MovingWall& wall = wall_of(o);
    const Vec3 &x = wall.position[o.point], &v = wall.velocity[o.point], &normal = wall.normal[o.point];
    for (int a = 0; a < 3; ++a) wall_place[a][k] = x[a];
    wall_rows[k] = {v[0], v[1], v[2], normal[0], normal[1], normal[2], wall.volume[o.point], wall.slip(o.point)};
  }
  if (moving.empty()) rigid = std::vector<MovingWall>();
  walls_packed = true;
}

void Fluid::Implementation::find_images() {
  const bool meshed = std::any_of(moving.begin(), moving.end(), [](const MovingWall& wall) { return !wall.mesh.empty(); });
  if (!meshed && slip_walls.round.empty() && slip_walls.plane.empty()) return;
  const auto timer = timers.measure("walls");
  std::vector<WallImages::Range> ranges;
  std::vector<double> clear;
  for (const Group& group : groups) {
    const CellGrid grid = group.cells.view();
    Bounds box;
    box.include(Vec3(grid.bound_low[0], grid.bound_low[1], grid.bound_low[2]));
    box.include(Vec3(grid.bound_high[0], grid.bound_high[1], grid.bound_high[2]));
    clear.push_back(clearance(slip_walls, moving, box));
  }
  for (const Group& group : groups) {
    // The image of a particle at s meets particles at s' if s + s' is less than their mean reach.
    double depth = 0.0;
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g].begin < groups[g].end)
        depth = std::max(depth, 0.5 * loops.support * (group.h_max + groups[g].h_max) - clear[g]);
    ranges.push_back({group.begin, group.end, &group.cells, 2.0 * group.spacing, depth});
  }
  images.build(settings, slip_walls, moving, particles, ranges);
  images.mirror_rows(particles);
  if (images.size() == 0) return;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    GroupView view = views[g];
    view.begin = images.begin(g);
    view.end = images.begin(g + 1);
    view.grid = images.grid(g);
    view.images_of = int(g);
    if (view.begin < view.end) views.push_back(view);
  }
}

PairInput Fluid::Implementation::pair_input() {
  PairInput in{};
  in.choice = choice;
  in.partly = !everywhere;
  for (int a = 0; a < 3; ++a) {
    in.disturbed_low[a] = disturbed.low[a];
    in.disturbed_high[a] = disturbed.high[a];
  }
  // Rates are wanted within reach of the box, which takes pairs of particles within reach of those, whose fluxes take
  // gradients within reach once more.
  in.margin = loops.reconstructs() ? 3.0 * reach : 2.0 * reach;
  in.dimension = settings.dimension;
  in.kernel_scale = kernel_scale;
  in.x = particles.x.data();
  in.y = particles.y.data();
  in.z = particles.z.data();
  in.fluid = particles.predicted.data();
  in.kernel = kernel_choice(settings.numerics.kernel, settings.dimension);
  in.second = particles.second_rows();
  in.groups = views.data();
  in.group_count = int(views.size());
  images.describe(in);
  in.wall_x = wall_place[0].data();
  in.wall_y = wall_place[1].data();
  in.wall_z = wall_place[2].data();
  in.wall = wall_rows.data();
  in.wall_count = choice == PairChoice::fast && !near_walls ? 0 : std::uint32_t(wall_origin.size());
  if (in.wall_count > 0) in.wall_grid = wall_cells.view();
  for (int a = 0; a < 3; ++a) in.mirror[a] = settings.symmetry.axis[a];
  in.alpha = settings.numerics.alpha;
  in.beta = settings.numerics.beta;
  blocks.describe(in);
  in.scratch = scratch.data();
  return in;
}

void Fluid::Implementation::pairs(const PairInput& in) {
  const auto timer = timers.measure("pairs");
  interactions.resize(blocks.block_count());
  std::fill(wall_force.begin(), wall_force.end(), ForceRow{});
  const PairOutput out{particles.rate.data(), moving.empty() ? nullptr : wall_force.data(), images.sums(), interactions.data()};
  if (loops.gradients) {
    loops.gradients(in, out);
    images.mirror_gradients(particles);
  }
  loops.rates(in, out);
  for (const long long count : interactions) interaction_sum += count;
  if (loops.second != SecondRow::gradient) return;
  long held = 0;
  for (const GroupView& group : views)
    if (group.gas && group.images_of < 0 && (choice == PairChoice::all || group.fast == (choice == PairChoice::fast)))
#pragma omp parallel for schedule(static) reduction(+ : held)
      for (std::uint32_t i = group.begin; i < group.end; ++i) held += particles.gradient[i].filling <= least_filling;
  clamps.filling += held;
}

void Fluid::Implementation::finish_rates() {
  const auto timer = timers.measure("integration");
  Particles& p = particles;
  const bool partly = !everywhere;
  // With local steps gravity acts about the step, on all alike: in the substeps nobody falls past a neighbour.
  const Vec3 gravity = choice == PairChoice::fast ? Vec3(Vec3::Zero()) : settings.gravity;
  sound = true;
  for (const Group& group : groups) {
    const bool with_energy = materials::uses_energy(group.body->material.law);
    bool ok = true;
#pragma omp parallel for schedule(static) reduction(&& : ok)
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const FluidRow& q = p.predicted[i];
      SumRow& rate = p.rate[i];
      const double specific = 1.0 / q.rho;
      rate.fx = specific * rate.fx + gravity[0];
      rate.fy = specific * rate.fy + gravity[1];
      rate.fz = specific * rate.fz + gravity[2];
      rate.heat *= specific;
      if (with_energy) rate.heat += q.p * specific * rate.compression;
      ok = ok && std::isfinite(q.p + rate.fx + rate.fy + rate.fz + rate.heat + rate.compression);
      ok = ok && q.c + rate.closing < fastest;
      // Beyond reach of any signal only some of the pairs were worked on, and rest is rest.
      if (partly && !disturbed.within({p.x[i], p.y[i], p.z[i]}, reach)) rate = SumRow{};
    }
    sound = sound && ok;
  }
}

void Fluid::Implementation::wall_forces() {
  if (moving.empty() && images.size() == 0) return;
  const auto timer = timers.measure("wall forces");
  for (std::size_t w = 0; w < moving.size(); ++w) moving_force[w].assign(moving[w].position.size(), Vec3::Zero());
  wall_power = images.hand_back(particles, moving, moving_force);
  for (std::size_t k = 0; k < wall_origin.size(); ++k)
    if (wall_origin[k].wall >= 0) {
      const ForceRow& f = wall_force[k];
      const WallRow& w = wall_rows[k];
      moving_force[wall_origin[k].wall][wall_origin[k].point] = {f.fx, f.fy, f.fz};
      wall_power += f.fx * w.vx + f.fy * w.vy + f.fz * w.vz;
    }
}

}  // namespace undex::sph
