// A Riemann problem per pair instead of an artificial viscosity. Along the unit vector e from i to j, u = v . e and p are
// carried to the middle from both sides with limited gradients (reconstruction.hpp, van Leer's limiter); an acoustic
// solver with impedances Z = rho c gives
//   p* = (pL + pR)/2 + b ZL ZR (uL - uR)/(ZL + ZR),      b = min(12 max(uL - uR, 0)/c, 1)
//   u* = (ZL uL + ZR uR + (pL - pR)/2)/(ZL + ZR)
// (the switch b is that of Zhang, Hu, Adams 2017, J. Comput. Phys. 335, doi 10.1016/j.jcp.2017.01.027, with 12 in place of 3:
// full dissipation at shocks, little in smooth flow), and the rates are
//   (d rho/dt)_i = 2 sum_j w_ij V_j (v_i . e - u*)(-F r)
//   (d v/dt)_i   = -2 sum_j m_j p*/(rho_i rho_j) grad W_ij
//   (d e/dt)_i   = 2 sum_j m_j p*/(rho_i rho_j) (v_i . e - u*)(-F r)
// The pair force and the pair work have one p* and one u*, so mass, momentum and total energy are conserved to round-off
// by the space discretisation; what of the work is not -p_i times the change of volume counts as heat. The weight w is rho_j
// where two particles of one material approach each other: the rate is then the time derivative of sum_j m_j W_ij, and the
// density behind a shock is that of the particles' distances, whatever happened within the front. Elsewhere w is rho_i, which
// is consistent across jumps of density and holds on in expansion (rho_j would keep an error of density constant while the
// density itself falls).
// In a pair with gas (or detonation products) the central parts are not reconstructed, only the dissipative parts are: the
// jump of density at a contact is not a gradient to be followed. Within one material they are plain averages; between two
//   central p = (rho_j p_i + rho_i p_j)/(rho_i + rho_j),      central u = (Z_i u_i + Z_j u_j)/(Z_i + Z_j)
// Across a contact the acceleration is continuous, not the gradient of p: the slopes of p are as the densities (Hu, Adams 2007,
// J. Comput. Phys. 227, doi 10.1016/j.jcp.2007.07.013), and the heavy side hardly feels the light one: the contact moves with
// it. Plain averages throw light gas off the water that drives it. p* is never less than what both laws carry: 0, or the
// tension of a liquid without cavitation (FluidLaw's least_pressure). In tension b is 1: particles on a lattice that pull at each
// other are unstable against moving in pairs (Swegle, Hicks, Attaway 1995, J. Comput. Phys. 116, 123), at a rate sqrt(-p/rho)/dx,
// which the full dissipation of the jump outruns by c over sqrt(-p/rho). Reconstruction keeps it away from smooth waves.
// In all pairs with gas all three rates carry the factor 2/(f_i + f_j), f being the filling (reconstruction.hpp) of gas and 1 of
// liquids. Without it (f = 1 for all) a volume that is wrong by a factor f changes f times as fast as its surroundings: after
// an expansion by f/(f - 1) it is infinite. One factor a pair: nothing is lost of conservation.
#pragma once

#include "sph_fluid/schemes/reconstruction.hpp"
#include "sph_fluid/schemes/wall_mirror.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// A fluid particle with its gradients (reconstruction.hpp).
template <class V>
struct ReconstructedState : FluidState<V> {
  V strain[6], climb[3], filling;
  using Second = GradientRow;

  template <class Read>
  UNDEX_INLINE void read_second(Read entry) {
    for (int k = 0; k < 6; ++k) strain[k] = entry(k);
    for (int k = 0; k < 3; ++k) climb[k] = entry(6 + k);
    filling = entry(9);
  }
};

template <class T>
struct Riemann {
  using V = Vec<T>;
  using State = ReconstructedState<V>;
  using Wall = WallState<V>;
  using Sums = FluidSums<V>;
  static constexpr bool symmetric = true;
  static constexpr Partners partners = Partners::all;
  static constexpr bool by_distances = true;  ///< the density of approaching particles of one material follows their distances

  Weight<T> weight;

  explicit Riemann(const PairInput& in) : weight(in) {}

  /// Half of van Leer's harmonic mean of the step a between two particles and the step 2 r - a beyond, r being a's particle's
  /// own gradient over their distance: a (2 r - a)/(2 r), zero where the steps disagree in sign.
  UNDEX_INLINE static V half_limited(V a, V r) {
    const V product = a * (2 * r - a);
    const Mask<T> agree = product > 0;
    return keep(agree, T(0.5) * product * reciprocal(agree ? r : broadcast(T(1))));
  }

  /// a - b of two rises of one sign, as far as they are alike: times (4ab/(a + b)^2)^2, which is 1 in a smooth wave and small at
  /// the corners of a front.
  UNDEX_INLINE static V even_part(V a, V b) {
    const V difference = a - b, sum = a + b, square = sum * sum;
    const Mask<T> some = square > T(1e-30);
    const V uneven = keep(some, difference * difference * reciprocal(some ? square : broadcast(T(1))));
    return difference * (1 - uneven) * (1 - uneven);
  }

  UNDEX_INLINE static V switched(V closing, V inverse_sound) { return minimum(12 * closing * inverse_sound, broadcast(T(1))); }

  /// p* of the central pressure, the switch b (`whole` where it is full) and Z times the jump; never below what the laws carry.
  UNDEX_INLINE static V star_pressure(V central, V b, V impedance, V jump, T least, V whole = broadcast(T(1))) {
    if (least < 0) b = central < 0 ? whole : b;
    return maximum(central + b * impedance * jump, broadcast(least));
  }

