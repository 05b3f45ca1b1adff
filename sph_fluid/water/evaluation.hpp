// Rates of a set of particles at their present places: the passes of an evaluation, and what they share (the compiled loops, the
// rigid walls, who is at rest).
#pragma once

#include <vector>

#include "core/timers.hpp"
#include "sph_fluid/pairs/pair_memory.hpp"
#include "sph_fluid/schemes/loops.hpp"
#include "sph_fluid/walls/slip_faces.hpp"
#include "sph_fluid/walls/wall_lining.hpp"
#include "sph_fluid/water/fluid.hpp"
#include "sph_fluid/water/particle_set.hpp"
#include "sph_fluid/water/radiating_faces.hpp"
#include "sph_fluid/water/signals.hpp"

namespace undex::sph {

/// How far ahead of the particles' state the rates are evaluated: the prediction adds `half` times the last rates and `bend`
/// times their last change [s]; in fast pairs slow particles are carried by the rates from slow pairs likewise (local_steps.hpp).
struct Ahead {
  double time = 0;  ///< of the predicted state [s]
  double half = 0, bend = 0;
  double slow_half = 0, slow_bend = 0;
  bool at_rest = false;  ///< all at rest under one pressure: gradients vanish, and kernel gradients stay uncorrected
  bool whole = false;    ///< a step ends here: particles that have grown may split
};

class Evaluation {
 public:
  Evaluation(const Settings& settings, const MovingWalls& walls, RadiatingFaces& radiating, const Clock& clock,
             PassTimers& timers, Clamps& clamps);
  Evaluation(const Evaluation&) = delete;
  Evaluation& operator=(const Evaluation&) = delete;

  /// Rates of the set at its present positions. Throws NumericalStop where a position is not finite.
  void rates(ParticleSet& set, const Ahead& ahead);
  /// Pressures of its present state, and no rates.
  void rest(ParticleSet& set, double time);
  void pack_walls(const ParticleSet& set);
  /// What splits have made kinetic energy of and no energy field has lost, since it was last asked for [J].
  double take_parted();

  const PairLoops& loops() const { return loops_; }
  const SlipFaces& slip_faces() const { return slip_faces_; }
  const WallLining& lining() const { return lining_; }
  Signals& signals() { return signals_; }
  long long interactions() const { return interactions_; }
  void count_anew() { interactions_ = 0; }
  void visit_state(StateVisitor& state);
  std::size_t memory_bytes() const { return lining_.memory_bytes() + memory_.memory_bytes(); }

 private:
  void sort(ParticleSet& set);
  void equation_of_state(ParticleSet& set, const Ahead& ahead);
  /// Particles that have grown become two (split.hpp).
  void split_grown(ParticleSet& set, const Ahead& ahead);
  template <class Law>
  void evaluate_group(ParticleSet& set, const Law& law, Group& group, const Ahead& ahead);
  void find_images(ParticleSet& set, const Ahead& ahead);
  PairInput pair_input(ParticleSet& set);
  void pairs(ParticleSet& set, bool at_rest);
  void count_fillings(const ParticleSet& set);
  void wall_forces(ParticleSet& set);
  /// Rates per mass from the sums per volume, and gravity. Where there is an energy field, its rate is the viscous heat plus the
  /// pressure's work.
  void finish_rates(ParticleSet& set);

  const Settings& settings_;
  const MovingWalls& walls_;
  RadiatingFaces& radiating_;
  const Clock& clock_;
  PassTimers& timers_;
  Clamps& clamps_;
  PairLoops loops_;
  double kernel_scale_;  // 1 over the kernel's lattice factor
  std::optional<RingKernel> rings_;
  SlipFaces slip_faces_;
  WallLining lining_;
  Signals signals_;
  int threads_;
  PairMemory memory_;
  long long interactions_ = 0;
  double parted_ = 0;  // see take_parted
};

/// Density after half a step: rho exp(D dt) to third order in D dt, positive however large the rate.
double advanced_density(double rho, double rate_times_step);

}  // namespace undex::sph
