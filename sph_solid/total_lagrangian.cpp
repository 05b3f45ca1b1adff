#include "sph_solid/total_lagrangian.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/pairs/sums.hpp"

namespace undex::solid {

using namespace sph;  // pairs, cells and kernels
namespace {

using Kernel = WendlandC2;
constexpr double sign_of[2] = {1.0, -1.0};

Vec3 mirrored(Vec3 x, unsigned image) {
  for (int a = 0; a < 3; ++a)
    if (image >> a & 1) x[a] = -x[a];
  return x;
}

/// Particles in cubes as wide as the reach, for one search.
class Bins {
 public:
  Bins(std::span<const Vec3> x, double width) : x_(x), width_(width) {
    for (const Vec3& point : x) box_.include(point);
    for (int a = 0; a < 3; ++a) count_[a] = std::max(1L, std::lround(std::ceil((box_.high[a] - box_.low[a]) / width)));
    start_.assign(std::size_t(count_[0]) * count_[1] * count_[2] + 1, 0);
    for (const Vec3& point : x) ++start_[bin(point) + 1];
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    order_.resize(x.size());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::uint32_t i = 0; i < x.size(); ++i) order_[next[bin(x[i])]++] = i;
  }

  /// Calls visit(index) for every particle in the cubes round the point.
  template <class Visit>
  void around(const Vec3& point, Visit visit) const {
    long low[3], high[3];
    for (int a = 0; a < 3; ++a) {
      const long here = long(std::floor((point[a] - box_.low[a]) / width_));
      low[a] = std::max(0L, here - 1);
      high[a] = std::min(count_[a] - 1, here + 1);
    }
    for (long k = low[2]; k <= high[2]; ++k)
      for (long j = low[1]; j <= high[1]; ++j)
        for (long i = low[0]; i <= high[0]; ++i) {
          const std::size_t b = (std::size_t(k) * count_[1] + j) * count_[0] + i;
          for (std::uint32_t n = start_[b]; n < start_[b + 1]; ++n) visit(order_[n]);
        }
  }

 private:
  std::size_t bin(const Vec3& point) const {
    long at[3];
    for (int a = 0; a < 3; ++a) at[a] = std::clamp(long(std::floor((point[a] - box_.low[a]) / width_)), 0L, count_[a] - 1);
    return (std::size_t(at[2]) * count_[1] + at[1]) * count_[0] + at[0];
  }

  std::span<const Vec3> x_;
  double width_;
  Bounds box_;
  long count_[3];
  std::vector<std::uint32_t> start_, order_;
};

}  // namespace

TotalLagrangian::TotalLagrangian(const Settings& settings, const sph::Settings& around, const Body& body, std::uint32_t begin,
                                 std::uint32_t end, double h, double spacing, std::span<const double> volume,
                                 const SolidParticles& particles)
    : body_(&body), begin_(begin), end_(end), dimension_(around.dimension), h_(h), spacing_(spacing) {
  const Numerics& numerics = settings.numerics;
  hourglass_ = numerics.hourglass * body.material.shear_modulus;
  // The secant's yield stress: what a slow test at room temperature shows at a per cent.
  yield_ = materials::flow_stress(body.material.flow, 0.01, 1.0, body.material.T_room);
  viscosity_ = {numerics.linear_viscosity, numerics.quadratic_viscosity, spacing};
  const std::uint32_t n = end - begin;
  volume_.assign(volume.begin(), volume.end());
  start_density_.assign(particles.rho.begin() + begin, particles.rho.begin() + end);
  deformation_.assign(n, Mat3::Identity());
  inverse_moment_.resize(n);
  stretched_.assign(n, 0.0);
  stiffness_.assign(n, hourglass_);
  rows_.resize(n);
  find_neighbours(around, volume, particles);
}

