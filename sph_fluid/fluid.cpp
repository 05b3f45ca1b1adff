#include "sph_fluid/fluid.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "core/errors.hpp"
#include "sph_fluid/blocks.hpp"
#include "sph_fluid/cell_list.hpp"
#include "sph_fluid/kernels.hpp"
#include "sph_fluid/lattice.hpp"
#include "sph_fluid/pair_loop.hpp"
#include "sph_fluid/particles.hpp"
#include "sph_fluid/sums.hpp"

namespace undex::sph {
namespace {

/// What the machine (or OMP_NUM_THREADS) offers, before any fluid asks for its own number.
const int machine_threads = omp_get_max_threads();

/// A body's particles: one material, one smoothing-length policy, one range in memory.
struct Group {
  const Body* body = nullptr;
  std::uint32_t begin = 0, end = 0;
  double spacing = 0, h0 = 0;            // [m]
  double h_max = 0;                      // [m], the largest at present
  double rest_density = 0;               // [kg/m^3], of what no signal has reached
  std::vector<double> lighting;          // burning charges only, by id - begin [s]
  CellList cells;
};

double barotropic_energy(const materials::FluidLaw& law, double rho) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (std::decay_t<decltype(l)>::uses_energy)
          return 0.0;
        else
          return l.barotropic_energy(rho);
      },
      law);
}

/// Density after half a step: rho exp(D dt) to third order in D dt, positive however large the rate.
double advanced_density(double rho, double rate_times_step) {
  const double s = std::clamp(0.5 * rate_times_step, -0.5, 0.5);
  return rho * (1.0 + s) / (1.0 - s);
}

double start_density(const Body& body, double energy) {
  if (body.density) return *body.density;
  if (body.pressure) return materials::density_at(body.material.law, *body.pressure, energy);
  return body.material.rho0;
}

double start_energy(const Body& body) {
  if (body.energy) return *body.energy;
  if (const auto* jwl = std::get_if<materials::Jwl>(&body.material.law)) return jwl->parameters().E0;
  return 0.0;
}

}  // namespace

