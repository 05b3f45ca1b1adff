// Smoothing kernels W(r, h) in 1, 2 and 3 dimensions, and F = (dW/dr)/r for pair loops.
// Each kernel is one struct: its support in units of h, its shape w(q) and f(q^2) = (dw/dq)/q, q = r/h, and its
// normalisation by dimension; T is double or float, V is T or a SIMD vector of it. W = norm/h^d w(q), F = norm/h^(d+2) f.
// `usual_eta` is the h/dx that a scene gets by default (docs/theory/equations.md, section 2).
#pragma once

#include <cmath>
#include <numbers>

namespace undex::sph {

enum class KernelName { gaussian, wendland_c2, wendland_c4, wendland_c6, cubic_spline, quintic_spline };

/// What a kernel is to the loops over pairs: its support in smoothing lengths, its normalisation, and the slope f of its shape as
/// a function of q = r/h (`needs_root`) or of q^2, for one number or a vector of them, finite and without branches up to the
/// support; beside the slope, the shape itself.
template <class K>
concept LoopKernel = requires(const K kernel, int dimension, double q) {
  kernel.support* q;
  kernel.norm(dimension) * q;
  requires K::needs_root || requires { K::template gradient<double>(q); };
  requires !K::needs_root || requires { kernel.template gradient_of_root<double>(q); };
  kernel.template shape_beside<double>(q, q);
};

/// And to all others: its name and default h/dx in scenes, and its shape w(q), zero beyond the support, for one number.
template <class K>
concept Kernel = LoopKernel<K> && requires(double q) {
  KernelName(K::which);
  static_cast<const char*>(K::name);
  K::usual_eta* q;
  K::shape(q) * q;
};

/// Gaussian cut at 3h (Chen et al. 2019, eq. 3). The cut value e^-9 is subtracted and the rest renormalised, so that
/// W is continuous, its integral is 1 and the first moment of its gradient is exactly -d.
struct Gaussian {
  static constexpr double support = 3.0, usual_eta = 1.2;
  static constexpr KernelName which = KernelName::gaussian;
  static constexpr const char* name = "gaussian";

