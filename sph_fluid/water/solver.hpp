// What a Fluid is made of: its particles, walls and the passes of a step. Set-up is in solver_start.cpp, the step in
// solver_step.cpp (of the Runge-Kutta method in ssp_rk3.cpp), what others ask in solver_queries.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"
#include "sph_fluid/pairs/blocks.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/water/fluid.hpp"
#include "sph_fluid/schemes/loops.hpp"
#include "sph_fluid/walls/particles.hpp"
#include "sph_fluid/walls/wall_images.hpp"

namespace undex::sph {

/// A body's particles: one material, one smoothing-length policy, one range in memory.
struct Group {
  const Body* body = nullptr;
  std::uint32_t begin = 0, end = 0;
  std::uint32_t first_id = 0;
  bool fast = false;             // does it take substeps (local_steps.cpp)?
  double spacing = 0, h0 = 0;    // [m]
  double h_max = 0;              // [m], the largest at present
  std::uint32_t material = 0;    // one number for all groups of one material
  double rest_density = 0;       // [kg/m^3], of what no signal has reached
  std::vector<double> lighting;  // burning charges only, by id - first_id [s]
  CellList cells;
};

/// Speed at which a run has lost its physics: a hundred times what any explosive does [m/s].
inline constexpr double fastest = 1e7;

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

/// Where a moving wall is, as an evaluation sees it.
struct WallMotion {
  std::vector<Vec3> position, velocity, normal;
};

/// What the fluid has given away: sums that a step adds to.
struct Exchange {
  double dissipated, wall_work;            // [J]
  std::vector<std::vector<Vec3>> impulse;  // per moving wall [N s]
};

/// Particles that take a step together, and what the passes over them work with: all, or (local_steps.cpp) some.
struct ParticleSet {
  Particles particles;
  std::vector<Group> groups;
  std::vector<GroupView> views;
  WallImages images;  // of the particles, in slip walls
  BlockOrder blocks;
  std::vector<long long> interactions;          // per block
  PairChoice choice = PairChoice::all;          // whose rates Particles::rate holds
  std::vector<std::vector<Vec3>> moving_force;  // at the last evaluation, per moving wall [N]
  double wall_power = 0;                        // work on moving walls at the last evaluation [W]
  double reach = 0;                             // largest distance of a pair [m]
};

/// A body's own largest step.
struct BodyLimit {
  double step = std::numeric_limits<double>::infinity();  // [s]
  std::uint32_t particle = 0;
  const char* criterion = "Courant";
};

struct Fluid::Implementation : ParticleSet {
  Settings settings;
  PairLoops loops;
  double kernel_scale = 1;  // 1 over the kernel's lattice factor
  SlipFaces slip_walls;
  std::vector<MovingWall> rigid;
  std::vector<MovingWall> moving;
  std::vector<std::vector<Vec3>> whole_force;  // of local steps: the sum of both sets', per moving wall [N]
  struct WallOrigin {
    int wall;  // index into `moving`, or -1 - index into `rigid`
    std::uint32_t point;
  };
  std::vector<WallOrigin> wall_origin;
  std::vector<double> wall_place[3];  // sorted by cell, as the next two
  std::vector<WallRow> wall_rows;
  std::vector<ForceRow> wall_force;
  CellList wall_cells;
  bool walls_packed = false;
  std::vector<WallMotion> walls_seen;  // at the last evaluation, per moving wall; unless all take one leapfrog's step
  int threads = 1;
  std::vector<Scratch> scratch;
  PassTimers timers;
  double time = 0;
  long steps = 0;
  bool has_energy = false;
  bool evaluated = false;
  bool sound = true;  // is the last evaluation finite, and slower than `fastest`?
  double dissipated = 0, wall_work = 0;
  double lifted = 0;  // fall() at the start [J]
  long long interaction_sum = 0;
  Clamps clamps;
  Disturbed disturbed;
  bool everywhere = true;      // are all particles worked on, signal or not?
  double evaluation_time = 0;  // of the state that rates are evaluated at [s]
  double last_step = 0;        // [s]; 0: none that the predictor could go on
  bool limits_known = false;   // has step_limit been asked since the last step?

  // Of local steps.
  ParticleSet near;                        // the fast bodies and the slow particles near them
  bool near_walls = false;                 // has a fast particle a wall's within reach?
  double last_substep = 0;                 // [s], as last_step
  double slow_ahead = 0, slow_bend = 0;    // weights of the slow pairs' rates in what fast pairs see [s]
  static constexpr int most_substeps = 8;  // beyond it impulses of slow pairs come near the period of fast waves
  long substeps = 0;

  explicit Implementation(const Settings& settings);
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    for (Scratch& s : scratch) release(s);
  }

  // Set-up: solver_start.cpp.
  void fill();
  /// Replaces a body's uniform start; mass, kinetic energy and (with an energy field) internal energy become exact.
  void lay_on(const StartField& start, Group& group);
  /// After the first evaluation: who is not at rest? Whoever is accelerated, be it by an imbalance of the lattice (rings
  /// have one, a Cartesian lattice under pressure has none). Where a wall moves or a charge burns, all are worked on.
  void watch_for_signals();
  /// Sum of m g . x [J]: what it has grown by is gravity's work.
  double fall() const;

