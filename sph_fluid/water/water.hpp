// The water in motion: its particles, walls and ledger, and what every integrator does with them.
#pragma once

#include <algorithm>
#include <vector>

#include "core/errors.hpp"
#include "core/timers.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/water/evaluation.hpp"
#include "sph_fluid/water/fluid.hpp"
#include "sph_fluid/water/particle_set.hpp"
#include "sph_fluid/water/radiating_faces.hpp"

namespace undex::sph {

/// What the fluid has given away since the start [J].
struct Exchange {
  double dissipated = 0, wall_work = 0, radiated = 0;
  OnFixedFaces fixed = nothing_on_fixed_faces();  ///< impulses on slip faces at rest [N s]
};

struct Water {
  explicit Water(const Settings& settings);
  Water(const Water&) = delete;
  Water& operator=(const Water&) = delete;

  Settings settings;
  ParticleSet all;
  MovingWalls walls;
  RadiatingFaces radiating;
  std::vector<WallMotion> walls_seen;  ///< at the last evaluation; unless all take one leapfrog's step
  Exchange exchange;
  Clock clock;
  Clamps clamps;
  PassTimers timers;
  Evaluation evaluation;
  bool evaluated = false;  ///< are there rates?

  /// Rates of a set at its present positions, with the state predicted for the end of a step.
  void evaluate(ParticleSet& set, const Ahead& ahead);
  /// The same; throws NumericalStop where they are not finite or beyond all physics.
  void evaluate_or_stop(ParticleSet& set, const Ahead& ahead);
  void require(bool well, const ParticleSet& set) const {
    if (!well) throw NumericalStop(what_is_wrong(set, settings, clock));
  }

  /// Half of the kick over dt [s], with the moving walls' half of the impulse. False: a particle is beyond `fastest` now.
  bool half_kick(ParticleSet& set, double dt);
  void drift(ParticleSet& set, double dt);
  /// A particle that crosses a symmetry plane or a slip wall changes places with its image.
  void cross_mirrors(ParticleSet& set);
  /// Heat that no energy field takes up, and what the moving walls receive, over `duration` [s] at the last evaluation's rates.
  void book(const ParticleSet& set, double duration);

  /// Rates at which a particle's coefficient of viscosity goes to its lower and to its upper bound [1/s] (monaghan_switch.hpp).
  struct SwitchRates {
    double decay, source;
  };
  static SwitchRates switch_rates(const ParticleSet& set, std::uint32_t i);

 private:
  void cross_symmetry_planes(Particles& particles) const;
  /// The coefficients of viscosity over dt, their rates held.
  void advance_viscosity(ParticleSet& set, double dt) const;
};

/// The predictor's weight of the last change of the rates [s] in a step of dt after one of `last` [s].
inline double bend_of(double dt, double last) { return last > 0 ? dt * std::min(2.0, dt / last) / 6.0 : 0.0; }

}  // namespace undex::sph
