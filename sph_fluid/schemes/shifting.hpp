// What particles are shifted by: the gradient of their concentration,
//   grad C_i = sum_j V_j grad W_ij   (walls included, which fill their space)
// down which they diffuse towards even spacing (Lind, Xu, Stansby, Rogers 2012, J. Comput. Phys. 231, 1499). It is held back
// where there is nobody to keep even with: by the filling sum_j V_j x_ij . grad W_ij/-d, from 0.9 down to 0.75 (Lee et al. 2008,
// J. Comput. Phys. 227, the mark of a free surface), and near other bodies by their share of that sum, gone at a fifth.
// How far the particles then go is in solver_step.cpp.
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class T>
struct Concentration {
  using V = Vec<T>;
  using State = FluidState<V>;
  using Wall = WallState<V>;
  struct Sums {
    V x{}, y{}, z{}, moment{}, foreign{};
    static constexpr int count = 5;
    static constexpr bool is_maximum(int) { return false; }

    template <class Visit>
    UNDEX_INLINE void each(Visit visit) {
      visit(x, 0), visit(y, 1), visit(z, 2), visit(moment, 3), visit(foreign, 4);
    }
  };
  static constexpr bool symmetric = false;
  static constexpr Partners partners = Partners::all;
  int dimension;

  explicit Concentration(const PairInput& in) : dimension(in.dimension) {}

  UNDEX_INLINE static void add(const Pair<V>& pair, V volume, Sums& s) {
    const V FV = pair.F * volume, moment = FV * pair.r2;
    s.x += FV * pair.dx;
    s.y += FV * pair.dy;
    s.z += FV * pair.dz;
    s.moment -= moment;
    if (pair.foreign) s.foreign -= moment;
  }
  UNDEX_INLINE void pair(const State&, const State& j, const Pair<V>& pair, Sums& si, Sums&) const { add(pair, j.volume, si); }
  UNDEX_INLINE void wall(const State&, const Wall& w, const Pair<V>& pair, Sums& si, WallSums<V>&) const {
    add(pair, w.volume, si);
  }

  void store(const Vec<double>* s, bool, const PairInput& in, std::uint32_t first, int count) const {
    using D = Vec<double>;
    const D one = broadcast(1.0), zero{};
    const auto share = [&](D a) { return minimum(maximum(a, zero), one); };
    const D filled = share((s[3] * (1.0 / dimension) - 0.75) / 0.15);
    const D trust = filled * share(1.0 - 5.0 * s[4] / (s[3] > 0.0 ? s[3] : one));
    for (int l = 0; l < count; ++l)
      in.concentration[first + l] = {float(trust[l] * s[0][l]), float(trust[l] * s[1][l]), float(trust[l] * s[2][l])};
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
