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
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sph_fluid/water/water.hpp"

namespace undex::sph {

/// A body's own largest step.
struct BodyLimit {
  double step = std::numeric_limits<double>::infinity();  // [s]
  std::uint32_t particle = 0;
  const char* criterion = "Courant";
};
BodyLimit limit_of(const ParticleSet& set, const Group& group, const Numerics& numerics);

class LocalSteps {
 public:
  static constexpr int most_substeps = 8;  // beyond it impulses of slow pairs come near the period of fast waves

  explicit LocalSteps(Water& water) : water_(water) {}

  /// May bodies of this scene have steps of their own, and have they at present? The whole set then holds the slow pairs' rates.
  bool may_part() const;
  bool parted() const { return water_.all.choice != PairChoice::all; }

  /// Parts the bodies into fast and slow ones, or joins them, where that saves work; rates are then evaluated anew.
  /// Returns whether anything has changed.
  bool choose(const std::vector<BodyLimit>& limits);
  /// One step of the slow bodies, from rates to rates; throws NumericalStop in the middle of one that goes wrong.
  void step(double dt);
  /// All bodies take one step again.
  void join();

  /// Forces on walls at the last evaluations, of fast and of slow particles [N].
  const WallLoads& wall_force() const { return parted() ? wall_force_ : water_.all.wall_force; }
  long substeps() const { return substeps_; }
  std::size_t memory_bytes() const { return near_.memory_bytes(); }
  /// After that of the whole set.
  void visit_state(StateVisitor& state);

 private:
  std::vector<char> best_fast_bodies(const std::vector<BodyLimit>& limits) const;
  void evaluate_both();
  /// An empty near set, of the bodies as they are parted.
  void begin_near_set();
  /// Substeps of the near set over dt, while walls go from one motion to the other.
  void take_substeps(double dt, double bend, const std::vector<WallMotion>& before, const std::vector<WallMotion>& after);
  double substep(double left) const;
  /// Fills the near set: all fast particles, and the slow ones that they may meet within dt.
  void gather(double dt);
  void scatter();

  Water& water_;
  ParticleSet near_;  // the fast bodies and the slow particles near them
  WallLoads wall_force_;
  long substeps_ = 0;
};

}  // namespace undex::sph
