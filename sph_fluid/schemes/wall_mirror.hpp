// What a wall's dummy particle does to a pair: the mirrored velocity difference, the direction of the force, and under gravity
// the pressure of its own place.
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// How much of the motion along all axes a wall particle takes part in, beside `slip` times that along its normal.
template <class V>
UNDEX_INLINE V stick_of(V slip) {
  return slip > 0 ? V{} : broadcast(Element<V>(1));
}

/// v_ij . x_ij with the fluid particle's velocity mirrored about the wall's (wholly for no slip, its normal part for free
/// slip), and the part of x_ij along which the pair force acts (all of it, or the normal part only: then the work done on
/// the wall is exactly the energy that the fluid gives). Behind an edge of two free-slip faces both see what is across the
/// edge, behind a corner of three all of it.
template <class V>
struct WallPair {
  V approach;    ///< v_ij . x_ij [m^2/s]
  V ex, ey, ez;  ///< [m]
};

template <class V>
UNDEX_INLINE WallPair<V> wall_pair(const FluidState<V>& i, const WallState<V>& w, const Pair<V>& pair) {
  const V ux = i.vx - w.vx, uy = i.vy - w.vy, uz = i.vz - w.vz;
  const V stick = stick_of(w.slip);
  const V un = w.slip * (ux * w.nx + uy * w.ny + uz * w.nz);
  const V xn = w.slip * (pair.dx * w.nx + pair.dy * w.ny + pair.dz * w.nz);
  WallPair<V> m;
  m.approach = 2 * ((un * w.nx + stick * ux) * pair.dx + (un * w.ny + stick * uy) * pair.dy + (un * w.nz + stick * uz) * pair.dz);
  m.ex = xn * w.nx + stick * pair.dx;
  m.ey = xn * w.ny + stick * pair.dy;
  m.ez = xn * w.nz + stick * pair.dz;
  return m;
}

/// By what the pressure at rest under gravity rises from a particle to a wall's.
template <class T>
struct Weight {
  T gx, gy, gz;

  explicit Weight(const PairInput& in) : gx(T(in.gravity[0])), gy(T(in.gravity[1])), gz(T(in.gravity[2])) {}
  UNDEX_INLINE Vec<T> rise(const FluidState<Vec<T>>& i, const Pair<Vec<T>>& pair) const {
    return -i.rho * (gx * pair.dx + gy * pair.dy + gz * pair.dz);
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
