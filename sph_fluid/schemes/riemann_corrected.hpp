// The Riemann scheme with kernel gradients corrected along the pair: those of riemann.hpp times
//   c_ij = 2/(n_i + n_j),   n_i = e . N_i e
// for force, density and energy alike, and with central parts of p* and u* of which sums over pairs are of fourth order: less a
// sixth of how much more i carries to the middle than j. Of two alike they then take the share q = 1/3 of the limited rises from
// either side, where riemann.hpp takes a half. A wave exp(i k x) with s = k r gives
//   sin s + q s (1 - cos s) = s + (q/2 - 1/6) s^3 + O(s^5)
// At fronts (b, and rises that are not alike) they are those of riemann.hpp: with C2 a plane shock overshoots by no more.
// With C4 at h = 1.3 dx a half makes sound of 8 spacings 5 % fast and of 12 spacings 2 %: what runs ahead widens a front and
// takes away its peak. With a third these errors are 0.3 % and 0.1 %.
// N is the moment matrix M of reconstruction.hpp in liquids, the filling f times 1 in gas.
// M is 1 where the neighbours see space as a continuum would. Where a flow has drawn the particles apart along one axis and
// together along another, at curved walls above all, sums over them are wrong by n along each direction, and so is the speed of
// sound. The correction is one factor a pair and leaves the force on the line between the two, so mass, momentum, angular
// momentum and total energy are conserved to round-off. (M^-1 grad W corrects as much and keeps no angular momentum.)
// The part of the density rate that follows the particles' distances (two of one material that approach each other) has c_ij = 1:
// it is the time derivative of sum_j m_j W_ij with the kernel's own gradient. M, made of the volumes that are carried, would
// divide out by how much these differ from the space there is, and an error of density within a shock's front would stay.
// N fades into 1 where det M falls from 0.6 to 0.3: a free surface (the outer layer of a lattice has 0.28, the next 0.83) would
// become as much stiffer as n is smaller. Against a wall, whose mirrored state has no moments of its own, c = 1/n_i.
#pragma once

#include "sph_fluid/schemes/riemann.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// The gradients' pass, which also keeps N.
template <class T>
struct CorrectedReconstruction : Reconstruction<T> {
  using Base = Reconstruction<T>;
  using Base::Base;

  /// See Reconstruction.
  UNDEX_INLINE static void fill(void* rows, std::uint32_t k, float least) {
    CorrectedRow& row = static_cast<CorrectedRow*>(rows)[k];
    if (row.gradient.filling >= least) return;
    row.gradient.filling = least;
    for (int a = 0; a < 3; ++a) row.moment[a] = least;
  }

  void store(const Vec<double>* s, bool gas, const PairInput& in, std::uint32_t first, int count) const {
    using D = Vec<double>;
    GradientRow plain[lanes<double>];
    PairInput own = in;
    own.second = plain;
    Base::store(s, gas, own, 0, count);
    const D one = broadcast(1.0), zero{};
    constexpr double none = 0.3, whole = 0.6;  // of the determinant
    const D determinant = adjugate(s, this->dimension, one).determinant;
    const D trust = minimum(maximum((determinant - none) * (1.0 / (whole - none)), zero), one);
    D N[6];
    for (int k = 0; k < 6; ++k) {
      const double unit = k < 3 ? 1.0 : 0.0;
      N[k] = k < this->dimension || k >= 3 ? unit + trust * (s[k] - unit) : one;
    }
    for (int l = 0; l < count; ++l) {
      CorrectedRow& out = static_cast<CorrectedRow*>(in.second)[first + l];
      out.gradient = plain[l];
      for (int k = 0; k < 6; ++k) out.moment[k] = !gas ? float(N[k][l]) : k < 3 ? plain[l].filling : 0.0f;
    }
  }
};

/// A fluid particle with its gradients and N.
template <class V>
struct CorrectedState : ReconstructedState<V> {
  V moment[6];
  using Second = CorrectedRow;

  template <class Read>
  UNDEX_INLINE void read_second(Read entry) {
    ReconstructedState<V>::read_second(entry);
    for (int k = 0; k < 6; ++k) moment[k] = entry(length_of<GradientRow> + k);
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

  Plain plain;

  explicit RiemannCorrected(const PairInput& in) : plain(in) {}

  /// e . N e along the pair.
  UNDEX_INLINE static V along(const Pair<V>& pair, const V (&N)[6]) {
    const V x = N[0] * pair.dx + 2 * (N[3] * pair.dy + N[5] * pair.dz), y = N[1] * pair.dy + 2 * N[4] * pair.dz;
    return (x * pair.dx + y * pair.dy + N[2] * pair.dz * pair.dz) * reciprocal(pair.r2 + T(1e-30));
  }

  UNDEX_INLINE static V filling_share(const State& i, const State& j) { return Plain::filling_share(i, j); }

  /// Returns p*.
  UNDEX_INLINE V pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums& sj) const {
    V N[6];
    for (int k = 0; k < 6; ++k) N[k] = T(0.5) * (i.moment[k] + j.moment[k]);
    // A ring is its own neighbour: no direction, no slope.
    const V n = pair.r2 > 0 ? along(pair, N) : broadcast(T(1));
    return Plain::template exchange<4>(i, j, pair, 2 * pair.F * reciprocal(n), n, si, sj);
  }

  /// As in riemann.hpp. Returns p*.
  UNDEX_INLINE V wall(const State& i, const Wall& w, Pair<V> pair, Sums& si, WallSums<V>& sw) const {
    pair.F *= reciprocal(along(pair, i.moment));
    return plain.wall(i, w, pair, si, sw);
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
