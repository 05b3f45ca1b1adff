// Smoothing kernels W(r, h) in 1, 2 and 3 dimensions, and F = (dW/dr)/r for pair loops.
// Each kernel is one struct: its support in units of h, its shape w(q) and f(q^2) = (dw/dq)/q, q = r/h, and its
// normalisation by dimension; T is double or float, V is T or a SIMD vector of it. W = norm/h^d w(q), F = norm/h^(d+2) f.
#pragma once

#include <cmath>
#include <numbers>

namespace undex::sph {

/// Gaussian cut at 3h (Chen et al. 2019, eq. 3). The cut value e^-9 is subtracted and the rest renormalised, so that
/// W is continuous, its integral is 1 and the first moment of its gradient is exactly -d.
struct Gaussian {
  static constexpr double support = 3.0;
  static constexpr const char* name = "gaussian";

  static double norm(int dimension) {
    const double cut = std::exp(-9.0), pi = std::numbers::pi;
    switch (dimension) {
      case 1: return 1.0 / (std::sqrt(pi) * std::erf(3.0) - 6.0 * cut);
      case 2: return 1.0 / (pi * (1.0 - cut) - pi * 9.0 * cut);
      default:
        return 1.0 / (std::pow(pi, 1.5) * std::erf(3.0) - 2.0 * pi * 3.0 * cut - 4.0 / 3.0 * pi * 27.0 * cut);
    }
  }
  static double shape(double q) { return q < support ? std::exp(-q * q) - std::exp(-9.0) : 0.0; }

  /// -2 exp(-q2) for q2 in [0, 9], relative error below 2e-11 (2e-6 in float): Taylor series of degree 9 of exp about
  /// 9/32, four squarings.
  template <class T, class V>
  static inline __attribute__((always_inline)) V gradient(V q2) {
    constexpr double c = 0.75483960198900735;  // exp(-9/32)
    const V y = T(0.28125) - q2 * T(0.0625);
    V e = T(c / 40320.0) + y * T(c / 362880.0);
    e = T(c / 5040.0) + y * e;
    e = T(c / 720.0) + y * e;
    e = T(c / 120.0) + y * e;
    e = T(c / 24.0) + y * e;
    e = T(c / 6.0) + y * e;
    e = T(c / 2.0) + y * e;
    e = T(c) + y * e;
    e = T(c) + y * e;
    e = e * e;
    e = e * e;
    e = e * e;
    return T(-2) * (e * e);
  }
  static constexpr bool needs_root = false;
};

/// Wendland's C2 function of compact support 2h (Wendland 1995), (1 - q/2)^4 (2q + 1) in every dimension (in one
/// dimension a lower power would do, but one form serves all loops).
struct WendlandC2 {
  static constexpr double support = 2.0;
  static constexpr const char* name = "wendland_c2";

  static double norm(int dimension) {
    const double pi = std::numbers::pi;
    return dimension == 1 ? 3.0 / 4.0 : dimension == 2 ? 7.0 / (4.0 * pi) : 21.0 / (16.0 * pi);
  }
  static double shape(double q) {
    const double s = 1.0 - 0.5 * q;
    return q < support ? s * s * s * s * (2.0 * q + 1.0) : 0.0;
  }
  /// -5 (1 - q/2)^3 for q in [0, 2].
  template <class T, class V>
  static inline __attribute__((always_inline)) V gradient_of_root(V q) {
    const V s = T(1) - T(0.5) * q;
    return T(-5) * (s * s * s);
  }
  static constexpr bool needs_root = true;
};

/// W(r, h) [1/m^d].
template <class Kernel>
double value(double r, double h, int dimension) {
  return Kernel::norm(dimension) * Kernel::shape(r / h) / std::pow(h, dimension);
}

/// F = (dW/dr)/r [1/m^(d+2)], zero beyond the support; the reference for tests and slow paths.
template <class Kernel>
double gradient_factor(double r, double h, int dimension) {
  const double q = r / h;
  if (q >= Kernel::support) return 0.0;
  const double scale = Kernel::norm(dimension) / std::pow(h, dimension + 2);
  if constexpr (Kernel::needs_root)
    return scale * Kernel::template gradient_of_root<double>(q);
  else
    return scale * Kernel::template gradient<double>(q * q);
}

}  // namespace undex::sph
