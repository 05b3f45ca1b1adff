#include "sph_fluid/pairs/ring_kernel.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace undex::sph {
namespace {

/// Everything here is in units of h, and for one radian.
constexpr double far_away = 8.0;                // from here on columns do not feel the axis
constexpr int table_end = 5, steps_per_h = 32;  // of the tables, which begin a step before the axis

/// Sums over the lattice columns of one another, at r = (k + 1/2)/eta: the first moment of the kernel's gradient and the kernel
/// itself, of column j and its image across the axis as i sees them, times the area of a cell.
struct ColumnSums {
  Eigen::VectorXd r;
  Eigen::MatrixXd x;  ///< sum F x
  Eigen::MatrixXd w;  ///< sum W
  double sum;         ///< of W over the lattice, times the area
};

template <class Kernel>
ColumnSums sums_of(double eta, int count) {
  const double dx = 1.0 / eta, area = dx * dx;
  const int rows = int(Kernel::support * eta) + 1;
  double sum_w = 0, sum_xx = 0;
  for (int k = -rows; k <= rows; ++k)
    for (int l = -rows; l <= rows; ++l) {
      const double q = std::hypot(k * dx, l * dx);
      sum_w += area * value<Kernel>(q, 1.0, 2);
      sum_xx -= area * gradient_factor<Kernel>(q, 1.0, 2) * k * k * area;
    }
  ColumnSums s;
  s.r.resize(count);
  for (int k = 0; k < count; ++k) s.r[k] = (k + 0.5) * dx;
  s.x = s.w = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      for (const double x : {s.r[i] - s.r[j], s.r[i] + s.r[j]}) {
        if (std::abs(x) >= Kernel::support) continue;
        for (int l = -rows; l <= rows; ++l) {
          const double q = std::hypot(x, l * dx), F = area / sum_xx * gradient_factor<Kernel>(q, 1.0, 2);
          s.x(i, j) += F * x;
          s.w(i, j) += area / sum_w * value<Kernel>(q, 1.0, 2);
        }
      }
  s.sum = sum_w;
  return s;
}

/// Both functions at the columns nearer to the axis than `far_away`.
struct KernelColumns {
  Eigen::VectorXd a, slope;
};

KernelColumns solve(const ColumnSums& s, double eta) {
  const int all = int(s.r.size()), near = int(far_away * eta);
  // Of V = r dx^2 the sums have the area already.
  const Eigen::MatrixXd w = s.w * s.r.asDiagonal();
  const Eigen::VectorXd total = w.rowwise().sum();

  // sum_j V_j (a_i + a_j)/2 W = 1.
  Eigen::VectorXd a = s.r.cwiseInverse();
  const Eigen::MatrixXd norm = 0.5 * (w + Eigen::MatrixXd(total.asDiagonal()));
  const Eigen::VectorXd rest = Eigen::VectorXd::Ones(near) - norm.topRightCorner(near, all - near) * a.tail(all - near);
  a.head(near) = norm.topLeftCorner(near, near).lu().solve(rest);

  // sum_j V_j [(a_i + a_j) F x + W slope_i] = 0.
  const Eigen::MatrixXd moment = s.x * s.r.asDiagonal();
  const Eigen::VectorXd push = a.cwiseProduct(moment.rowwise().sum()) + moment * a;
  return {a.head(near), (-push.cwiseQuotient(total)).head(near)};
}

/// A cubic spline through values at (k + 1/2)/eta and their mirror images at the other side of zero.
class MirroredSpline {
 public:
  MirroredSpline(const Eigen::VectorXd& values, double eta, double parity) : eta_(eta), count_(int(values.size())) {
    const int n = 2 * count_;
    value_.resize(n);
    for (int k = 0; k < count_; ++k) value_[count_ + k] = values[k], value_[count_ - 1 - k] = parity * values[k];
    // Second derivatives (times a twelfth of the step squared): natural ends, tridiagonal within.
    Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n);
    bend_ = Eigen::VectorXd::Zero(n);
    for (int k = 1; k + 1 < n; ++k) {
      system(k, k - 1) = system(k, k + 1) = 1.0, system(k, k) = 4.0;
      bend_[k] = value_[k - 1] - 2.0 * value_[k] + value_[k + 1];
    }
    bend_ = system.partialPivLu().solve(bend_).eval();
  }
  /// At zeta up to the last column.
  double operator()(double zeta) const {
    const double at = std::min(zeta * eta_ + count_ - 0.5, 2.0 * count_ - 1.0);
    const int k = std::min(int(at), 2 * count_ - 2);
    const double t = at - k, u = 1.0 - t;
    return u * value_[k] + t * value_[k + 1] + (u * u * u - u) * bend_[k] + (t * t * t - t) * bend_[k + 1];
  }

