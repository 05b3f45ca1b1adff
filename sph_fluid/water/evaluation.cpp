// The passes of an evaluation, in the order in which rates() calls them.
#include "sph_fluid/water/evaluation.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "sph_fluid/lattice.hpp"
#include "sph_fluid/water/split.hpp"

namespace undex::sph {
namespace {

/// What the machine (or OMP_NUM_THREADS) offers, before any fluid asks for its own number.
const int machine_threads = omp_get_max_threads();

/// Of particle k of a burning charge at `time` [s].
materials::PressureSound burning_state(const materials::Jwl& law, const Group& group, std::uint32_t k, double rho, double energy,
                                       double time) {
  const materials::ProgrammedBurn& burn = *group.body->burn;
  double fraction = 1.0;
  if (!burn.instantaneous) {
    const double timed = share_burnt(group, k, time);
    // Burn by compression is not kept once the zone expands again: kept, the maximum would climb on the unburned
    // charge's own noise until it detonates by itself.
    fraction = std::max(timed, burn.fraction(burn.origin, -1.0, rho / group.body->material.rho0));
  }
  return materials::burning(law, rho, energy, fraction);
}

}  // namespace

double advanced_density(double rho, double rate_times_step) {
  const double s = std::clamp(0.5 * rate_times_step, -0.5, 0.5);
  return rho * (1.0 + s) / (1.0 - s);
}

Evaluation::Evaluation(const Settings& settings, const MovingWalls& walls, RadiatingFaces& radiating, const Clock& clock,
                       PassTimers& timers, Clamps& clamps)
    : settings_(settings),
      walls_(walls),
      radiating_(radiating),
      clock_(clock),
      timers_(timers),
      clamps_(clamps),
      loops_(pair_loops(settings.numerics.kernel, settings.numerics.scheme, settings.numerics.precision, settings.axisymmetric)),
      kernel_scale_(1.0 / lattice_factor(settings.numerics.kernel, settings.numerics.eta, settings.dimension)),
      slip_faces_(sph::slip_faces(settings)),
      threads_(settings.numerics.threads > 0 ? settings.numerics.threads : machine_threads),
      memory_(threads_) {
  omp_set_num_threads(threads_);
  if (settings.axisymmetric) rings_.emplace(settings.numerics.kernel, settings.numerics.eta);
}

void Evaluation::rates(ParticleSet& set, const Ahead& ahead) {
  omp_set_num_threads(threads_);  // another fluid of this process may have asked for another number
  sort(set);
  equation_of_state(set, ahead);
  pack_walls(set);
  if (ahead.whole) split_grown(set, ahead);
  set.particles.turn_rates();
  find_images(set, ahead);
  pairs(set, ahead.at_rest);
  wall_forces(set);
  finish_rates(set);
}

double Evaluation::take_parted() { return std::exchange(parted_, 0.0); }

void Evaluation::rest(ParticleSet& set, double time) {
  std::fill(set.particles.rate.begin(), set.particles.rate.end(), SumRow{});
  sort(set);
  equation_of_state(set, {.time = time});
}

void Evaluation::sort(ParticleSet& set) {
  const auto timer = timers_.measure("sort");
  set.images.forget();
  set.views.clear();
  Particles& p = set.particles;
  for (Group& group : set.groups) {
    const double stretch = group.body->variable_h ? group.h_max / group.h0 : 1.0;
    try {
      group.cells.build(p.x.data(), p.y.data(), p.z.data(), group.begin, group.end, 2.0 * group.spacing * stretch, p.id.data());
    } catch (const std::domain_error&) {
      throw NumericalStop(what_is_wrong(set, settings_, clock_));
    }
    p.permute(group.begin, group.cells.order());
  }
}

void Evaluation::equation_of_state(ParticleSet& set, const Ahead& ahead) {
  const auto timer = timers_.measure("equation of state");
  double h_max = 0;
  for (Group& group : set.groups) {
    std::visit([&](const auto& law) { evaluate_group(set, law, group, ahead); }, group.body->material.law);
    set.views.push_back(
        {.begin = group.begin,
         .end = group.end,
         .grid = group.cells.view(),
         .h_max = group.h_max,
         .variable_h = group.body->variable_h,
         .gas = group.body->variable_h,
         .material = group.material,
         .least_pressure = std::min(0.0, materials::least_pressure(group.body->material.law)) - settings_.surroundings.pressure,
         .fast = group.fast});
    h_max = std::max(h_max, group.h_max);
  }
  set.reach = loops_.support * h_max;
  set.blocks.build(set.views, set.reach, threads_);
  signals_.find(set);
}

void Evaluation::split_grown(ParticleSet& set, const Ahead& ahead) {
  if (!any_has_grown(set, settings_, ahead.time)) return;
  find_images(set, {.at_rest = true});  // radiating faces are shown once, by the evaluation
  {
    const auto timer = timers_.measure("splitting");
    const std::vector<Split> splits = find_splits(set, settings_, ahead.time, pair_input(set));
    // The images that have been found are found again, from the sorted particles alone.
    if (!splits.empty()) parted_ += split(set, splits);
  }
  const Clamps counted = clamps_;
  sort(set);
  equation_of_state(set, ahead);
  clamps_ = counted;
}

template <class Law>
void Evaluation::evaluate_group(ParticleSet& set, const Law& law, Group& group, const Ahead& ahead) {
  Particles& p = set.particles;
  const double half = ahead.half, bend = ahead.bend, slow_half = ahead.slow_half, slow_bend = ahead.slow_bend;
  const bool variable = group.body->variable_h, has_energy = !p.energy.empty();
  const double inverse_dimension = 1.0 / settings_.dimension, cell = std::pow(group.spacing, settings_.dimension);
  const double low = settings_.numerics.h_low, high = settings_.numerics.h_high;
  const bool burning = group.body->burn.has_value();
  const bool beside = set.choice == PairChoice::fast && !group.fast;
  const Vec3& gravity = settings_.gravity;
  const double around = settings_.surroundings.pressure;
  const double nearest = 1e-6 * group.spacing;  // to the axis
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
      if (has_energy) energy += slow_half * more.heat;
      q.vx += slow_half * (more.fx - gravity[0]) + slow_bend * (more.fx - before.ax);
      q.vy += slow_half * (more.fy - gravity[1]) + slow_bend * (more.fy - before.ay);
      q.vz += slow_half * (more.fz - gravity[2]) + slow_bend * (more.fz - before.az);
      rho = advanced_density(rho, slow_half * more.compression + slow_bend * (more.compression - before.compression));
    }
    q.rho = rho;
    q.volume = p.mass[i] / rho;
    materials::PressureSound state;
    if constexpr (std::is_same_v<Law, materials::Jwl>) {
      if (burning) {
        state = burning_state(law, group, p.id[i] - group.first_id, rho, energy, ahead.time);
      } else {
        state = law.evaluate(rho, energy);
      }
    } else {
      state = law.evaluate(rho, energy);
    }
    q.p = state.pressure - around;
    q.c = state.sound_speed;
    // A cavity closes against liquid: with the mixture's own few m/s neither the dissipation nor the step would see
    // that coming (energy error 5 % over the closing of a cavity instead of 0.3 %).
    if constexpr (requires { law.liquid_sound(); }) q.c = std::max(q.c, law.liquid_sound());
    q.h = group.h0;
    const double r = std::max(p.x[i], nearest);
    if (rings_) q.vz = variable ? ring_area(q.volume, r) : q.volume / (2.0 * std::numbers::pi * r);
    if (variable) {
      const double growth = (rings_ ? q.vz : q.volume) / cell;
      const double wanted = std::pow(group.body->split > 1 ? even_growth(growth, p.halvings[i] > 0, settings_.dimension) : growth,
                                     inverse_dimension);
      held += wanted < low || wanted > high;
      q.h *= std::clamp(wanted, low, high);
      h_max = std::max(h_max, q.h);
      empty += energy < 0.0;
    }
    if (rings_) p.ring[i] = rings_->row(r, q.h);
  }
  clamps_.energy += empty;
  clamps_.smoothing += held;
  if (group.begin < group.end) group.h_max = h_max;
}