  static double norm(int dimension) {
    const double cut = std::exp(-9.0), pi = std::numbers::pi;
    switch (dimension) {
      case 1: return 1.0 / (std::sqrt(pi) * std::erf(3.0) - 6.0 * cut);
      case 2: return 1.0 / (pi * (1.0 - cut) - pi * 9.0 * cut);
      default: return 1.0 / (std::pow(pi, 1.5) * std::erf(3.0) - 2.0 * pi * 3.0 * cut - 4.0 / 3.0 * pi * 27.0 * cut);
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
  /// The shape where `gradient` is f.
  template <class T, class V>
  static inline __attribute__((always_inline)) V shape_beside(V, V f) {
    return T(-0.5) * f - T(0.00012340980408667956);  // exp(-9)
  }
  static constexpr bool needs_root = false;
};

/// Wendland's C2 function of compact support 2h (Wendland 1995), (1 - q/2)^4 (2q + 1) in every dimension (in one
/// dimension a lower power would do, but one form serves all loops).
struct WendlandC2 {
  static constexpr double support = 2.0, usual_eta = 1.5;
  static constexpr KernelName which = KernelName::wendland_c2;
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
  template <class T, class V>
  static inline __attribute__((always_inline)) V shape_beside(V q, V f) {
    return f * ((T(1) - T(0.5) * q) * (T(-0.4) * q - T(0.2)));
  }
  static constexpr bool needs_root = true;
};

/// Wendland's C4 function of compact support 2h (Wendland 1995; Dehnen, Aly 2012, Mon. Not. R. Astron. Soc. 425, table 1),
/// (1 - q/2)^6 (35/12 q^2 + 3q + 1) in every dimension.
struct WendlandC4 {
  static constexpr double support = 2.0, usual_eta = 1.75;
  static constexpr KernelName which = KernelName::wendland_c4;
  static constexpr const char* name = "wendland_c4";

  static double norm(int dimension) {
    const double pi = std::numbers::pi;
    return dimension == 1 ? 27.0 / 32.0 : dimension == 2 ? 9.0 / (4.0 * pi) : 495.0 / (256.0 * pi);
  }
  static double shape(double q) {
    const double s = 1.0 - 0.5 * q, s2 = s * s;
    return q < support ? s2 * s2 * s2 * ((35.0 / 12.0 * q + 3.0) * q + 1.0) : 0.0;
  }
  /// -14/3 (1 - q/2)^5 (1 + 5/2 q) for q in [0, 2].
  template <class T, class V>
  static inline __attribute__((always_inline)) V gradient_of_root(V q) {
    const V s = T(1) - T(0.5) * q, s2 = s * s;
    return s2 * s2 * s * (T(-14.0 / 3.0) - T(35.0 / 3.0) * q);
  }
  template <class T, class V>
  static inline __attribute__((always_inline)) V shape_beside(V q, V) {
    const V s = T(1) - T(0.5) * q, s2 = s * s;
    return s2 * s2 * s2 * ((T(35.0 / 12.0) * q + T(3)) * q + T(1));
  }
  static constexpr bool needs_root = true;
};

/// Wendland's C6 function of compact support 2h, (1 - q/2)^8 (4q^3 + 25/4 q^2 + 4q + 1) in every dimension.
struct WendlandC6 {
  static constexpr double support = 2.0, usual_eta = 2.0;
  static constexpr KernelName which = KernelName::wendland_c6;
  static constexpr const char* name = "wendland_c6";

  static double norm(int dimension) {
    const double pi = std::numbers::pi;
    return dimension == 1 ? 15.0 / 16.0 : dimension == 2 ? 39.0 / (14.0 * pi) : 1365.0 / (512.0 * pi);
  }
  static double shape(double q) {
    const double s = 1.0 - 0.5 * q, s2 = s * s, s4 = s2 * s2;
    return q < support ? s4 * s4 * (((4.0 * q + 6.25) * q + 4.0) * q + 1.0) : 0.0;
  }
  /// -11/2 (1 - q/2)^7 (1 + 7/2 q + 4 q^2) for q in [0, 2].
  template <class T, class V>
  static inline __attribute__((always_inline)) V gradient_of_root(V q) {
    const V s = T(1) - T(0.5) * q, s2 = s * s;
    return s2 * s2 * s2 * s * (T(-5.5) - q * (T(19.25) + T(22) * q));
  }
  template <class T, class V>
  static inline __attribute__((always_inline)) V shape_beside(V q, V) {
    const V s = T(1) - T(0.5) * q, s2 = s * s, s4 = s2 * s2;
    return s4 * s4 * (((T(4) * q + T(6.25)) * q + T(4)) * q + T(1));
  }
  static constexpr bool needs_root = true;
};

/// Cubic B-spline M4 of support 2h (Monaghan, Lattanzio 1985, Astron. Astrophys. 149): (2 - q)^3/4 - (1 - q)^3, each term
/// while its base is positive.
struct CubicSpline {
  static constexpr double support = 2.0, usual_eta = 1.325;
  static constexpr KernelName which = KernelName::cubic_spline;
  static constexpr const char* name = "cubic_spline";

  static double norm(int dimension) {
    const double pi = std::numbers::pi;
    return dimension == 1 ? 2.0 / 3.0 : dimension == 2 ? 10.0 / (7.0 * pi) : 1.0 / pi;
  }
  static double shape(double q) {
    const double a = q < 2.0 ? 2.0 - q : 0.0, b = q < 1.0 ? 1.0 - q : 0.0;
    return 0.25 * a * a * a - b * b * b;
  }
  /// Both pieces, and a choice between them; the inner one has no 1/q.
  template <class T, class V>
  static inline __attribute__((always_inline)) V gradient_of_root(V q) {
    const V a = T(2) - q;
    return q < T(1) ? T(2.25) * q - T(3) : T(-0.75) * (a * a) / q;
  }
  template <class T, class V>
  static inline __attribute__((always_inline)) V shape_beside(V q, V) {
    const V a = T(2) - q, b = q < T(1) ? T(1) - q : V{};
    return T(0.25) * (a * a * a) - b * b * b;
  }
  static constexpr bool needs_root = true;
};

/// Quintic B-spline M6 of support 3h (Morris, Fox, Zhu 1997, J. Comput. Phys. 136): (3 - q)^5 - 6 (2 - q)^5 + 15 (1 - q)^5,
/// each term while its base is positive.
struct QuinticSpline {
  static constexpr double support = 3.0, usual_eta = 1.1;
  static constexpr KernelName which = KernelName::quintic_spline;
  static constexpr const char* name = "quintic_spline";

  static double norm(int dimension) {
    const double pi = std::numbers::pi;
    return dimension == 1 ? 1.0 / 120.0 : dimension == 2 ? 7.0 / (478.0 * pi) : 1.0 / (120.0 * pi);
  }
  static double shape(double q) {
    const double a = q < 3.0 ? 3.0 - q : 0.0, b = q < 2.0 ? 2.0 - q : 0.0, c = q < 1.0 ? 1.0 - q : 0.0;
    return a * a * a * a * a - 6.0 * b * b * b * b * b + 15.0 * c * c * c * c * c;
  }
  /// As the cubic one; the inner piece is multiplied out.
  template <class T, class V>
  static inline __attribute__((always_inline)) V gradient_of_root(V q) {
    const V a = T(3) - q, b = q < T(2) ? T(2) - q : V{}, a2 = a * a, b2 = b * b;
    return q < T(1) ? (T(120) - T(50) * q) * (q * q) - T(120) : (T(30) * (b2 * b2) - T(5) * (a2 * a2)) / q;
  }
  template <class T, class V>
  static inline __attribute__((always_inline)) V shape_beside(V q, V) {
    const V a = T(3) - q, b = q < T(2) ? T(2) - q : V{}, c = q < T(1) ? T(1) - q : V{};
    const V a2 = a * a, b2 = b * b, c2 = c * c;
    return a2 * a2 * a - T(6) * (b2 * b2 * b) + T(15) * (c2 * c2 * c);
  }
  static constexpr bool needs_root = true;
};

/// Calls visit(kernel) with the kernel of that name; every list of kernels outside this file is made by it.
template <class Visit>
inline __attribute__((always_inline)) auto with_kernel(KernelName name, Visit visit) {
  switch (name) {
    case KernelName::gaussian: return visit(Gaussian{});
    case KernelName::wendland_c4: return visit(WendlandC4{});
    case KernelName::wendland_c6: return visit(WendlandC6{});
    case KernelName::cubic_spline: return visit(CubicSpline{});
    case KernelName::quintic_spline: return visit(QuinticSpline{});
    case KernelName::wendland_c2: break;
  }
  return visit(WendlandC2{});
}
inline constexpr KernelName all_kernels[] = {KernelName::gaussian,    KernelName::wendland_c2,  KernelName::wendland_c4,
                                             KernelName::wendland_c6, KernelName::cubic_spline, KernelName::quintic_spline};

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
  if constexpr (Kernel::needs_root) return scale * Kernel::template gradient_of_root<double>(q);
  else return scale * Kernel::template gradient<double>(q * q);
}

/// What the discrete gradient makes of a linear field of slope 1 on a Cartesian lattice with h = eta spacings:
/// -sum_j V_j x_ij^2 F_ij over the dimension. Kernel gradients of fluids are divided by it, so that sound on the lattice has
/// its true speed; it is not 1 however fine the lattice.
template <class Kernel>
double lattice_factor(double eta, int dimension) {
  const int reach = int(Kernel::support * eta);
  const int y_reach = dimension > 1 ? reach : 0, z_reach = dimension > 2 ? reach : 0;
  double sum = 0;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -y_reach; y <= y_reach; ++y)
      for (int z = -z_reach; z <= z_reach; ++z)
        sum -= x * x * gradient_factor<Kernel>(std::sqrt(double(x * x + y * y + z * z)), eta, dimension);
  return sum;
}

}  // namespace undex::sph