/// A box around the particles that are no longer in their first state of rest; it only grows.
struct Disturbed {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);

  void add(const Vec3& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  void add(const Disturbed& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool within(const Vec3& x, double margin) const {
    return ((low.array() - margin) <= x.array()).all() && (x.array() <= (high.array() + margin)).all();
  }
};

struct Fluid::Implementation {
  Settings settings;
  PairLoops loops;
  Particles particles;
  std::vector<Group> groups;
  std::vector<GroupView> views;
  BlockOrder blocks;
  std::vector<long long> interactions;           // per block

  std::vector<MovingWall> rigid;
  std::vector<MovingWall> moving;
  std::vector<std::vector<Vec3>> moving_force;   // at the last evaluation, per moving wall [N]
  struct WallOrigin {
    int wall;             // index into `moving`, or -1 - index into `rigid`
    std::uint32_t point;
  };
  std::vector<WallOrigin> wall_origin;
  std::vector<double> wall_place[3];             // sorted by cell, as the next two
  std::vector<WallRow> wall_rows;
  std::vector<ForceRow> wall_force;
  CellList wall_cells;
  bool walls_packed = false;

  int threads = 1;
  std::vector<Scratch> scratch;
  PassTimers timers;
  double time = 0;
  long steps = 0;
  bool has_energy = false;
  bool evaluated = false;
  double dissipated = 0, wall_work = 0;
  double wall_power = 0;                         // work on moving walls at the last evaluation [W]
  long long interaction_sum = 0;
  Clamps clamps;
  Disturbed disturbed;
  double reach = 0;                              // largest distance of a pair [m]
  bool everywhere = true;                        // are all particles worked on, signal or not?

  explicit Implementation(const Settings& s) : settings(s), loops(pair_loops(s.numerics.kernel, s.numerics.scheme, s.numerics.precision)) {
    threads = s.numerics.threads > 0 ? s.numerics.threads : machine_threads;
    omp_set_num_threads(threads);
    scratch.resize(threads);
    time = evaluation_time = settings.start_time;
    dissipated = settings.heat_before;
    fill();
    rigid = line_walls(settings);
    evaluate(0.0, 0.0);
    watch_for_signals();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    for (Scratch& s : scratch) release(s);
  }

  void fill() {
    const std::vector<BodyParticles> bodies = fill_bodies(settings);
    std::size_t n = 0;
    for (const BodyParticles& body : bodies) n += body.position.size();
    for (const Body& body : settings.bodies) has_energy = has_energy || materials::uses_energy(body.material.law);
    particles.resize(n, has_energy, loops.needs_gradients);
    std::uint32_t at = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Body& body = settings.bodies[b];
      Group group;
      group.body = &settings.bodies[b];
      group.begin = at;
      group.spacing = body.spacing.value_or(settings.lattice.spacing);
      group.h0 = group.h_max = smoothing_length(settings, group.spacing);
      const double energy = start_energy(body), rho = start_density(body, energy);
      group.rest_density = rho;
      for (std::size_t k = 0; k < bodies[b].position.size(); ++k, ++at) {
        const Vec3& x = bodies[b].position[k];
        particles.x[at] = x[0];
        particles.y[at] = x[1];
        particles.z[at] = x[2];
        particles.vx[at] = body.velocity[0];
        particles.vy[at] = body.velocity[1];
        particles.vz[at] = body.velocity[2];
        particles.rho[at] = rho;
        particles.mass[at] = rho * bodies[b].volume[k];
        if (has_energy) particles.energy[at] = energy;
        particles.id[at] = at;
        if (body.burn) group.lighting.push_back(body.burn->lighting_time(x));
      }
      group.end = at;
      if (body.start) lay_on(*body.start, group);
      groups.push_back(std::move(group));
    }
  }

  /// Replaces a body's uniform start; mass, kinetic energy and (with an energy field) internal energy become exact.
  void lay_on(const StartField& start, Group& group) {
    Particles& p = particles;
    const bool with_energy = materials::uses_energy(group.body->material.law);
    double mass = 0, kinetic = 0, internal = 0;
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const double cell = p.mass[i] / p.rho[i];
      const StartState state = start.state({p.x[i], p.y[i], p.z[i]}, group.spacing);
      p.rho[i] = state.density;
      p.mass[i] = state.density * cell;
      p.vx[i] = state.velocity[0];
      p.vy[i] = state.velocity[1];
      p.vz[i] = state.velocity[2];
      if (with_energy) p.energy[i] = state.energy;
      mass += p.mass[i];
      kinetic += 0.5 * p.mass[i] * state.velocity.squaredNorm();
      internal += p.mass[i] * state.energy;
    }
    const double heavier = start.mass / mass;
    const double faster = kinetic > 0 ? std::sqrt(start.kinetic_energy / (kinetic * heavier)) : 1.0;
    const double hotter = internal > 0 ? start.internal_energy / (internal * heavier) : 1.0;
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      p.mass[i] *= heavier;
      p.vx[i] *= faster;
      p.vy[i] *= faster;
      p.vz[i] *= faster;
      if (with_energy) p.energy[i] *= hotter;
    }
  }

  // ---- The passes of a step -------------------------------------------------------------------------------------------

  /// First half of the kick, drift, and the moving walls' half of the impulse.
  void kick_and_drift(double dt) {
    const auto timer = timers.measure("integration");
    half_kick(dt);
    Particles& p = particles;
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.x[i] += dt * p.vx[i];
      p.y[i] += dt * p.vy[i];
      p.z[i] += dt * p.vz[i];
    }
    // A particle that crosses a symmetry plane changes places with its image.
    const struct {
      std::vector<double>&x, &v;
      double SumRow::*a;
      float EarlierRates::*earlier;
    } axes[3] = {{p.x, p.vx, &SumRow::fx, &EarlierRates::ax},
                 {p.y, p.vy, &SumRow::fy, &EarlierRates::ay},
                 {p.z, p.vz, &SumRow::fz, &EarlierRates::az}};
    for (int axis = 0; axis < 3; ++axis) {
      if (!settings.symmetry.axis[axis]) continue;
      const auto& [x, v, a, earlier] = axes[axis];
#pragma omp parallel for schedule(static)
      for (std::size_t i = 0; i < p.size(); ++i)
        if (x[i] < 0.0) {
          x[i] = -x[i];
          v[i] = -v[i];
          p.rate[i].*a = -(p.rate[i].*a);
          p.earlier[i].*earlier = -(p.earlier[i].*earlier);
        }
    }
  }

  void half_kick(double dt) {
    const double half = 0.5 * dt;
    Particles& p = particles;
    long clamped = 0;
#pragma omp parallel for schedule(static) reduction(+ : clamped)
    for (std::size_t i = 0; i < p.size(); ++i) {
      const SumRow& rate = p.rate[i];
      if (has_energy) p.energy[i] += half * rate.heat;
      p.vx[i] += half * rate.fx;
      p.vy[i] += half * rate.fy;
      p.vz[i] += half * rate.fz;
      clamped += std::abs(half * rate.compression) > 1.0;
      p.rho[i] = advanced_density(p.rho[i], half * rate.compression);
    }
    clamps.density += clamped;
    // Heat counts as dissipated where no energy field takes it up.
    for (const Group& group : groups)
      if (!materials::uses_energy(group.body->material.law))
        dissipated += half * blocked_sum<double>(group.begin, group.end,
                                                 [&](std::uint32_t i) { return p.mass[i] * p.rate[i].heat; });
    for (std::size_t w = 0; w < moving.size(); ++w)
      for (std::size_t k = 0; k < moving_force[w].size(); ++k) moving[w].impulse[k] += half * moving_force[w][k];
    wall_work += half * wall_power;
  }

  void sort() {
    const auto timer = timers.measure("sort");
    views.clear();
    for (std::size_t g = 0; g < groups.size(); ++g) {
      Group& group = groups[g];
      try {
        group.cells.build(particles.x.data(), particles.y.data(), particles.z.data(), group.begin, group.end,
                          2.0 * group.spacing * (group.body->variable_h ? group.h_max / group.h0 : 1.0));
      } catch (const std::domain_error&) {
        stop_at_bad_value();
      }
      particles.permute(group.begin, group.cells.order());
    }
  }

  /// State predicted for the end of the step, pressure and sound speed, and the smoothing length. The prediction adds
  /// `half` times the last rates and `bend` times their last change to the half-kicked state.
  void equation_of_state(double half, double bend) {
    const auto timer = timers.measure("equation of state");
    double h_max = 0;
    for (Group& group : groups) {
      std::visit([&](const auto& law) { evaluate_group(law, group, half, bend); }, group.body->material.law);
      views.push_back({group.begin, group.end, group.cells.view(), group.h_max, group.body->variable_h,
                       group.body->variable_h});
      h_max = std::max(h_max, group.h_max);
    }
    reach = loops.support * h_max;
    blocks.build(views, reach);
    find_signals();
  }

  template <class Law>
  void evaluate_group(const Law& law, Group& group, double half, double bend) {
    Particles& p = particles;
    const bool variable = group.body->variable_h;
    const double inverse_dimension = 1.0 / settings.dimension, cell = std::pow(group.spacing, settings.dimension);
    const double low = settings.numerics.h_low, high = settings.numerics.h_high;
    const bool burning = group.body->burn.has_value();
    double h_max = variable ? 0.0 : group.h0;
    long held = 0, empty = 0;
#pragma omp parallel for schedule(static) reduction(max : h_max) reduction(+ : held, empty)
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const SumRow& rate = p.rate[i];
      const EarlierRates& earlier = p.earlier[i];
      const double energy = has_energy ? p.energy[i] + half * rate.heat : 0.0;
      FluidRow& q = p.predicted[i];
      q.vx = p.vx[i] + half * rate.fx + bend * (rate.fx - earlier.ax);
      q.vy = p.vy[i] + half * rate.fy + bend * (rate.fy - earlier.ay);
      q.vz = p.vz[i] + half * rate.fz + bend * (rate.fz - earlier.az);
      const double rho =
          advanced_density(p.rho[i], half * rate.compression + bend * (rate.compression - earlier.compression));
      q.rho = rho;
      q.volume = p.mass[i] / rho;
      materials::PressureSound state;
      if constexpr (std::is_same_v<Law, materials::Jwl>) {
        if (burning) {
          const std::uint32_t k = p.id[i] - group.begin;
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
    group.h_max = h_max;
  }

  materials::PressureSound burning_state(const materials::Jwl& law, const Group& group, std::uint32_t k, double rho,
                                         double energy) const {
    const materials::ProgrammedBurn& burn = *group.body->burn;
    double fraction = 1.0;
    if (!burn.instantaneous) {
      // The front is timed from where the zone was at the start.
      const double since = evaluation_time - group.lighting[k];
      const double timed = burn.width > 0 ? std::clamp(since * burn.D / burn.width, 0.0, 1.0) : since >= 0 ? 1.0 : 0.0;
      // Burn by compression is not kept once the zone expands again: kept, the maximum would climb on the unburned
      // charge's own noise until it detonates by itself.
      fraction = std::max(timed, burn.fraction(burn.origin, -1.0, rho / group.body->material.rho0));
    }
    return materials::burning(law, rho, energy, fraction);
  }
  double evaluation_time = 0;

  void pack_walls() {
    if (walls_packed && moving.empty()) return;
    const auto timer = timers.measure("walls");
    std::vector<WallOrigin> origin;
    std::vector<double> place[3];
    const auto wall_of = [&](const WallOrigin& o) -> const MovingWall& {
      return o.wall >= 0 ? moving[o.wall] : rigid[-1 - o.wall];
    };
    const auto add = [&](const MovingWall& wall, int index) {
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
    walls_packed = true;
  }

  /// After the first evaluation: who is not at rest? Whoever is accelerated, be it by an imbalance of the lattice (rings
  /// have one, a Cartesian lattice under pressure has none). Where a wall moves or a charge burns, all are worked on.
  void watch_for_signals() {
    everywhere = !moving.empty() || settings.numerics.signal <= 0.0;
    for (const Body& body : settings.bodies) everywhere = everywhere || body.burn.has_value();
    if (everywhere) return;
    for (std::uint32_t i = 0; i < particles.size(); ++i) {
      const SumRow& rate = particles.rate[i];
      const FluidRow& q = particles.predicted[i];
      const double a2 = rate.fx * rate.fx + rate.fy * rate.fy + rate.fz * rate.fz;
      // Round-off of the pressure itself, too, is rest.
      if (std::sqrt(a2) * q.rho * q.h > 1e-10 * std::abs(q.p) + 1e-14 * q.rho * q.c * q.c)
        disturbed.add({particles.x[i], particles.y[i], particles.z[i]});
    }
    find_signals();
    for (std::uint32_t i = 0; i < particles.size(); ++i)
      if (!disturbed.within({particles.x[i], particles.y[i], particles.z[i]}, reach)) particles.rate[i] = SumRow{};
  }

  /// Extends the box of the disturbed by those whose speed or density has left rest by more than the share of the sound
  /// speed (or of the density) that counts as a signal.
  void find_signals() {
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

  PairInput pair_input() {
    PairInput in{};
    in.partly = !everywhere;
    for (int a = 0; a < 3; ++a) {
      in.disturbed_low[a] = disturbed.low[a];
      in.disturbed_high[a] = disturbed.high[a];
    }
    // Rates are wanted within reach of the box, which takes pairs of particles within reach of those, whose fluxes take
    // gradients within reach once more.
    in.margin = loops.needs_gradients ? 3.0 * reach : 2.0 * reach;
    in.dimension = settings.dimension;
    in.x = particles.x.data();
    in.y = particles.y.data();
    in.z = particles.z.data();
    in.fluid = particles.predicted.data();
    in.gradient = particles.gradient.data();
    in.groups = views.data();
    in.group_count = int(views.size());
    in.wall_x = wall_place[0].data();
    in.wall_y = wall_place[1].data();
    in.wall_z = wall_place[2].data();
    in.wall = wall_rows.data();
    in.wall_count = std::uint32_t(wall_origin.size());
    if (in.wall_count > 0) in.wall_grid = wall_cells.view();
    for (int a = 0; a < 3; ++a) in.mirror[a] = settings.symmetry.axis[a];
    in.alpha = settings.numerics.alpha;
    in.beta = settings.numerics.beta;
    blocks.describe(in);
    in.scratch = scratch.data();
    return in;
  }

  void pairs(const PairInput& in) {
    const auto timer = timers.measure("pairs");
    interactions.resize(blocks.block_count());
    std::fill(wall_force.begin(), wall_force.end(), ForceRow{});
    const PairOutput out{particles.rate.data(), moving.empty() ? nullptr : wall_force.data(), interactions.data()};
    loops.rates(in, out);
    for (const long long count : interactions) interaction_sum += count;
    if (!loops.needs_gradients) return;
    long held = 0;
    for (const GroupView& group : views)
      if (group.gas)
#pragma omp parallel for schedule(static) reduction(+ : held)
        for (std::uint32_t i = group.begin; i < group.end; ++i) held += particles.gradient[i].filling <= least_filling;
    clamps.filling += held;
  }

  /// Rates per mass from the sums per volume. Where there is an energy field, its rate is the viscous heat plus the
  /// pressure's work.
  void finish_rates() {
    const auto timer = timers.measure("integration");
    Particles& p = particles;
    const bool partly = !everywhere;
    for (const Group& group : groups) {
      const bool with_energy = materials::uses_energy(group.body->material.law);
#pragma omp parallel for schedule(static)
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const FluidRow& q = p.predicted[i];
        SumRow& rate = p.rate[i];
        const double specific = 1.0 / q.rho;
        rate.fx *= specific;
        rate.fy *= specific;
        rate.fz *= specific;
        rate.heat *= specific;
        if (with_energy) rate.heat += q.p * specific * rate.compression;
        // Beyond reach of any signal only some of the pairs were worked on, and rest is rest.
        if (partly && !disturbed.within({p.x[i], p.y[i], p.z[i]}, reach)) rate = SumRow{};
      }
    }
  }

  void wall_forces() {
    if (moving.empty()) return;
    const auto timer = timers.measure("wall forces");
    wall_power = 0;
    for (std::size_t k = 0; k < wall_origin.size(); ++k)
      if (wall_origin[k].wall >= 0) {
        const ForceRow& f = wall_force[k];
        const WallRow& w = wall_rows[k];
        moving_force[wall_origin[k].wall][wall_origin[k].point] = {f.fx, f.fy, f.fz};
        wall_power += f.fx * w.vx + f.fy * w.vy + f.fz * w.vz;
      }
  }

  /// Rates at the present positions, with the state predicted for the end of a step (see equation_of_state).
  void evaluate(double half, double bend) {
    omp_set_num_threads(threads);  // another fluid of this process may have asked for another number
    sort();
    equation_of_state(half, bend);
    particles.turn_rates();
    pack_walls();
    pairs(pair_input());
    finish_rates();
    wall_forces();
    evaluated = true;
  }

  /// Predict, evaluate once, correct: kick-drift-kick with rates taken at a predicted state. A predictor by the last rates
  /// alone makes waves grow by a relative (omega dt)^4/4 a step; extrapolating them by a sixth of their last change cancels
  /// that term: an undamped wave still grows, by 1e-3 a step at omega dt = 0.45, but by O((omega dt)^6), at no further
  /// evaluation.
  void step(double dt) {
    if (!evaluated) evaluate(0.0, 0.0);
    kick_and_drift(dt);
    evaluation_time = time + dt;
    evaluate(0.5 * dt, steps > 0 ? dt * std::min(2.0, dt / last_step) / 6.0 : 0.0);
    {
      const auto timer = timers.measure("integration");
      half_kick(dt);
    }
    time += dt;
    last_step = dt;
    ++steps;
  }
  double last_step = 0;

  // ---- What others ask ------------------------------------------------------------------------------------------------

  StepLimit step_limit() {
    if (!evaluated) evaluate(0.0, 0.0);
    StepLimit limit;
    const Numerics& numerics = settings.numerics;
    limit.step = std::numeric_limits<double>::infinity();
    // Monaghan 1992, Annu. Rev. Astron. Astrophys. 30, eq. 10.2, for a viscosity; a Riemann flux moves with the fluid.
    const bool viscous = numerics.scheme == SchemeName::monaghan;
    const double alpha = viscous ? 0.6 * numerics.alpha : 0.0, beta = viscous ? 0.6 * numerics.beta : 1.0;
    std::uint32_t worst = 0;
    constexpr double fastest = 1e7;  // [m/s]; a hundred times what any explosive does: the run has lost its physics
    const char* criterion = "Courant";
    bool finite = true;
#pragma omp parallel
    {
      double best = std::numeric_limits<double>::infinity();
      std::uint32_t where = 0;
      const char* by = criterion;
      bool ok = true;
#pragma omp for schedule(static)
      for (std::uint32_t i = 0; i < particles.size(); ++i) {
        const FluidRow& q = particles.predicted[i];
        const SumRow& rate = particles.rate[i];
        const double a2 = rate.fx * rate.fx + rate.fy * rate.fy + rate.fz * rate.fz;
        const double signal = q.c + alpha * q.c + beta * rate.closing;
        const double courant = numerics.courant * q.h / signal;
        const double push = 0.25 * std::sqrt(q.h / std::sqrt(a2 + 1e-300));
        const double squeeze = 0.2 / (std::abs(rate.compression) + 1e-300);
        ok = ok && std::isfinite(a2) && signal < fastest;
        const double least = std::min({courant, push, squeeze});
        if (least < best) {
          best = least;
          where = i;
          by = least == courant ? "Courant" : least == push ? "force" : "density";
        }
      }
#pragma omp critical
      {
        finite = finite && ok;
        // The particle's place breaks ties, so that the answer does not depend on who comes first.
        if (best < limit.step || (best == limit.step && where < worst)) {
          limit.step = best;
          worst = where;
          criterion = by;
        }
      }
    }
    if (!finite) stop_at_bad_value();
    limit.criterion = criterion;
    limit.particle = particles.id[worst];
    limit.position = {particles.x[worst], particles.y[worst], particles.z[worst]};
    limit.body = body_of(worst).name;
    if (numerics.fixed_step) {
      limit.step = *numerics.fixed_step;
      limit.criterion = "fixed";
    }
    return limit;
  }

  const Body& body_of(std::uint32_t i) const {
    for (const Group& group : groups)
      if (i < group.end) return *group.body;
    return *groups.back().body;
  }

  const char* remedy() const {
    if (settings.numerics.fixed_step) return "a smaller scheme.fixed_step, or none,";
    return settings.numerics.scheme == SchemeName::monaghan ? "a smaller scheme.courant or a larger scheme.beta"
                                                            : "a smaller scheme.courant";
  }

  [[noreturn]] void stop_at_bad_value() const {
    const Particles& p = particles;
    for (std::uint32_t i = 0; i < p.size(); ++i) {
      const std::pair<const char*, double> values[] = {
          {"position", p.x[i] + p.y[i] + p.z[i]}, {"velocity", p.vx[i] + p.vy[i] + p.vz[i]}, {"density", p.rho[i]},
          {"acceleration", p.rate[i].fx + p.rate[i].fy + p.rate[i].fz}, {"pressure", p.predicted[i].p},
          {"sound speed", p.predicted[i].c}};
      for (const auto& [name, value] : values)
        if (!std::isfinite(value)) {
          char text[400];
          std::snprintf(text, sizeof text,
                        "step %ld, time %.6g s: %s of particle %u (body '%s') is not finite, near (%.5g, %.5g, %.5g) m; "
                        "%s may hold it",
                        steps, time, name, p.id[i], body_of(i).name.c_str(), p.x[i], p.y[i], p.z[i],
                        remedy());
          throw NumericalStop(text);
        }
    }
    const auto speed = [&](std::uint32_t i) {
      return std::sqrt(p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
    };
    std::uint32_t i = 0;
    for (std::uint32_t k = 0; k < p.size(); ++k)
      if (speed(k) > speed(i)) i = k;
    char text[400];
    std::snprintf(text, sizeof text,
                  "step %ld, time %.6g s: speeds beyond all physics; the fastest is particle %u (body '%s') with %.3g m/s at "
                  "(%.5g, %.5g, %.5g) m; %s may hold it",
                  steps, time, p.id[i], body_of(i).name.c_str(), speed(i), p.x[i], p.y[i], p.z[i], remedy());
    throw NumericalStop(text);
  }

  Ledger ledger() const {
    const Particles& p = particles;
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
    for (const Group& group : groups) {
      const materials::FluidLaw& law = group.body->material.law;
      const bool with_energy = materials::uses_energy(law);
      const Part part = blocked_sum<Part>(group.begin, group.end, [&](std::uint32_t i) {
        Part one;
        one.mass = p.mass[i];
        one.kinetic = 0.5 * p.mass[i] * (p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
        one.internal = p.mass[i] * (with_energy ? p.energy[i] : barotropic_energy(law, p.rho[i]));
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
    ledger.dissipated = dissipated;
    ledger.wall_work = wall_work;
    return ledger;
  }

  /// Calls visit(index, distance) for every particle, images included, within `radius_over_h` of its own h of the point.
  template <class Visit>
  void around(const Vec3& point, double radius_over_h, Visit visit) const {
    for (const Group& group : groups) {
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
                const double r = (Vec3(particles.x[i], particles.y[i], particles.z[i]) - at).norm();
                if (r < radius_over_h * particles.predicted[i].h) visit(i, r, group, image);
              }
            }
      }
    }
  }

  /// Shepard average with Wendland's kernel at h = 1.2 spacings, whatever the scheme's own.
  PointValues at(const Vec3& point) const {
    const double shrink = 1.2 / settings.numerics.eta;
    PointValues values;
    double weight = 0;
    around(point, WendlandC2::support * shrink, [&](std::uint32_t i, double r, const Group& group, int image) {
      const FluidRow& q = particles.predicted[i];
      const double w = q.volume * value<WendlandC2>(r, shrink * q.h, settings.dimension);
      weight += w;
      values.pressure += w * q.p;
      values.density += w * q.rho;
      values.void_fraction +=
          w * std::visit([&](const auto& law) { return law.void_fraction(q.rho); }, group.body->material.law);
      const double v[3] = {q.vx, q.vy, q.vz};
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

  std::vector<double> field(std::string_view name) const {
    const Particles& p = particles;
    const std::size_t n = p.size();
    std::vector<double> out(n);
    const auto scalar = [&](auto f) {
#pragma omp parallel for schedule(static)
      for (std::size_t i = 0; i < n; ++i) out[i] = f(i);
    };
    if (name == "position" || name == "velocity") {
      const bool place = name == "position";
      out.resize(3 * n);
      for (std::size_t i = 0; i < n; ++i) {
        out[3 * i] = place ? p.x[i] : p.vx[i];
        out[3 * i + 1] = place ? p.y[i] : p.vy[i];
        out[3 * i + 2] = place ? p.z[i] : p.vz[i];
      }
    } else if (name == "pressure") {
      scalar([&](std::size_t i) { return p.predicted[i].p; });
    } else if (name == "density") {
      scalar([&](std::size_t i) { return p.rho[i]; });
    } else if (name == "sound_speed") {
      scalar([&](std::size_t i) { return p.predicted[i].c; });
    } else if (name == "smoothing_length") {
      scalar([&](std::size_t i) { return p.predicted[i].h; });
    } else if (name == "mass") {
      scalar([&](std::size_t i) { return p.mass[i]; });
    } else if (name == "id") {
      scalar([&](std::size_t i) { return double(p.id[i]); });
    } else if (name == "void_fraction" || name == "material" || name == "energy") {
      for (std::size_t g = 0; g < groups.size(); ++g) {
        const Group& group = groups[g];
        const materials::FluidLaw& law = group.body->material.law;
        for (std::uint32_t i = group.begin; i < group.end; ++i)
          out[i] = name == "material"      ? double(g)
                   : name == "void_fraction" ? std::visit([&](const auto& l) { return l.void_fraction(p.rho[i]); }, law)
                   : materials::uses_energy(law) ? p.energy[i]
                                                 : barotropic_energy(law, p.rho[i]);
      }
    } else {
      throw std::invalid_argument("no particle field is named '" + std::string(name) + "'");
    }
    return out;
  }

  template <class F>
  double largest(F f) const {
    double result = 0;
#pragma omp parallel for schedule(static) reduction(max : result)
    for (std::size_t i = 0; i < particles.size(); ++i) result = std::max(result, f(i));
    return result;
  }
};

Fluid::Fluid(const Settings& settings) : self_(std::make_unique<Implementation>(settings)) {}
Fluid::~Fluid() = default;
Fluid::Fluid(Fluid&&) noexcept = default;

const Settings& Fluid::settings() const { return self_->settings; }
std::size_t Fluid::particle_count() const { return self_->particles.size(); }
std::size_t Fluid::wall_particle_count() const {
  std::size_t count = 0;
  for (const MovingWall& wall : self_->rigid) count += wall.position.size();
  for (const MovingWall& wall : self_->moving) count += wall.position.size();
  return count;
}
std::vector<std::size_t> Fluid::particles_by_body() const {
  std::vector<std::size_t> counts;
  for (const Group& group : self_->groups) counts.push_back(group.end - group.begin);
  return counts;
}
std::size_t Fluid::memory_bytes() const {
  const Implementation& s = *self_;
  std::size_t bytes = s.particles.memory_bytes() + s.blocks.memory_bytes() +
                      s.interactions.capacity() * sizeof(long long) +
                      s.wall_origin.capacity() * (sizeof(Implementation::WallOrigin) + 3 * sizeof(double)) +
                      s.wall_rows.capacity() * sizeof(WallRow) + s.wall_force.capacity() * sizeof(ForceRow);
  for (const Group& group : s.groups) bytes += group.cells.memory_bytes();
  return bytes + s.wall_cells.memory_bytes();
}
double Fluid::time() const { return self_->time; }
long Fluid::steps() const { return self_->steps; }

int Fluid::add_moving_wall(MovingWall wall) {
  wall.impulse.assign(wall.position.size(), Vec3::Zero());
  self_->moving_force.emplace_back(wall.position.size(), Vec3::Zero());
  self_->moving.push_back(std::move(wall));
  self_->everywhere = true;
  self_->evaluated = false;
  return int(self_->moving.size()) - 1;
}
MovingWall& Fluid::moving_wall(int index) { return self_->moving.at(index); }

StepLimit Fluid::step_limit() { return self_->step_limit(); }
void Fluid::step(double dt) { self_->step(dt); }
Ledger Fluid::ledger() const { return self_->ledger(); }
PointValues Fluid::at(const Vec3& point) const { return self_->at(point); }
double Fluid::maximum_pressure() const {
  return self_->largest([&](std::size_t i) { return self_->particles.predicted[i].p; });
}
double Fluid::maximum_speed() const {
  const Particles& p = self_->particles;
  return std::sqrt(
      self_->largest([&](std::size_t i) { return p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]; }));
}
Clamps Fluid::clamps() const { return self_->clamps; }
long long Fluid::neighbour_interactions() const { return self_->interaction_sum; }
const PassTimers& Fluid::timers() const { return self_->timers; }
std::vector<double> Fluid::field(std::string_view name) const { return self_->field(name); }

}  // namespace undex::sph