  /// Velocity of i relative to j along the pair, and the solution of its Riemann problem.
  struct Flux {
    V inverse_r, u, p_star, u_star;
  };

  /// `order` of a sum over pairs of the central parts, 2 or 4.
  template <int order>
  UNDEX_INLINE static Flux flux(const State& i, const State& j, const Pair<V>& pair) {
    const V dx = pair.dx, dy = pair.dy, dz = pair.dz;
    const V inverse_r = reciprocal_sqrt(pair.r2 + T(1e-30));
    // Velocities relative to v_i . e: the left one is zero, the right one is u.
    const V u = ((i.vx - j.vx) * dx + (i.vy - j.vy) * dy + (i.vz - j.vz) * dz) * inverse_r;
    const V dp = j.p - i.p;
    const V dx2 = 2 * dx, dy2 = 2 * dy;
    const V xx = dx * dx, yy = dy * dy, zz = dz * dz, xy = dx2 * dy, yz = dy2 * dz, zx = dx2 * dz;
    const auto rise = [&](const V(&s)[6]) {
      return (s[0] * xx + s[1] * yy + s[2] * zz + s[3] * xy + s[4] * yz + s[5] * zx) * inverse_r;
    };
    const auto climb = [&](const V(&g)[3]) { return -(g[0] * dx + g[1] * dy + g[2] * dz); };
    const V ui = half_limited(u, rise(i.strain)), uj = half_limited(u, rise(j.strain));
    const V pi = half_limited(dp, climb(i.climb)), pj = half_limited(dp, climb(j.climb));
    const V uL = ui, uR = u - uj, pL = i.p + pi, pR = j.p - pj;

    const V Zi = i.rho * i.c, Zj = j.rho * j.c, rho = i.rho + j.rho;
    const V inverse_Z = reciprocal(Zi + Zj);
    const V jump = uL - uR;
    const V closing = maximum(jump, V{});
    const V b = switched(closing, rho * inverse_Z);
    V central_p = T(0.5) * (pL + pR), central_u = (Zi * uL + Zj * uR) * inverse_Z;
    if constexpr (order == 4) {
      const V sixth = T(1.0 / 6) * (1 - b);
      central_p -= sixth * even_part(pi, pj);
      central_u -= sixth * even_part(ui, uj);
    }
    if (pair.gas) {
      central_p = pair.alike ? T(0.5) * (i.p + j.p) : (j.rho * i.p + i.rho * j.p) * reciprocal(rho);
      central_u = pair.alike ? T(0.5) * u : Zj * u * inverse_Z;
    }
    const V p_star = star_pressure(central_p, b, Zi * Zj * inverse_Z, jump, pair.least_pressure);
    const V u_star = central_u + T(0.5) * (pL - pR) * inverse_Z;
    return {inverse_r, u, p_star, u_star};
  }

  /// By what the rates of pairs with gas are multiplied.
  UNDEX_INLINE static V filling_share(const State& i, const State& j) { return 2 * reciprocal(i.filling + j.filling); }

  /// Returns p*.
  UNDEX_INLINE V pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums& sj) const {
    return exchange<2>(i, j, pair, pair.gas ? 2 * pair.F * filling_share(i, j) : 2 * pair.F, broadcast(T(1)), si, sj);
  }

  /// What the two give each other, with central parts as in `flux` and a slope F for force and energy; the part of the density
  /// rate that follows their distance has `own` times F. Returns p*.
  template <int order>
  UNDEX_INLINE static V exchange(const State& i, const State& j, const Pair<V>& pair, V F, V own, Sums& si, Sums& sj) {
    const auto [inverse_r, u, p_star, u_star] = flux<order>(i, j, pair);
    add_force(F * p_star, pair, i.volume, j.volume, si, sj);
    const V Fr = F * (pair.r2 * inverse_r);
    const V Di = j.volume * (Fr * u_star), Dj = i.volume * (Fr * (u - u_star));
    V Ci = Di, Cj = Dj;  // of the density: with the weight w
    if (pair.alike) {
      const Mask<T> approach = u < 0;
      const V inverse = own * reciprocal(i.rho * j.rho);
      Ci = approach ? Di * (j.rho * j.rho * inverse) : Di;
      Cj = approach ? Dj * (i.rho * i.rho * inverse) : Dj;
    }
    si.compression += Ci;
    sj.compression += Cj;
    si.heat += Di * p_star - Ci * i.p;
    sj.heat += Dj * p_star - Cj * j.p;
    const V speed = keep(pair.in_reach, -u);
    si.closing = maximum(si.closing, speed);
    sj.closing = maximum(sj.closing, speed);
    return p_star;
  }

  /// Against the mirrored state: p* = p + b Z (closing speed)/2, p halfway to the wall's, and u* the wall's own. Returns p*.
  UNDEX_INLINE V wall(const State& i, const Wall& w, const Pair<V>& pair, Sums& si, WallSums<V>& sw) const {
    const WallPair<V> m = wall_pair(i, w, pair);
    const V jump = -m.approach * reciprocal_sqrt(pair.r2 + T(1e-30));
    const V p_star =
        star_pressure(i.p + T(0.5) * weight.rise(i, pair), T(0.5) * switched(maximum(jump, V{}), reciprocal(i.c)) * i.rho, i.c,
                      jump, pair.least_pressure, T(0.5) * i.rho);
    add_wall_force(2 * pair.F * p_star, m.ex, m.ey, m.ez, i.volume, w.volume, si, sw);
    const V D = pair.F * w.volume * m.approach;
    si.compression += D;
    si.heat += D * (p_star - i.p);
    si.closing = maximum(si.closing, keep(pair.in_reach, jump));
    return p_star;
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