void TotalLagrangian::find_neighbours(const sph::Settings& around, std::span<const double> volume,
                                      const SolidParticles& particles) {
  const std::uint32_t n = end_ - begin_;
  const double reach = Kernel::support * h_;
  const std::span<const Vec3> X(particles.start.data() + begin_, n);
  const Bins bins(X, reach);
  unsigned images[8], image_count = 0;
  for (unsigned image = 0; image < 8; ++image) {
    bool wanted = true;
    for (int a = 0; a < 3; ++a) wanted = wanted && (!(image >> a & 1) || around.symmetry.axis[a]);
    if (wanted) images[image_count++] = image;
  }
  const auto for_each_neighbour = [&](std::uint32_t i, auto visit) {
    for (unsigned m = 0; m < image_count; ++m)
      // The images of others near me are the others near my image.
      bins.around(mirrored(X[i], images[m]), [&](std::uint32_t j) {
        if (j == i && images[m] == 0) return;
        const Vec3 d = X[i] - mirrored(X[j], images[m]);
        if (d.squaredNorm() < reach * reach) visit(j, images[m], d);
      });
  };
  first_.assign(n + 1, 0);
#pragma omp parallel for schedule(dynamic, 256)
  for (std::uint32_t i = 0; i < n; ++i) for_each_neighbour(i, [&](std::uint32_t, unsigned, const Vec3&) { ++first_[i + 1]; });
  for (std::uint32_t i = 0; i < n; ++i) first_[i + 1] += first_[i];
  neighbours_.resize(first_[n]);
  std::uint32_t lonely = n;
#pragma omp parallel for schedule(dynamic, 256) reduction(min : lonely)
  for (std::uint32_t i = 0; i < n; ++i) {
    std::uint64_t at = first_[i];
    Mat3 moment = Mat3::Zero();
    for_each_neighbour(i, [&](std::uint32_t j, unsigned image, const Vec3& d) {
      const double r = d.norm();
      const double s = -(volume[i] * volume[j]) * gradient_factor<Kernel>(r, h_, dimension_);
      const Vec3 w = -s * d;
      moment += s * d * d.transpose();
      neighbours_[at++] = {w[0], w[1], w[2], s, j, image};
    });
    std::sort(neighbours_.begin() + first_[i], neighbours_.begin() + first_[i + 1],
              [](const Neighbour& a, const Neighbour& b) { return a.index != b.index ? a.index < b.index : a.image < b.image; });
    for (int a = dimension_; a < 3; ++a) moment(a, a) = volume[i];
    if (!(moment.determinant() > 1e-2 * std::pow(volume[i], 3))) lonely = std::min(lonely, i);
    inverse_moment_[i] = moment.inverse();
  }
  if (lonely < n)
    throw std::invalid_argument("solid '" + body_->name + "': the particle at (" + std::to_string(X[lonely][0]) + ", " +
                                std::to_string(X[lonely][1]) + ", " + std::to_string(X[lonely][2]) +
                                ") m has too few neighbours for a gradient; every part of the body must be at least two "
                                "spacings thick: use a finer spacing");
}

void TotalLagrangian::update(SolidParticles& p, double dt) {
  const std::uint32_t n = end_ - begin_;
  const std::uint32_t batch = materials::points_at_once;
#pragma omp parallel for schedule(static)
  for (std::uint32_t first = 0; first < n; first += batch) {
    Deformation step;
    Mat3 after[materials::points_at_once];
    const std::uint32_t last = std::min(n, first + batch);
    for (std::uint32_t i = first; i < last; ++i) {
      const Vec3 me = p.x[begin_ + i];
      double d[9] = {}, squares = 0;
      for (std::uint64_t k = first_[i]; k < first_[i + 1]; ++k) {
        const Neighbour& j = neighbours_[k];
        const Vec3& at = p.x[begin_ + j.index];
        const double x = sign_of[j.image & 1] * at[0] - me[0], y = sign_of[j.image >> 1 & 1] * at[1] - me[1],
                     z = sign_of[j.image >> 2 & 1] * at[2] - me[2];
        d[0] += x * j.wx, d[1] += x * j.wy, d[2] += x * j.wz;
        d[3] += y * j.wx, d[4] += y * j.wy, d[5] += y * j.wz;
        d[6] += z * j.wx, d[7] += z * j.wy, d[8] += z * j.wz;
        squares += j.s * (x * x + y * y + z * z);
      }
      Mat3 D;
      D << d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], d[8];
      Mat3& F = after[i - first];
      F.noalias() = D * inverse_moment_[i];
      for (int a = dimension_; a < 3; ++a) F(a, a) = 1.0;
      double affine = 0;
      for (int a = 0; a < dimension_; ++a) affine += D.row(a).dot(F.row(a));
      stretched_[i] = std::max(0.0, squares - affine);
      step.append(begin_ + i, deformation_[i], F, start_density_[i] / F.determinant());
    }
    update_stress(body_->material, viscosity_, step, dt, p);
    for (std::uint32_t i = first; i < last; ++i) {
      deformation_[i] = after[i - first];
      const double plastic = p.plastic_strain[begin_ + i];
      if (plastic > 0.0) {
        const double softer = hourglass_ / (1.0 + 3.0 * body_->material.shear_modulus * plastic / yield_);
        const double lost = 0.5 * (stiffness_[i] - softer) * stretched_[i] / p.mass[begin_ + i];
        p.energy[begin_ + i] += lost;
        p.viscous_energy[begin_ + i] += lost;
        p.temperature[begin_ + i] += materials::rise_by(body_->material, lost);
        stiffness_[i] = softer;
      }
    }
  }
}