void Evaluation::pack_walls(const ParticleSet& set) {
  if (!lining_.waits(settings_, walls_.lined) || (lining_.packed() && !set.meets_walls)) return;
  const auto timer = timers_.measure("walls");
  lining_.pack(settings_, walls_.lined, slip_faces_);
}

namespace {

/// The image of a particle at s meets particles at s' if s + s' is less than their mean reach.
std::vector<ParticleRange> ranges_of(const std::vector<Group>& groups, double support, const SlipFaces& faces,
                                     const std::vector<MirrorWall>& mirrors) {
  std::vector<double> clear;
  for (const Group& group : groups) {
    const CellGrid grid = group.cells.view();
    Bounds box;
    box.include(Vec3(grid.bound_low[0], grid.bound_low[1], grid.bound_low[2]));
    box.include(Vec3(grid.bound_high[0], grid.bound_high[1], grid.bound_high[2]));
    clear.push_back(std::min(clearance(faces, box), clearance(mirrors, box)));
  }
  std::vector<ParticleRange> ranges;
  for (const Group& group : groups) {
    double depth = 0.0;
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g].begin < groups[g].end) depth = std::max(depth, 0.5 * support * (group.h_max + groups[g].h_max) - clear[g]);
    ranges.push_back(
        {.first = group.begin, .last = group.end, .cells = &group.cells, .width = 2.0 * group.spacing, .depth = depth});
  }
  return ranges;
}

}  // namespace

