// Particles at rest that no signal has reached are not worked on. Where a wall moves, a charge burns or gravity acts, all are.
#pragma once

#include "sph_fluid/water/particle_set.hpp"

namespace undex::sph {

class Signals {
 public:
  /// After the first evaluation: who is not at rest? Whoever is accelerated, be it by an imbalance of the lattice (rings have
  /// one, a Cartesian lattice under pressure has none). The others' rates become zero.
  void watch(const Settings& settings, ParticleSet& set);
  /// From now on all are worked on.
  void expect_everywhere() { everywhere_ = true; }
  /// Or all within reach of a box.
  void expect_within(const Bounds& box);
  /// Extends the box of the disturbed by those whose speed or density has left rest by more than the share of the sound speed (or
  /// of the density) that counts as a signal.
  void find(const ParticleSet& set);

  /// Is a particle at x left out, when pairs reach that far [m]?
  bool leaves_out(const Vec3& x, double reach) const { return !everywhere_ && !disturbed_.holds(x, reach); }
  void describe(PairInput& in, double margin) const;
  void visit_state(StateVisitor& state);

 private:
  bool everywhere_ = true;
  double share_ = 0;
  bool rings_ = false;  // the rows' vz is an area
  Bounds disturbed_;    // the particles that are no longer in their first state of rest
};

}  // namespace undex::sph