void TotalLagrangian::make_row(const SolidParticles& p, std::uint32_t k, const Mat3& F) {
  const std::uint32_t i = begin_ + k;
  Mat3 sigma = p.stress(i);
  sigma.diagonal().array() -= p.viscous_pressure[i];
  const Mat3 piola = F.determinant() * sigma * F.inverse().transpose();
  const Mat3 a = volume_[k] * piola * inverse_moment_[k] - stiffness_[k] * F;
  Row& row = rows_[k];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) row.a[3 * r + c] = a(r, c);
    row.x[r] = p.x[i][r];
  }
  row.k = stiffness_[k];
}

void TotalLagrangian::add_forces(SolidParticles& p) {
  const std::uint32_t n = end_ - begin_;
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::uint32_t i = 0; i < n; ++i) {
      make_row(p, i, deformation_[i]);
      find_rate(p, begin_ + i, deformation_[i]);
    }
#pragma omp for schedule(static)
    for (std::uint32_t i = 0; i < n; ++i) {
      const Row& me = rows_[i];
      double f[3] = {};
      for (std::uint64_t k = first_[i]; k < first_[i + 1]; ++k) {
        const Neighbour& j = neighbours_[k];
        const Row& other = rows_[j.index];
        const double sx = sign_of[j.image & 1], sy = sign_of[j.image >> 1 & 1], sz = sign_of[j.image >> 2 & 1];
        const double wx = j.wx, wy = j.wy, wz = j.wz, stiff = j.s * (me.k + other.k);
        // The mirrored matrix times w is the mirror image of the matrix times the mirrored w.
        const double mx = sx * wx, my = sy * wy, mz = sz * wz;
        const double* a = other.a;
        f[0] += me.a[0] * wx + me.a[1] * wy + me.a[2] * wz + sx * (a[0] * mx + a[1] * my + a[2] * mz) +
                stiff * (sx * other.x[0] - me.x[0]);
        f[1] += me.a[3] * wx + me.a[4] * wy + me.a[5] * wz + sy * (a[3] * mx + a[4] * my + a[5] * mz) +
                stiff * (sy * other.x[1] - me.x[1]);
        f[2] += me.a[6] * wx + me.a[7] * wy + me.a[8] * wz + sz * (a[6] * mx + a[7] * my + a[8] * mz) +
                stiff * (sz * other.x[2] - me.x[2]);
      }
      for (int axis = 0; axis < dimension_; ++axis) p.force[begin_ + i][axis] += f[axis];
    }
  }
}

void TotalLagrangian::find_rate(SolidParticles& p, std::uint32_t i, const Mat3& F) const {
  // Waves cross a spacing that is squeezed; the norm of the inverse bounds by how much.
  const double squeeze = std::max(1.0, F.inverse().norm() / std::sqrt(3.0));
  const double closing = p.viscous_pressure[i] > 0 ? p.viscous_pressure[i] / (p.rho[i] * p.sound[i]) : 0.0;
  p.rate[i] = squeeze * (p.sound[i] * (1.0 + viscosity_.linear) + 2.0 * closing) / spacing_;
}

void TotalLagrangian::visit_state(StateVisitor& state) {
  state("deformation", deformation_);
  state("stretched", stretched_);
  state("stiffness", stiffness_);
}

double TotalLagrangian::hourglass_energy() const {
  return 0.5 * blocked_sum<double>(0, end_ - begin_, [&](std::uint32_t i) { return stiffness_[i] * stretched_[i]; });
}

std::size_t TotalLagrangian::memory_bytes() const {
  return neighbours_.capacity() * sizeof(Neighbour) + first_.capacity() * sizeof(std::uint64_t) +
         (end_ - begin_) * (2 * sizeof(Mat3) + 4 * sizeof(double) + sizeof(Row));
}

}  // namespace undex::solid
