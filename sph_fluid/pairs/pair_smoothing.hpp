// The kernel of a pair: which one, and F and W of it for one h of all pairs or for h_ij of each. Part of the loop
// (cluster_work.hpp), compiled with it once per instruction set.
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"
#include "sph_fluid/pairs/kernels.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// Any of the kernels, chosen by the input: one loop serves them all, for a branch that is the same for every pair
/// (docs/results/performance.md has its price). The others are known where the loop is compiled.
struct AnyKernel {
  KernelName which;
  double support, scale;
  static constexpr bool needs_root = true;

  double norm(int) const { return scale; }
  template <class T, class V>
  UNDEX_INLINE V gradient_of_root(V q) const {
    const V inside = minimum(q, broadcast(T(support)));
    return with_kernel(which, [&](auto kernel) UNDEX_LAMBDA_INLINE {
      if constexpr (decltype(kernel)::needs_root) return kernel.template gradient_of_root<T>(inside);
      else return kernel.template gradient<T>(inside * inside);
    });
  }
  template <class T, class V>
  UNDEX_INLINE V shape_beside(V q, V f) const {
    const V inside = minimum(q, broadcast(T(support)));
    return with_kernel(which, [&](auto kernel) UNDEX_LAMBDA_INLINE { return kernel.template shape_beside<T>(inside, f); });
  }
};

inline AnyKernel kernel_of(const PairInput& in, const AnyKernel*) { return {in.kernel.name, in.kernel.support, in.kernel.norm}; }
template <class Kernel>
UNDEX_INLINE Kernel kernel_of(const PairInput&, const Kernel*) {
  return {};
}

namespace {

double power(double a, int n) {
  double result = 1.0;
  for (int k = 0; k < n; ++k) result *= a;
  return result;
}

/// F(r, h) of the kernel; h one number for all pairs.
template <class Kernel, class T>
struct ConstantH {
  using V = Vec<T>;
  Kernel kernel;
  T h_, inverse_h, scale, reach2, shape_scale;

  ConstantH(const Kernel& k, double h, const PairInput& in)
      : kernel(k),
        h_(T(h)),
        inverse_h(T(1.0 / h)),
        scale(T(in.kernel_scale * k.norm(in.dimension) / power(h, in.dimension + 2))),
        reach2(T(k.support * k.support * h * h)),
        shape_scale(T(in.shape_scale * k.norm(in.dimension) / power(h, in.dimension))) {}
  template <bool with_shape>
  UNDEX_INLINE void evaluate(Pair<V>& pair, const T*) const {
    pair.h = broadcast(h_);
    pair.in_reach = pair.r2 < reach2;
    V q{}, f;
    if constexpr (Kernel::needs_root) {
      const V s2 = pair.r2 + T(1e-30);
      q = s2 * reciprocal_sqrt(s2) * inverse_h;
      f = kernel.template gradient_of_root<T>(q);
    } else {
      f = kernel.template gradient<T>(pair.r2 * (inverse_h * inverse_h));
    }
    pair.F = keep(pair.in_reach, scale * f);
    if constexpr (with_shape) pair.W = keep(pair.in_reach, shape_scale * kernel.template shape_beside<T>(q, f));
  }
};

/// The same with h_ij = (h_i + h_j)/2, a number per pair.
template <class Kernel, class T>
struct PairH {
  using V = Vec<T>;
  Kernel kernel;
  T h_i, norm, shape_norm;
  int dimension;

  PairH(const Kernel& k, double h, const PairInput& in)
      : kernel(k),
        h_i(T(h)),
        norm(T(in.kernel_scale * k.norm(in.dimension))),
        shape_norm(T(in.shape_scale * k.norm(in.dimension))),
        dimension(in.dimension) {}
  template <bool with_shape>
  UNDEX_INLINE void evaluate(Pair<V>& pair, const T* h_j) const {
    const T support = T(kernel.support);
    const V h = T(0.5) * (h_i + load(h_j));
    pair.h = h;
    pair.in_reach = pair.r2 < support * support * (h * h);
    const V inverse_h = reciprocal(h);
    V scale = norm * (inverse_h * inverse_h * inverse_h);
    if (dimension > 1) scale *= inverse_h;
    if (dimension > 2) scale *= inverse_h;
    V q{}, f;
    if constexpr (Kernel::needs_root) {
      const V s2 = pair.r2 + T(1e-30);
      q = minimum(s2 * reciprocal_sqrt(s2) * inverse_h, broadcast(support));
      f = kernel.template gradient_of_root<T>(q);
    } else {
      f = kernel.template gradient<T>(minimum(pair.r2 * (inverse_h * inverse_h), broadcast(support * support)));
    }
    pair.F = keep(pair.in_reach, scale * f);
    // Rings are in two dimensions.
    if constexpr (with_shape)
      pair.W = keep(pair.in_reach, shape_norm * (inverse_h * inverse_h) * kernel.template shape_beside<T>(q, f));
  }
};

}  // namespace
}  // namespace undex::sph::UNDEX_LEVEL
