// Gradients of velocity and pressure for schemes that reconstruct: first-order exact for any arrangement of neighbours,
// by the inverse of the moment matrix M = - sum_j V_j x_ij x_ij^T F. Its trace over the dimension is the filling: 1 where the
// volumes of the neighbours fill the space they are in, 2 where they claim it twice.
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"
#include "sph_fluid/pairs/moment_inverse.hpp"
#include "sph_fluid/schemes/wall_mirror.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class T>
struct Reconstruction {
  using V = Vec<T>;
  using State = FluidState<V>;
  using Wall = WallState<V>;
  struct Sums {
    V xx{}, yy{}, zz{}, xy{}, yz{}, zx{};  // moment matrix
    V v[9] = {};                           // sum V_j (v_j - v_i)_a (x_ij)_b F, at 3a + b
    V p[3] = {};                           // sum V_j (p_j - p_i) (x_ij)_b F
    static constexpr int count = 18;
    static constexpr bool is_maximum(int) { return false; }

    template <class Visit>
    UNDEX_INLINE void each(Visit visit) {
      visit(xx, 0), visit(yy, 1), visit(zz, 2), visit(xy, 3), visit(yz, 4), visit(zx, 5);
      for (int k = 0; k < 9; ++k) visit(v[k], 6 + k);
      for (int k = 0; k < 3; ++k) visit(p[k], 15 + k);
    }
  };
  static constexpr bool symmetric = false;
  static constexpr Partners partners = Partners::all;
  int dimension;
  Weight<T> weight;

  explicit Reconstruction(const PairInput& in) : dimension(in.dimension), weight(in) {}

  UNDEX_INLINE static void add(V ux, V uy, V uz, V dp, const Pair<V>& pair, V volume, Sums& s) {
    const V FV = pair.F * volume;
    const V wx = FV * pair.dx, wy = FV * pair.dy, wz = FV * pair.dz;
    s.xx -= pair.dx * wx;
    s.yy -= pair.dy * wy;
    s.zz -= pair.dz * wz;
    s.xy -= pair.dx * wy;
    s.yz -= pair.dy * wz;
    s.zx -= pair.dz * wx;
    s.v[0] += ux * wx;
    s.v[1] += ux * wy;
    s.v[2] += ux * wz;
    s.v[3] += uy * wx;
    s.v[4] += uy * wy;
    s.v[5] += uy * wz;
    s.v[6] += uz * wx;
    s.v[7] += uz * wy;
    s.v[8] += uz * wz;
    s.p[0] += dp * wx;
    s.p[1] += dp * wy;
    s.p[2] += dp * wz;
  }

  UNDEX_INLINE void pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums&) const {
    add(j.vx - i.vx, j.vy - i.vy, j.vz - i.vz, j.p - i.p, pair, j.volume, si);
  }

  /// The mirrored state: the same pressure (but for the weight between), velocity mirrored about the wall's.
  UNDEX_INLINE void wall(const State& i, const Wall& w, const Pair<V>& pair, Sums& si, WallSums<V>&) const {
    const V stick = stick_of(w.slip);
    const V ux = i.vx - w.vx, uy = i.vy - w.vy, uz = i.vz - w.vz;
    const V un = w.slip * (ux * w.nx + uy * w.ny + uz * w.nz);
    add(-2 * (un * w.nx + stick * ux), -2 * (un * w.ny + stick * uy), -2 * (un * w.nz + stick * uz), weight.rise(i, pair), pair,
        w.volume, si);
  }

  /// Raises the filling of particle k in the rows that `store` has written.
  UNDEX_INLINE static void fill(void* rows, std::uint32_t k, float least) {
    float& filling = static_cast<GradientRow*>(rows)[k].filling;
    if (filling < least) filling = least;
  }

  /// Gradients of up to a vector of particles from their sums, in the order of Sums.
  void store(const Vec<double>* s, bool gas, const PairInput& in, std::uint32_t first, int count) const {
    GradientRow* out = static_cast<GradientRow*>(in.second) + first;
    using D = Vec<double>;
    const D one = broadcast(1.0), half = broadcast(double(least_filling));
    const D filling = gas ? maximum((s[0] + s[1] + s[2]) * (1.0 / dimension), half) : one;
    // Where neighbours are too few or in a plane, the uncorrected sum stands.
    const Adjugate<D> a = adjugate(s, dimension, one);
    const Mask<double> good = a.determinant > 0.05;
    const D inverse = 1.0 / (good ? a.determinant : one);
    const D xy = keep(good, a.xy * inverse), yz = keep(good, a.yz * inverse), zx = keep(good, a.zx * inverse);
    const D B[3][3] = {
        {good ? a.xx * inverse : one, xy, zx}, {xy, good ? a.yy * inverse : one, yz}, {zx, yz, good ? a.zz * inverse : one}};
    D g[3][3], p[3];
    for (int r = 0; r < 3; ++r) {
      for (int q = 0; q < 3; ++q) g[r][q] = s[6 + 3 * r] * B[0][q] + s[7 + 3 * r] * B[1][q] + s[8 + 3 * r] * B[2][q];
      p[r] = s[15] * B[0][r] + s[16] * B[1][r] + s[17] * B[2][r];
    }
    for (int l = 0; l < count; ++l) {
      for (int r = 0; r < 3; ++r) {
        out[l].strain[r] = float(g[r][r][l]);
        out[l].strain[3 + r] = float(0.5 * (g[r][(r + 1) % 3][l] + g[(r + 1) % 3][r][l]));
        out[l].pressure[r] = float(p[r][l]);
      }
      out[l].filling = float(filling[l]);
    }
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