void Evaluation::find_images(ParticleSet& set, const Ahead& ahead) {
  const bool lined =
      std::any_of(walls_.lined.begin(), walls_.lined.end(), [](const LinedWall& wall) { return !wall.faces.empty(); });
  if (walls_.mirrors.empty() && slip_faces_.empty() && !lined) return;
  const auto timer = timers_.measure("walls");
  if (lined) set.images.see_linings(walls_.lined, lining_.behind_surface());
  const std::vector<ParticleRange> ranges = ranges_of(set.groups, loops_.support, slip_faces_, walls_.mirrors);
  // Substeps see the faces as they go from one whole step to the next.
  std::function<void(std::span<const WallFoot>)> radiate;
  if (!radiating_.empty() && set.choice != PairChoice::fast && !ahead.at_rest)
    radiate = [&](std::span<const WallFoot> feet) { radiating_.see(set, feet, ahead.time); };
  set.images.build(settings_, slip_faces_, walls_.mirrors, set.particles, ranges, set.reach, radiate);
  set.images.reflect_rows(set.particles, settings_.gravity, rings_ ? &*rings_ : nullptr);
  if (set.images.size() == 0) return;
  for (std::size_t g = 0; g < set.groups.size(); ++g) {
    GroupView view = set.views[g];
    view.begin = set.images.begin(g);
    view.end = set.images.begin(g + 1);
    view.grid = set.images.grid(g);
    view.images_of = int(g);
    if (view.begin < view.end) set.views.push_back(view);
  }
}

