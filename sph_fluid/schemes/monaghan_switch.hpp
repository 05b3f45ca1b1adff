// Monaghan's viscosity with a coefficient of each particle's own (Morris, Monaghan 1997, J. Comput. Phys. 136, 41), which rises
// where the fluid is compressed and decays behind a shock within a few smoothing lengths:
//   d alpha_i/dt = -(alpha_i - alpha_min)/tau + S (alpha_max - alpha_i),   tau = h/(0.2 c),   S = max((d rho/dt)/rho, 0)
// with the source of Rosswog et al. 2000, Astron. Astrophys. 360, 171, that cannot carry alpha beyond its bound. A pair has the
// mean of its two coefficients and beta in the fixed ratio to alpha. The coefficients' own motion is in water.cpp; no
// factor for shear (Balsara's needs the curl, three more sums a particle; explosions compress far more than they shear).
#pragma once

#include "sph_fluid/schemes/monaghan.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// A fluid particle with its coefficient.
template <class V>
struct SwitchedState : FluidState<V> {
  V alpha;
  using Second = ViscosityRow;

  template <class Read>
  UNDEX_INLINE void read_second(Read entry) {
    alpha = entry(0);
  }
};

template <class T>
struct MonaghanSwitch : Monaghan<T> {
  using Base = Monaghan<T>;
  using typename Base::V, typename Base::Wall, typename Base::Sums;
  using State = SwitchedState<V>;
  T inverse;  ///< 1/alpha_max

  explicit MonaghanSwitch(const PairInput& in) : Base(in), inverse(T(1.0 / in.alpha)) {}

  UNDEX_INLINE V pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums& sj) const {
    return this->exchange(i, j, pair, (T(0.5) * inverse) * (i.alpha + j.alpha), si, sj);
  }
  UNDEX_INLINE void wall(const State& i, const Wall& w, const Pair<V>& pair, Sums& si, WallSums<V>& sw) const {
    this->wall_exchange(i, w, pair, inverse * i.alpha, si, sw);
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
