// The Riemann scheme with corrected kernel gradients, symmetrically (Vila 1999, Math. Models Methods Appl. Sci. 9, 161):
//   g_ij = (B_i + B_j)/2 grad W_ij,   B = M^-1 with the moment matrix M of reconstruction.hpp
// p* and u* are those of riemann.hpp, and with v* = (v_i + v_j)/2 + (u* - (u_i + u_j)/2) e
//   (d rho/dt)_i = 2 rho_i sum_j V_j (v_i - v*) . g_ij
//   (d v/dt)_i   = -2 sum_j m_j p*/(rho_i rho_j) g_ij
//   (d e/dt)_i   = 2 sum_j m_j p*/(rho_i rho_j) (v_i - v*) . g_ij
// but where two particles of one material approach each other their part of the density rate is that of riemann.hpp,
//   2 m_j (v_i . e - u*)(-F r)
// the time derivative of sum_j m_j W_ij, with the kernel's own gradient: B, made of the volumes that are carried, would divide
// out by how much these differ from the space there is, and an error of density within a shock's front would stay. g_ij = -g_ji,
// and force and work have one p* and one v*: mass, momentum and total energy are conserved to round-off. g_ij does not lie along
// the pair, so angular momentum is not. Sums over the space that neighbours fill come out right whatever the lattice factor, near
// walls, and where the volumes claim more or less than the space there is: B is then 1/f times what it was, which is why there is
// no filling factor here. B fades into 1 where det M falls from 0.6 to 0.3: few neighbours have no inverse, and a free surface
// (the outer layer of a lattice has 0.28, the next 0.83) would become as much stiffer as B is larger. Against a wall, whose
// mirrored state has no moments of its own, g = B_i grad W.
#pragma once

#include "sph_fluid/schemes/riemann.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// The gradients' pass, which also keeps B.
template <class T>
struct CorrectedReconstruction : Reconstruction<T> {
  using Base = Reconstruction<T>;
  using Base::Base;

  /// See Reconstruction.
  UNDEX_INLINE static GradientRow& gradient_row(void* rows, std::uint32_t k) {
    return static_cast<CorrectedRow*>(rows)[k].gradient;
  }
  /// B is 1/f of the volumes in the plane.
  UNDEX_INLINE static float divisor(const void* rows, std::uint32_t k) {
    const auto& B = static_cast<const CorrectedRow*>(rows)[k].correction;
    return 2.0f / (B[0] + B[1]);
  }

  void store(const Vec<double>* s, bool gas, const PairInput& in, std::uint32_t first, int count) const {
    using D = Vec<double>;
    GradientRow plain[lanes<double>];
    PairInput own = in;
    own.second = plain;
    Base::store(s, gas, own, 0, count);
    const D one = broadcast(1.0), zero{};
    const Adjugate<D> a = adjugate(s, this->dimension, one);
    constexpr double none = 0.3, whole = 0.6;  // of the determinant
    const D trust = minimum(maximum((a.determinant - none) * (1.0 / (whole - none)), zero), one), rest = one - trust;
    const D inverse = trust / (a.determinant > none ? a.determinant : one);
    const D B[6] = {a.xx * inverse + rest, a.yy * inverse + rest, a.zz * inverse + rest,
                    a.xy * inverse,        a.yz * inverse,        a.zx * inverse};
    for (int l = 0; l < count; ++l) {
      CorrectedRow& out = static_cast<CorrectedRow*>(in.second)[first + l];
      out.gradient = plain[l];
      for (int k = 0; k < 6; ++k) out.correction[k] = float(B[k][l]);
    }
  }
};

/// A fluid particle with its gradients and B.
template <class V>
struct CorrectedState : ReconstructedState<V> {
  V B[6];
  using Second = CorrectedRow;

  template <class Read>
  UNDEX_INLINE void read_second(Read entry) {
    ReconstructedState<V>::read_second(entry);
    for (int k = 0; k < 6; ++k) B[k] = entry(length_of<GradientRow> + k);
  }
};

template <class T>
struct RiemannCorrected {
  using V = Vec<T>;
  using State = CorrectedState<V>;
  using Wall = WallState<V>;
  using Sums = FluidSums<V>;
  using Plain = Riemann<T>;
  static constexpr bool symmetric = true;
  static constexpr Partners partners = Partners::all;
  static constexpr bool by_distances = true;

  Weight<T> weight;

  explicit RiemannCorrected(const PairInput& in) : weight(in) {}

  /// The pair with S d in place of d, S symmetric (xx, yy, zz, xy, yz, zx).
  UNDEX_INLINE static Pair<V> bent(const Pair<V>& pair, const V (&S)[6]) {
    Pair<V> g = pair;
    g.dx = S[0] * pair.dx + S[3] * pair.dy + S[5] * pair.dz;
    g.dy = S[3] * pair.dx + S[1] * pair.dy + S[4] * pair.dz;
    g.dz = S[5] * pair.dx + S[4] * pair.dy + S[2] * pair.dz;
    return g;
  }

  /// Of what has no gradient for B to correct: the hoops of rings.
  UNDEX_INLINE static V filling_share(const State& i, const State& j) { return Plain::filling_share(i, j); }

  /// Returns p*.
  UNDEX_INLINE V pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums& sj) const {
    const auto [inverse_r, u, p_star, u_star] = Plain::flux(i, j, pair);
    V S[6];
    for (int k = 0; k < 6; ++k) S[k] = i.B[k] + j.B[k];
    const Pair<V> g = bent(pair, S);
    add_force(pair.F * p_star, g, i.volume, j.volume, si, sj);
    const V shared = (T(0.5) * pair.F) * ((i.vx - j.vx) * g.dx + (i.vy - j.vy) * g.dy + (i.vz - j.vz) * g.dz);
    const V apart = pair.F * inverse_r * (pair.dx * g.dx + pair.dy * g.dy + pair.dz * g.dz) * (u_star - T(0.5) * u);
    const V Di = j.volume * (shared + apart), Dj = i.volume * (shared - apart);
    V Ci = Di, Cj = Dj;  // of the density
    if (pair.alike) {
      const Mask<T> approach = u < 0;
      const V Fr = 2 * pair.F * (pair.r2 * inverse_r);
      Ci = approach ? j.volume * j.rho * reciprocal(i.rho) * (Fr * u_star) : Di;
      Cj = approach ? i.volume * i.rho * reciprocal(j.rho) * (Fr * (u - u_star)) : Dj;
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

  /// As in riemann.hpp, with the wall's velocity for v*. Returns p*.
  UNDEX_INLINE V wall(const State& i, const Wall& w, const Pair<V>& pair, Sums& si, WallSums<V>& sw) const {
    const V jump = -wall_pair(i, w, pair).approach * reciprocal_sqrt(pair.r2 + T(1e-30));
    const V p_star = Plain::star_pressure(i.p + T(0.5) * weight.rise(i, pair),
                                          T(0.5) * Plain::switched(maximum(jump, V{}), reciprocal(i.c)) * i.rho, i.c, jump,
                                          pair.least_pressure, T(0.5) * i.rho);
    const WallPair<V> g = wall_pair(i, w, bent(pair, i.B));
    add_wall_force(2 * pair.F * p_star, g.ex, g.ey, g.ez, i.volume, w.volume, si, sw);
    const V D = pair.F * w.volume * g.approach;
    si.compression += D;
    si.heat += D * (p_star - i.p);
    si.closing = maximum(si.closing, keep(pair.in_reach, jump));
    return p_star;
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
