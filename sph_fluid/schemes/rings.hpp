// Pair schemes over rings about an axis: what pairs/ring_kernel.hpp makes of a scheme of the plane. In the meridian a scheme's
// rates keep their form, with (a_i + a_j)/2 grad W in place of grad W and the volumes of whole rings; the rest of dK is the
// hoop's:
//   (d v_r/dt)_i  = -(1/rho_i) sum_j V_j p* w slope_i
//   hoop_ij       = w/2 (slope_i v_ri + slope_j v_rj),       a part of the rate of volume like any other:
//   (d rho/dt)_i  += -rho_i sum_j V_j hoop_ij,   (d e/dt)_i += -sum_j V_j p*/rho_i hoop_ij
// with w = W over its lattice sum, divided by the filling of gas as in riemann.hpp. Work and force have one p* a pair: momentum
// along the axis and energy are conserved to round-off, whatever slope is. A ring is its own neighbour: the loop meets it with
// half a weight from either side. Images in walls count as half a neighbour. One in a wall along the axis has no hoop, which
// would be turned round on its way back to the particle that it shows: i feels its own whole. There are no dummy particles.
#pragma once

#include "sph_fluid/schemes/reconstruction.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// A particle's state as that of a ring. In the meridian it has no third velocity: there the row has its area.
template <class Base, class V>
struct StateOfRing : Base, RingState<V> {
  V area;

  template <class Read>
  UNDEX_INLINE void read(Read entry) {
    Base::read(entry);
    area = this->vz;
    this->vz = V{};
  }
};

/// What a ring sees of the kernel at no distance, times h^2.
inline double middle_of_kernel(const PairInput& in) {
  const double shape = with_kernel(in.kernel.name, [](auto kernel) UNDEX_LAMBDA_INLINE {
    double slope;
    if constexpr (decltype(kernel)::needs_root) slope = kernel.template gradient_of_root<double>(0.0);
    else slope = kernel.template gradient<double>(0.0);
    return kernel.template shape_beside<double>(0.0, slope);
  });
  return in.shape_scale * in.kernel.norm * shape;
}

/// Gradients are those of the meridian: areas for volumes. The filling of gas is at least what a ring claims by itself, V_i K_ii.
/// It is its own neighbour: alone, with h at its bound, it would else grow by ever more.
template <class T, template <class> class Gradients>
struct GradientsOfRings : Gradients<T> {
  using V = Vec<T>;
  using Gradients<T>::Gradients;
  struct State : FluidState<V> {
    template <class Read>
    UNDEX_INLINE void read(Read entry) {
      FluidState<V>::read(entry);
      this->volume = this->vz;
      this->vz = V{};
    }
  };

  void store(const Vec<double>* s, bool gas, const PairInput& in, std::uint32_t first, int count) const {
    Gradients<T>::store(s, gas, in, first, count);
    if (!gas) return;
    const double middle = middle_of_kernel(in);
    for (std::uint32_t k = first; k < first + count; ++k) {
      const FluidRow& own = in.fluid[k];
      Gradients<T>::fill(in.second, k, float(own.volume * in.rings[k].a * middle / (own.h * own.h)));
    }
  }
};

template <class T, template <class> class Scheme>
struct RatesOfRings : Scheme<T> {
  using V = Vec<T>;
  using Plane = Scheme<T>;
  using State = StateOfRing<typename Plane::State, V>;
  using Sums = typename Plane::Sums;
  using Plane::Plane;
  static constexpr bool rings = true;

  UNDEX_INLINE void pair(const State& i, const State& j, Pair<V> pair, Sums& si, Sums& sj) const {
    V w = pair.W;
    if (pair.gas) w *= Plane::filling_share(i, j);
    pair.F *= T(0.5) * (i.a + j.a);
    const V p_star = Plane::pair(i, j, pair, si, sj);

    const V slope = (2 - j.share) * i.slope, lent = T(0.5) * j.share * i.slope, back = T(0.5) * j.slope;
    const V Di = j.volume * w * ((slope - lent) * i.vx + back * j.vx);
    const V Dj = i.volume * w * (back * j.vx + lent * i.vx);
    si.fx -= j.volume * w * slope * p_star;
    sj.fx -= i.volume * w * j.slope * p_star;
    V Ci = Di, Cj = Dj;
    if (Plane::by_distances && pair.alike) {
      const Mask<T> approach = (i.vx - j.vx) * pair.dx + (i.vy - j.vy) * pair.dy < 0;
      const V inverse = reciprocal(i.rho * j.rho);
      Ci = approach ? Di * (j.rho * j.rho * inverse) : Di;
      Cj = approach ? Dj * (i.rho * i.rho * inverse) : Dj;
    }
    si.compression += Ci;
    sj.compression += Cj;
    si.heat += Di * p_star - Ci * i.p;
    sj.heat += Dj * p_star - Cj * j.p;
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
