// Smoothing kernels: what makes them kernels, and what makes sums over a lattice exact enough.
#include "sph_fluid/pairs/kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "core/vector.hpp"

namespace undex::sph {
namespace {

/// Integral over [0, support h] by Gauss-Legendre with five points in each of many intervals.
template <class F>
double integral(double to, F f) {
  const double at[3] = {0.0, 0.5384693101056831, 0.9061798459386640};
  const double weight[3] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const int intervals = 400;
  const double half = 0.5 * to / intervals;
  double sum = 0;
  for (int k = 0; k < intervals; ++k) {
    const double middle = (2 * k + 1) * half;
    sum += half * weight[0] * f(middle);
    for (int p = 1; p < 3; ++p) sum += half * weight[p] * (f(middle - half * at[p]) + f(middle + half * at[p]));
  }
  return sum;
}

/// Surface of the sphere of radius r: 2, 2 pi r, 4 pi r^2.
double shell(double r, int dimension) {
  return dimension == 1 ? 2.0 : dimension == 2 ? 2.0 * std::numbers::pi * r : 4.0 * std::numbers::pi * r * r;
}

template <class Kernel>
class Kernels : public ::testing::Test {};
struct KernelNames {
  template <class Kernel>
  static std::string GetName(int) {
    return Kernel::name;
  }
};
using KernelTypes = ::testing::Types<Gaussian, WendlandC2, WendlandC4, WendlandC6, CubicSpline, QuinticSpline>;
TYPED_TEST_SUITE(Kernels, KernelTypes, KernelNames);

TYPED_TEST(Kernels, IntegralIsOne) {
  const double h = 0.37;
  for (int d = 1; d <= 3; ++d)
    EXPECT_NEAR(integral(TypeParam::support * h, [&](double r) { return shell(r, d) * value<TypeParam>(r, h, d); }), 1.0, 1e-13)
        << d << "D";
}

/// The integral of x . grad W is minus the dimension: linear fields get exact gradients.
TYPED_TEST(Kernels, FirstMomentOfTheGradient) {
  const double h = 0.37;
  for (int d = 1; d <= 3; ++d)
    EXPECT_NEAR(
        integral(TypeParam::support * h, [&](double r) { return shell(r, d) * r * r * gradient_factor<TypeParam>(r, h, d); }),
        -double(d), 1e-10)
        << d << "D";
}

TYPED_TEST(Kernels, GradientIsTheDerivative) {
  const double h = 2.5e-3;
  for (int d = 1; d <= 3; ++d)
    for (double q = 0.05; q < TypeParam::support - 0.01; q += 0.0917) {
      const double r = q * h, step = 1e-5 * h;
      const double slope = (value<TypeParam>(r + step, h, d) - value<TypeParam>(r - step, h, d)) / (2 * step);
      const double peak = value<TypeParam>(0.0, h, d) / (h * h);
      EXPECT_NEAR(gradient_factor<TypeParam>(r, h, d), slope / r, 1e-8 * peak) << d << "D, q = " << q;
    }
}

TYPED_TEST(Kernels, EndsAtTheSupport) {
  const double h = 1.0, edge = TypeParam::support;
  for (int d = 1; d <= 3; ++d) {
    const double peak = value<TypeParam>(0.0, h, d);
    EXPECT_GT(value<TypeParam>(edge - 1e-6, h, d), 0.0);
    EXPECT_LT(value<TypeParam>(edge - 1e-6, h, d), 1e-8 * peak);
    EXPECT_EQ(value<TypeParam>(edge, h, d), 0.0);
    EXPECT_EQ(gradient_factor<TypeParam>(edge, h, d), 0.0);
    EXPECT_EQ(gradient_factor<TypeParam>(2 * edge, h, d), 0.0);
    EXPECT_LT(gradient_factor<TypeParam>(0.5 * edge, h, d), 0.0);
  }
}

/// The loops' own form of the shape, in both precisions.
TYPED_TEST(Kernels, ShapeBesideItsSlope) {
  for (double q = 0.0; q < TypeParam::support; q += 0.01) {
    const auto slope = [](auto at) {
      using T = decltype(at);
      if constexpr (TypeParam::needs_root) return TypeParam::template gradient_of_root<T>(at);
      else return TypeParam::template gradient<T>(at * at);
    };
    const double shape = TypeParam::shape(q), most = TypeParam::shape(0.0);
    EXPECT_NEAR(TypeParam::template shape_beside<double>(q, slope(q)), shape, 1e-10 * most) << q;
    EXPECT_NEAR(TypeParam::template shape_beside<float>(float(q), slope(float(q))), shape, 1e-5 * most) << q;
  }
}

TEST(Kernels, GoByTheirNames) {
  std::set<std::string> names;
  for (const KernelName name : all_kernels) names.insert(with_kernel(name, [](auto kernel) { return kernel.name; }));
  EXPECT_EQ(names,
            (std::set<std::string>{"gaussian", "wendland_c2", "wendland_c4", "wendland_c6", "cubic_spline", "quintic_spline"}));
}

/// The pieces of a spline meet with their slopes, and the inner ones stay finite at the middle, in single precision too.
template <class Kernel>
void pieces_meet() {
  for (double q = 1.0; q < Kernel::support; q += 1.0)
    EXPECT_NEAR(Kernel::template gradient_of_root<double>(q * (1 - 1e-12)),
                Kernel::template gradient_of_root<double>(q * (1 + 1e-12)),
                1e-9 * std::abs(Kernel::template gradient_of_root<double>(0.0)));
  for (const float q : {1e-12f, 1e-3f, 0.3f, 0.999f, 1.5f, 1.999f})
    EXPECT_NEAR(Kernel::template gradient_of_root<float>(q) / Kernel::template gradient_of_root<double>(q), 1.0, 1e-4) << q;
}
TEST(Kernels, PiecesOfSplinesMeet) {
  pieces_meet<CubicSpline>();
  pieces_meet<QuinticSpline>();
}

TEST(GaussianKernel, PolynomialIsTheExponential) {
  double worst = 0;
  for (double q2 = 0; q2 <= 9.0; q2 += 1e-3)
    worst = std::max(worst, std::abs(Gaussian::gradient<double>(q2) / (-2.0 * std::exp(-q2)) - 1.0));
  EXPECT_LT(worst, 2e-11);
  RecordProperty("worst_relative_error", std::to_string(worst * 1e12) + "e-12");
}

/// Sums over a lattice at the usual h: density and gradient of a linear field, to the accuracy that a user will see.
TYPED_TEST(Kernels, LatticeSums) {
  const double dx = 1.3e-3, h = TypeParam::usual_eta * dx;
  const int reach = 5;
  for (int d = 1; d <= 3; ++d) {
    double unity = 0, moment = 0, cross = 0;
    const double volume = std::pow(dx, d);
    for (int i = -reach; i <= reach; ++i)
      for (int j = d > 1 ? -reach : 0; j <= (d > 1 ? reach : 0); ++j)
        for (int k = d > 2 ? -reach : 0; k <= (d > 2 ? reach : 0); ++k) {
          const Vec3 x = dx * Vec3(i, j, k);
          unity += volume * value<TypeParam>(x.norm(), h, d);
          moment += volume * x[0] * x[0] * gradient_factor<TypeParam>(x.norm(), h, d);
          cross += volume * x[0] * x[1] * gradient_factor<TypeParam>(x.norm(), h, d);
        }
    // Measured: at worst 6e-3 and 1.2e-2 (Wendland C2, 1D), 4e-4 and 7e-3 (Gaussian), 2e-2 (cubic spline, 1D).
    EXPECT_NEAR(unity, 1.0, 0.02) << d << "D";
    EXPECT_NEAR(moment, -1.0, 0.03) << d << "D";
    EXPECT_NEAR(cross, 0.0, 1e-12) << d << "D";
    this->RecordProperty("unity_" + std::to_string(d), std::to_string(unity));
    this->RecordProperty("moment_" + std::to_string(d), std::to_string(moment));
  }
}

}  // namespace
}  // namespace undex::sph