 private:
  double eta_;
  int count_;
  Eigen::VectorXd value_, bend_;
};

/// The functions at steps of 1/steps_per_h, through the columns.
std::vector<Ring> tabulated(const KernelColumns& c, double eta, const MirroredSpline& fine_a, const MirroredSpline& fine_slope) {
  Eigen::VectorXd a = c.a, slope = c.slope;
  for (int k = 0; k < a.size(); ++k) {
    const double zeta = (k + 0.5) / eta;
    a[k] /= fine_a(zeta);
    slope[k] /= fine_slope(zeta);
  }
  const MirroredSpline more_a(a, eta, 1.0), more_slope(slope, eta, 1.0);
  std::vector<Ring> table;
  for (int k = -1; k < table_end * steps_per_h + 2; ++k) {
    const double zeta = k / double(steps_per_h);
    table.push_back({.a = fine_a(zeta) * more_a(zeta), .slope = fine_slope(zeta) * more_slope(zeta)});
  }
  return table;
}

Ring operator+(const Ring& a, const Ring& b) { return {a.a + b.a, a.slope + b.slope}; }
Ring operator*(double t, const Ring& a) { return {t * a.a, t * a.slope}; }

/// The cubic through the two values beside a place, with the slopes that their neighbours give: `t` steps after the first of two.
Ring between(const Ring* first, double t) {
  const double u = 1.0 - t, tu = 0.5 * t * u;
  return (-tu * u) * first[-1] + (u + tu * (3.0 * u - 1.0)) * first[0] + (t + tu * (3.0 * t - 1.0)) * first[1] +
         (-tu * t) * first[2];
}

}  // namespace

double ring_area(double volume, double r) {
  using std::numbers::pi;
  if (8.0 * pi * r * r * r >= volume) return volume / (2.0 * pi * r);
  const double width = std::cbrt(volume / pi);
  return width * width;
}

RingKernel::RingKernel(KernelName kernel, double eta) {
  const double support = with_kernel(kernel, [](auto k) { return k.support; });
  const auto sums = [&](double spacings) {
    const int count = int((far_away + support) * spacings) + 2;
    return with_kernel(kernel, [&](auto k) { return sums_of<decltype(k)>(spacings, count); });
  };
  lattice_sum_ = sums(eta).sum;
  constexpr double fine = 12.0;
  const KernelColumns continuum = solve(sums(fine), fine);
  const MirroredSpline fine_a(continuum.a, fine, 1.0), fine_slope(continuum.slope, fine, -1.0);
  table_ = tabulated(solve(sums(eta), eta), eta, fine_a, fine_slope);
}

Ring RingKernel::at(double r, double h) const {
  const double zeta = std::abs(r) / h, side = r < 0.0 ? -1.0 : 1.0, radian = 1.0 / (2.0 * std::numbers::pi);
  if (!(zeta < table_end)) return {radian / std::abs(r), -side * radian / (r * r)};
  const int l = int(zeta * steps_per_h);
  const Ring ring = between(&table_[l + 1], zeta * steps_per_h - l);
  return {radian / h * ring.a, side * radian / (h * h) * ring.slope};
}

}  // namespace undex::sph
