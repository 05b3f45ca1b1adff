// The pair scheme of Chen et al. 2019, eqs 5 and 6, in its energy-consistent form.
//   (d rho/dt)_i = rho_i sum_j V_j v_ij . grad W_ij
//   (d v/dt)_i   = - sum_j m_j ((p_i + p_j)/(rho_i rho_j) + Pi_ij) grad W_ij
//   heat_i       = 1/2 sum_j m_j Pi_ij v_ij . grad W_ij
// with grad W_ij = F x_ij, x_ij = x_i - x_j, and Monaghan's viscosity Pi on approach. With V_j = m_j/rho_j in the
// continuity equation, p/rho^2 d rho/dt is exactly the counterpart of the pressure force, pair by pair: kinetic plus
// internal energy is conserved to round-off by the space discretisation, whatever the density ratio (the paper's own
// continuity equation, sum m_j v_ij . grad W, is that only where all densities are equal).
// A wall's dummy particle shows i its own state, mirrored (wall_mirror.hpp).
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"
#include "sph_fluid/schemes/wall_mirror.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class T>
struct Monaghan {
  using V = Vec<T>;
  using State = FluidState<V>;
  using Wall = WallState<V>;
  using Sums = FluidSums<V>;
  static constexpr bool symmetric = true;
  static constexpr Partners partners = Partners::all;
  static constexpr bool by_distances = false;
  T alpha, beta;
  Weight<T> weight;

  explicit Monaghan(const PairInput& in) : alpha(T(in.alpha)), beta(T(in.beta)), weight(in) {}

  /// rho_i rho_j Pi of eq. 6 [Pa], and books the closing speed. `sound` and `density` are the SUMS over i and j;
  /// vr = v_ij . x_ij < 0 on approach.
  UNDEX_INLINE V viscosity(V vr, const Pair<V>& pair, V sound, V density, V product, V& closing) const {
    const V reach = pair.r2 + T(0.01) * (pair.h * pair.h);
    const V inverse = reciprocal(reach * density);
    const V mu = pair.h * minimum(vr, V{}) * (inverse * density);
    closing = keep(pair.in_reach, -mu);
    return product * mu * (2 * beta * mu - alpha * sound) * (inverse * reach);
  }

  /// A pair with its viscosity multiplied by `share`: the force, and what each side takes up of its work. Returns p*, which the
  /// force would have as -2 p* grad W.
  UNDEX_INLINE V exchange(const FluidState<V>& i, const FluidState<V>& j, const Pair<V>& pair, V share, Sums& si,
                          Sums& sj) const {
    const V vr = (i.vx - j.vx) * pair.dx + (i.vy - j.vy) * pair.dy + (i.vz - j.vz) * pair.dz;
    V closing;
    const V viscous = share * viscosity(vr, pair, i.c + j.c, i.rho + j.rho, i.rho * j.rho, closing);
    add_force(pair.F * (i.p + j.p + viscous), pair, i.volume, j.volume, si, sj);
    const V D = pair.F * vr, q = T(0.5) * viscous * D;
    si.compression += j.volume * D;
    sj.compression += i.volume * D;
    si.heat += j.volume * q;
    sj.heat += i.volume * q;
    si.closing = maximum(si.closing, closing);
    sj.closing = maximum(sj.closing, closing);
    return T(0.5) * (i.p + j.p + viscous);
  }

  /// The same against a wall. Returns the pressure between both.
  UNDEX_INLINE V wall_exchange(const FluidState<V>& i, const Wall& w, const Pair<V>& pair, V share, Sums& si,
                               WallSums<V>& sw) const {
    const WallPair<V> m = wall_pair(i, w, pair);
    V closing;
    const V viscous = share * viscosity(m.approach, pair, 2 * i.c, 2 * i.rho, i.rho * i.rho, closing);
    const V rise = weight.rise(i, pair);
    add_wall_force(pair.F * (2 * i.p + rise + viscous), m.ex, m.ey, m.ez, i.volume, w.volume, si, sw);
    const V D = pair.F * m.approach * w.volume;
    si.compression += D;
    si.heat += T(0.5) * (rise + viscous) * D;
    si.closing = maximum(si.closing, closing);
    return i.p + T(0.5) * (rise + viscous);
  }

  UNDEX_INLINE static V filling_share(const State&, const State&) { return broadcast(T(1)); }
  UNDEX_INLINE V pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums& sj) const {
    return exchange(i, j, pair, broadcast(T(1)), si, sj);
  }
  UNDEX_INLINE V wall(const State& i, const Wall& w, const Pair<V>& pair, Sums& si, WallSums<V>& sw) const {
    return wall_exchange(i, w, pair, broadcast(T(1)), si, sw);
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