  // The step and its passes: solver_step.cpp.
  void step(double dt);
  /// A step of several evaluations. Where one goes wrong, all is put back to the step's beginning and has no rates.
  void step_or_stay(double dt);
  Exchange exchange() const;
  /// Throws NumericalStop unless all is well.
  void require(bool well) const {
    if (!well) throw NumericalStop(what_is_wrong());
  }
  /// Predict, evaluate once, correct: kick-drift-kick with rates taken at a predicted state. A predictor by the last rates
  /// alone makes waves grow by a relative (omega dt)^4/4 a step; extrapolating them by a sixth of their last change cancels
  /// that term: an undamped wave still grows, by 1e-3 a step at omega dt = 0.45, but by O((omega dt)^6), at no further
  /// evaluation.
  void step_leapfrog(double dt);
  /// Rates at the present positions, with the state predicted for the end of a step (see equation_of_state).
  void evaluate(double half, double bend);
  /// Half of the kick, with the moving walls' half of the impulse. False: a particle is beyond `fastest` now.
  bool half_kick(double dt);
  void drift(double dt);
  /// The predictor's weight of the last change of the rates.
  static double bend_of(double dt, double last) { return last > 0 ? dt * std::min(2.0, dt / last) / 6.0 : 0.0; }
  /// A particle that crosses a symmetry plane or a slip wall changes places with its image.
  void cross_mirrors();
  /// Heat that no energy field takes up, and what the moving walls receive, over `duration` at the last evaluation's rates.
  void book_exchange(double duration);
  /// After an evaluation that went wrong: back by half of the drift, to the state between the two kicks. All of it is
  /// finite, the ledger holds for it, and its pressures are evaluated; it has no rates.
  void stand_half_way(double dt);
  /// The end of a stop: pressures of the present state, and no rates.
  void stand_still();
  /// The coefficients of viscosity of a scheme with a switch over dt, their rates held (monaghan_switch.hpp).
  void advance_viscosity(double dt);
  /// Rates at which a particle's coefficient goes to its lower and to its upper bound [1/s].
  struct SwitchRates {
    double decay, source;
  };
  SwitchRates switch_rates(std::uint32_t i) const;
  void sort();
  /// State predicted for the end of the step, pressure and sound speed, and the smoothing length. The prediction adds
  /// `half` times the last rates and `bend` times their last change to the half-kicked state.
  void equation_of_state(double half, double bend);
  template <class Law>
  void evaluate_group(const Law& law, Group& group, double half, double bend);
  materials::PressureSound burning_state(const materials::Jwl& law, const Group& group, std::uint32_t k, double rho,
                                         double energy) const;
  /// Extends the box of the disturbed by those whose speed or density has left rest by more than the share of the sound
  /// speed (or of the density) that counts as a signal.
  void find_signals();
  void pack_walls();
  void find_images();
  PairInput pair_input();
  void pairs(const PairInput& in);
  /// Rates per mass from the sums per volume, and gravity. Where there is an energy field, its rate is the viscous heat plus the
  /// pressure's work.
  void finish_rates();
  void wall_forces();

  // Three stages a step: ssp_rk3.cpp. Moving walls are as their owner shows them at the end of the step; before it they are where
  // the last step left them, and in its middle on the cubic through both.
  void step_ssp_rk3(double dt);
  /// From u and its rates to (1 - share) u_start + share (u + dt L(u)); `weight` is that of these rates in the step. False: a
  /// particle is beyond `fastest` now.
  bool stage(double dt, double share, double weight);
  std::vector<WallMotion> wall_motions() const;
  /// The wall at a share of the step, on the cubic through both its ends.
  static WallMotion between(const WallMotion& before, const WallMotion& after, double dt, double share);
  static void show(MovingWall& wall, const WallMotion& motion);

  // Steps of bodies' own: local_steps.cpp. The whole set then holds the slow pairs' rates.
  bool may_part() const {
    const Numerics& n = settings.numerics;
    return n.local_steps && n.integrator == Integrator::leapfrog && !n.fixed_step && groups.size() > 1;
  }
  /// Parts the bodies into fast and slow ones, or joins them, where that saves work; rates are then evaluated anew.
  /// Returns whether anything has changed.
  bool choose_fast_bodies(const std::vector<BodyLimit>& limits);
  /// One step of the slow bodies, from rates to rates.
  void step_local(double dt);
  /// Fills the near set: all fast particles, and the slow ones that they may meet within dt.
  void gather_near(double dt);
  void scatter_near();
  void add_wall_forces();
  void join();

  // What others ask: solver_queries.cpp.
  StepLimit step_limit();
  BodyLimit limit_of(const Group& group) const;
  const Body& body_of(std::uint32_t i) const;
  const char* remedy() const;
  /// Why the run cannot go on: which particle, where, and a remedy.
  std::string what_is_wrong() const;
  Ledger ledger() const;
  /// Calls visit(index, distance) for every particle, images included, within `radius_over_h` of its own h of the point.
  template <class Visit>
  void around(const Vec3& point, double radius_over_h, Visit visit) const;
  /// Shepard average with Wendland's kernel at h = 1.2 spacings, whatever the scheme's own.
  FluidPoint at(const Vec3& point) const;
  std::vector<double> field(std::string_view name) const;
  template <class F>
  double largest(F f) const {
    double result = 0;
#pragma omp parallel for schedule(static) reduction(max : result)
    for (std::size_t i = 0; i < particles.size(); ++i) result = std::max(result, f(i));
    return result;
  }
};

}  // namespace undex::sph
