// A fluid particle in SIMD lanes, the geometry of a pair, and the sums that the schemes share.
#pragma once

#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/pairs/simd.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// Whom a pass pairs a particle with.
enum class Partners { all, own_body, other_bodies };

/// Two particles i and j (or i and a wall's particle): d = x_i - x_j, and F = (dW/dr)/r.
template <class V>
struct Pair {
  V dx, dy, dz, r2, h, F, W;  ///< W for passes over rings alone
  Mask<Element<V>> in_reach;  ///< within the kernel's support; F is zero elsewhere
  bool gas;                   ///< is one of them gas?
  bool alike;                 ///< are they of one material?
  Element<V> least_pressure;  ///< that both laws carry, <= 0 [Pa]
};

/// A fluid particle; `read(k)` gives entry k of its row.
template <class V>
struct FluidState {
  V vx, vy, vz, p, volume, rho, c;
  using Second = NoRow;

  template <class Read>
  UNDEX_INLINE void read(Read entry) {
    vx = entry(0), vy = entry(1), vz = entry(2), p = entry(3), volume = entry(4), rho = entry(5), c = entry(6);
  }
};

/// What a ring reads beside its rows; see RingRow.
template <class V>
struct RingState {
  V a, slope, share;

  template <class Read>
  UNDEX_INLINE void read_ring(Read entry) {
    a = entry(0), slope = entry(1), share = entry(2);
  }
};

template <class V>
struct WallState {
  V vx, vy, vz, nx, ny, nz, volume, slip;

  template <class Read>
  UNDEX_INLINE void read(Read entry) {
    vx = entry(0), vy = entry(1), vz = entry(2), nx = entry(3), ny = entry(4), nz = entry(5), volume = entry(6), slip = entry(7);
  }
};

/// See SumRow. A pair adds to i's and to j's.
template <class V>
struct FluidSums {
  V fx{}, fy{}, fz{}, compression{}, heat{}, closing{};
  static constexpr int count = sizeof(SumRow) / sizeof(double);
  static constexpr bool is_maximum(int k) { return k == 5; }

  template <class Visit>
  UNDEX_INLINE void each(Visit visit) {
    visit(fx, 0), visit(fy, 1), visit(fz, 2), visit(compression, 3), visit(heat, 4), visit(closing, 5);
  }
};

/// See ForceRow.
template <class V>
struct WallSums {
  V fx{}, fy{}, fz{};
  static constexpr int count = 3;
  static constexpr bool is_maximum(int) { return false; }

  template <class Visit>
  UNDEX_INLINE void each(Visit visit) {
    visit(fx, 0), visit(fy, 1), visit(fz, 2);
  }
};

/// Adds the force V_i V_j t d of a pair, seen from i's side, to the sums of both.
template <class V>
UNDEX_INLINE void add_force(V t, const Pair<V>& pair, V volume_i, V volume_j, FluidSums<V>& si, FluidSums<V>& sj) {
  const V ti = t * volume_j, tj = t * volume_i;
  si.fx -= ti * pair.dx;
  si.fy -= ti * pair.dy;
  si.fz -= ti * pair.dz;
  sj.fx += tj * pair.dx;
  sj.fy += tj * pair.dy;
  sj.fz += tj * pair.dz;
}

/// The same against a wall's particle, along e instead of d.
template <class V>
UNDEX_INLINE void add_wall_force(V t, V ex, V ey, V ez, V volume_i, V volume_w, FluidSums<V>& si, WallSums<V>& sw) {
  const V ti = t * volume_w, tw = ti * volume_i;
  si.fx -= ti * ex;
  si.fy -= ti * ey;
  si.fz -= ti * ez;
  sw.fx += tw * ex;
  sw.fy += tw * ey;
  sw.fz += tw * ez;
}

}  // namespace undex::sph::UNDEX_LEVEL
