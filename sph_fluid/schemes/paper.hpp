// The scheme of Chen et al. 2019 with its walls as published (section 2.6): a dummy particle has the stress of the fluid
// particle that meets it and the velocity of its wall, v_d = v_w, not the mirrored 2 v_w - v_i of monaghan.hpp. Density
// rate, viscosity and heat of the pair follow from that one velocity:
//   (d rho/dt)_i = rho_i V_w v_iw . grad W,   f_i = -V_i V_w (2 p_i + viscous) grad W,   viscous from v_iw
// The density takes up p_i of this work, one of the pair's two sides; what is left, p_i + viscous, is heat of particle i. Its
// part p_i is no friction: it is what the dummy, the pair's other side, would store as the layer of dummies is squeezed with the
// fluid, and give back as it expands. It has either sign.
// Between fluid particles nothing differs from monaghan.hpp.
#pragma once

#include "sph_fluid/schemes/monaghan.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class T>
struct Paper : Monaghan<T> {
  using Base = Monaghan<T>;
  using Base::Base;
  using typename Base::V, typename Base::State, typename Base::Wall, typename Base::Sums;

  UNDEX_INLINE void wall(const State& i, const Wall& w, const Pair<V>& pair, Sums& si, WallSums<V>& sw) const {
    const WallPair<V> m = wall_pair(i, w, pair);
    const V approach = T(0.5) * m.approach;  // of the particle and the wall itself
    V closing;
    const V viscous = this->viscosity(approach, pair, 2 * i.c, 2 * i.rho, i.rho * i.rho, closing);
    const V rise = this->weight.rise(i, pair);
    add_wall_force(pair.F * (2 * i.p + rise + viscous), m.ex, m.ey, m.ez, i.volume, w.volume, si, sw);
    const V D = pair.F * approach * w.volume;
    si.compression += D;
    si.heat += (i.p + rise + viscous) * D;
    si.closing = maximum(si.closing, closing);
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
