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
constexpr int eta_steps = 25;
constexpr double eta_step = 0.035;  // of the logarithm: from 0.66 to 1.52 of the scene's h over spacing

/// Sums over the lattice columns of one another, at r = (k + 1/2)/eta: moments of the kernel's gradient and the kernel itself, of
/// column j and its image across the axis as i sees them, times the area of a cell.
struct ColumnSums {
  Eigen::VectorXd r;
  Eigen::MatrixXd x;   ///< sum F x
  Eigen::MatrixXd xx;  ///< sum F x^2
  Eigen::MatrixXd w;   ///< sum W
  double sum;          ///< of W over the lattice, times the area
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
  s.x = s.xx = s.w = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      for (const double x : {s.r[i] - s.r[j], s.r[i] + s.r[j]}) {
        if (std::abs(x) >= Kernel::support) continue;
        for (int l = -rows; l <= rows; ++l) {
          const double q = std::hypot(x, l * dx), F = area / sum_xx * gradient_factor<Kernel>(q, 1.0, 2);
          s.x(i, j) += F * x;
          s.xx(i, j) += F * x * x;
          s.w(i, j) += area / sum_w * value<Kernel>(q, 1.0, 2);
        }
      }
  s.sum = sum_w;
  return s;
}

/// The three functions at the columns nearer to the axis than `far_away`, and lent r^2 beyond.
struct Columns {
  Eigen::VectorXd a, slope, lent;
  double far_lent;
};

Columns solve(const ColumnSums& s, double eta) {
  const int all = int(s.r.size()), near = int(far_away * eta);
  // Of V = r dx^2 the sums have the area already.
  const Eigen::MatrixXd w = s.w * s.r.asDiagonal();
  const Eigen::VectorXd total = w.rowwise().sum();
  Columns c;

  // sum_j V_j (a_i + a_j)/2 W = 1.
  Eigen::VectorXd a = s.r.cwiseInverse();
  const Eigen::MatrixXd norm = 0.5 * (w + Eigen::MatrixXd(total.asDiagonal()));
  const Eigen::VectorXd rest = Eigen::VectorXd::Ones(near) - norm.topRightCorner(near, all - near) * a.tail(all - near);
  a.head(near) = norm.topLeftCorner(near, near).lu().solve(rest);

  // sum_j V_j [(a_i + a_j) F x + W slope_i] = 0.
  const auto with_weights = [&](const Eigen::MatrixXd& moment) -> Eigen::VectorXd {
    const Eigen::MatrixXd m = moment * s.r.asDiagonal();
    return a.cwiseProduct(m.rowwise().sum()) + m * a;
  };
  Eigen::VectorXd slope = -with_weights(s.x).cwiseQuotient(total);
  slope.tail(all - near) = -s.r.tail(all - near).cwiseInverse().cwiseAbs2();

  // The rate of volume in v_r = r is two: -sum_j V_j [(a_i + a_j)/2 F x^2 + W ((slope_i - lent_i) r_i + lent_j r_j)] = 2.
  // Unknown are y = lent r, and its far value c in y = c/r, for which there is the first far column's equation.
  const Eigen::VectorXd hoop = slope.cwiseProduct(s.r);
  const Eigen::VectorXd lack = -2.0 * Eigen::VectorXd::Ones(all) - 0.5 * with_weights(s.xx) - hoop.cwiseProduct(total);
  const Eigen::MatrixXd exchange = w - Eigen::MatrixXd(total.asDiagonal());
  Eigen::MatrixXd system(near + 1, near + 1);
  system.leftCols(near) = exchange.topLeftCorner(near + 1, near);
  system.col(near) = exchange.topRightCorner(near + 1, all - near) * s.r.tail(all - near).cwiseInverse();
  const Eigen::VectorXd y = system.lu().solve(lack.head(near + 1));

  c.a = a.head(near);
  c.slope = slope.head(near);
  c.lent = y.head(near).cwiseQuotient(s.r.head(near));
  c.far_lent = y[near];
  return c;
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
std::vector<Ring> tabulated(const Columns& c, double eta, const MirroredSpline& fine_a, const MirroredSpline& fine_slope) {
  // Near the axis lent falls to zero with r, from a half spacing on.
  const double half = 0.5 / eta, least = half * half;
  Eigen::VectorXd a = c.a, slope = c.slope, lent = c.lent;
  for (int k = 0; k < a.size(); ++k) {
    const double zeta = (k + 0.5) / eta;
    a[k] /= fine_a(zeta);
    slope[k] /= fine_slope(zeta);
    lent[k] *= (zeta * zeta + least) / zeta;
  }
  const MirroredSpline more_a(a, eta, 1.0), more_slope(slope, eta, 1.0), more_lent(lent, eta, 1.0);
  std::vector<Ring> table;
  for (int k = -1; k < table_end * steps_per_h + 2; ++k) {
    const double zeta = k / double(steps_per_h);
    table.push_back({.a = fine_a(zeta) * more_a(zeta),
                     .slope = fine_slope(zeta) * more_slope(zeta),
                     .lent = more_lent(zeta) * zeta / (zeta * zeta + least)});
  }
  return table;
}

Ring operator+(const Ring& a, const Ring& b) { return {a.a + b.a, a.slope + b.slope, a.lent + b.lent}; }
Ring operator*(double t, const Ring& a) { return {t * a.a, t * a.slope, t * a.lent}; }

/// The cubic through the two values beside a place, with the slopes that their neighbours give: `t` steps after the first of two.
Ring between(const Ring* first, double t) {
  const double u = 1.0 - t, tu = 0.5 * t * u;
  return (-tu * u) * first[-1] + (u + tu * (3.0 * u - 1.0)) * first[0] + (t + tu * (3.0 * t - 1.0)) * first[1] +
         (-tu * t) * first[2];
}

}  // namespace