PairInput Evaluation::pair_input(ParticleSet& set) {
  Particles& p = set.particles;
  PairInput in{};
  in.choice = set.choice;
  // Rates are wanted within reach of the box, which takes pairs of particles within reach of those, whose fluxes take
  // gradients within reach once more.
  signals_.describe(in, (loops_.reconstructs() ? 3.0 : 2.0) * set.reach);
  in.dimension = settings_.dimension;
  in.kernel_scale = kernel_scale_;
  in.x = p.x.data();
  in.y = p.y.data();
  in.z = p.z.data();
  in.fluid = p.predicted.data();
  in.kernel = kernel_choice(settings_.numerics.kernel, settings_.dimension);
  in.second = p.second_rows();
  in.rings = p.ring.data();
  in.shape_scale = rings_ ? 1.0 / rings_->lattice_sum() : 0.0;
  in.groups = set.views.data();
  in.group_count = int(set.views.size());
  set.images.describe(in);
  set.images.sight().describe(in);
  if (set.meets_walls) lining_.describe(in);
  for (int a = 0; a < 3; ++a) in.mirror[a] = settings_.symmetry.axis[a];
  for (int a = 0; a < 3; ++a) in.gravity[a] = settings_.gravity[a];
  in.alpha = settings_.numerics.alpha;
  in.beta = settings_.numerics.beta;
  set.blocks.describe(in);
  memory_.describe(in);
  return in;
}

void Evaluation::pairs(ParticleSet& set, bool at_rest) {
  const PairInput in = pair_input(set);
  const auto timer = timers_.measure("pairs");
  set.interactions.resize(set.blocks.block_count());
  lining_.clear_forces();
  const PairOutput out{.fluid = set.particles.rate.data(),
                       .wall = lining_.forces(),
                       .images = set.images.sums(),
                       .interactions = set.interactions.data()};
  if (at_rest && loops_.reconstructs()) {
    // Nor is anything corrected: plain gradients are those of a potential.
    std::fill(set.particles.gradient.begin(), set.particles.gradient.end(), GradientRow{{}, {}, 1.0f});
    std::fill(set.particles.corrected.begin(), set.particles.corrected.end(), CorrectedRow{{{}, {}, 1.0f}, {1.0f, 1.0f, 1.0f}});
    set.images.reflect_gradients(set.particles, Vec3::Zero());
  } else if (loops_.gradients) {
    loops_.gradients(in, out);
    set.images.reflect_gradients(set.particles, settings_.gravity);
  }
  loops_.rates(in, out);
  for (const long long count : set.interactions) interactions_ += count;
  if (loops_.second == SecondRow::gradient) count_fillings(set);
}

void Evaluation::count_fillings(const ParticleSet& set) {
  long held = 0;
  for (const Group& group : set.groups)
    if (group.body->variable_h && set.moves(group))
#pragma omp parallel for schedule(static) reduction(+ : held)
      for (std::uint32_t i = group.begin; i < group.end; ++i) held += set.particles.gradient[i].filling <= least_filling;
  clamps_.filling += held;
}

void Evaluation::wall_forces(ParticleSet& set) {
  if (walls_.empty() && set.images.size() == 0) return;
  const auto timer = timers_.measure("wall forces");
  set.wall_force = walls_.unloaded();
  set.wall_power = set.images.scatter(set.particles, walls_.mirrors, set.wall_force.mirrors);
  set.wall_power.moving += lining_.scatter(set.wall_force.lined);
}

void Evaluation::finish_rates(ParticleSet& set) {
  const auto timer = timers_.measure("integration");
  Particles& p = set.particles;
  // With local steps gravity acts about the step, on all alike: in the substeps nobody falls past a neighbour.
  const Vec3 gravity = set.choice == PairChoice::fast ? Vec3(Vec3::Zero()) : settings_.gravity;
  const double around = settings_.surroundings.pressure;
  set.healthy = true;
  for (const Group& group : set.groups) {
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
      if (with_energy) rate.heat += (q.p + around) * specific * rate.compression;
      ok = ok && std::isfinite(q.p + rate.fx + rate.fy + rate.fz + rate.heat + rate.compression);
      ok = ok && q.c + rate.closing < fastest;
      // Beyond reach of any signal only some of the pairs were worked on, and rest is rest.
      if (signals_.leaves_out(place_of(p, i), set.reach)) rate = SumRow{};
    }
    set.healthy = set.healthy && ok;
  }
}

void Evaluation::visit_state(StateVisitor& state) {
  state("interactions", interactions_);
  state.part("signals", [&] { signals_.visit_state(state); });
}

}  // namespace undex::sph