RingKernel::RingKernel(KernelName kernel, double eta) {
  const double support = with_kernel(kernel, [](auto k) { return k.support; });
  const auto sums = [&](double spacings) {
    const int count = int((far_away + support) * spacings) + 2;
    return with_kernel(kernel, [&](auto k) { return sums_of<decltype(k)>(spacings, count); });
  };
  lattice_sum_ = sums(eta).sum;
  constexpr double fine = 12.0;
  const Columns continuum = solve(sums(fine), fine);
  const MirroredSpline fine_a(continuum.a, fine, 1.0), fine_slope(continuum.slope, fine, -1.0);
  first_ = std::log(eta) - (eta_steps / 2) * eta_step;
  for (int k = 0; k < eta_steps; ++k) {
    const double spacings = std::exp(first_ + k * eta_step);
    const Columns columns = solve(sums(spacings), spacings);
    tables_.push_back({tabulated(columns, spacings, fine_a, fine_slope), columns.far_lent});
  }
}

Ring RingKernel::at(double r, double h, double area) const {
  const double zeta = r / h, radian = 1.0 / (2.0 * std::numbers::pi);
  const double row = std::clamp((std::log(h / std::sqrt(area)) - first_) / eta_step, 0.0, eta_steps - 1.0);
  const int k = std::min(int(row), eta_steps - 2);
  const Table &one = tables_[k], &next = tables_[k + 1];
  if (zeta >= table_end) {
    const double lent = one.far_lent + (row - k) * (next.far_lent - one.far_lent);
    return {radian / r, -radian / (r * r), radian * lent / (r * r)};
  }
  const int l = int(zeta * steps_per_h);
  const double t = zeta * steps_per_h - l;
  const double share = row - k;
  const Ring ring = (1.0 - share) * between(&one.value[l + 1], t) + share * between(&next.value[l + 1], t);
  const double once = radian / h, twice = once / h;
  return {once * ring.a, twice * ring.slope, twice * ring.lent};
}

}  // namespace undex::sph
