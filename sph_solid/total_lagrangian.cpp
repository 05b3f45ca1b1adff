#include "sph_solid/total_lagrangian.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/pairs/sums.hpp"
#include "sph_solid/bins.hpp"

namespace undex::solid {

using namespace sph;  // pairs, cells and kernels

TotalLagrangian::TotalLagrangian(const Settings& settings, const sph::Settings& around, const Body& body, std::uint32_t begin,
                                 std::uint32_t end, double h, double spacing, std::span<const double> volume,
                                 std::span<const OuterLayer> layer, const SolidParticles& particles)
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
  deformation_rate_.assign(n, Mat3::Zero());
  stretched_.assign(n, 0.0);
  stiffness_.assign(n, hourglass_);
  rows_.resize(n);
  backed_.assign(n, 0);
  swollen_.assign(n, 1.0);
  planes_ = settings.planes;
  if (around.axisymmetric) find_rings(h / spacing, particles);
  find_layers(settings, layer, particles);
  list_images(around, settings, layer, particles);
  find_neighbours(volume, particles);
}

void TotalLagrangian::find_neighbours(std::span<const double> volume, const SolidParticles& particles) {
  const std::uint32_t n = end_ - begin_;
  const double reach = Kernel::support * h_;
  const std::span<const Vec3> X(particles.start.data() + begin_, n);
  const Bins bins(X, reach);
  const auto mirrored = [&](Vec3 x, const Image& image) {
    for (int a = 0; a < 3; ++a) x[a] = image.sign[a] * x[a] + image.at_start[a];
    return x;
  };
  const auto for_each_neighbour = [&](std::uint32_t i, auto visit) {
    for (std::uint32_t m = 0; m < images_.size(); ++m) {
      const Image& image = images_[m];
      const auto lies_upon = [&](std::uint32_t k) {  // every layer that the image is made by
        for (std::size_t p = 0; p < planes_.size(); ++p)
          if (image.planes >> p & 1 && below_[p][k] == none) return false;
        return true;
      };
      if (image.planes && !lies_upon(i)) continue;
      // The images of others near me are the others near my image.
      bins.around(mirrored(X[i], image), [&](std::uint32_t j) {
        if (j == i && m == 0) return;
        const Vec3 d = X[i] - mirrored(X[j], image);
        if (d.squaredNorm() < reach * reach && (!image.planes || lies_upon(j)) && ring_of_pair(i, j, d) > 0.0) visit(j, m, d);
      });
    }
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
      const double s = -(volume[i] * volume[j]) * ring_of_pair(i, j, d) * gradient_factor<Kernel>(r, h_, dimension_);
      const Vec3 w = -s * d;
      if (!images_[image].planes) moment += s * d * d.transpose();
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

template <class Place>
Mat3 TotalLagrangian::gradient_of(const Place& place, std::uint32_t i, double& stretched) const {
  const Vec3 me = place(i);
  double d[9] = {}, squares = 0;
  for (std::uint64_t k = first_[i]; k < first_[i + 1]; ++k) {
    const Neighbour& j = neighbours_[k];
    if (!counts(i, j)) continue;
    const Vec3& at = place(j.index);
    const Image& m = images_[j.image];
    const double x = m.sign[0] * at[0] + m.offset[0] - me[0], y = m.sign[1] * at[1] + m.offset[1] - me[1],
                 z = m.sign[2] * at[2] + m.offset[2] - me[2];
    d[0] += x * j.wx, d[1] += x * j.wy, d[2] += x * j.wz;
    d[3] += y * j.wx, d[4] += y * j.wy, d[5] += y * j.wz;
    d[6] += z * j.wx, d[7] += z * j.wy, d[8] += z * j.wz;
    squares += j.s * (x * x + y * y + z * z);
  }
  Mat3 D, F;
  D << d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], d[8];
  F.noalias() = D * inverse_moment_[i];
  for (int a = dimension_; a < 3; ++a) F(a, a) = 1.0;
  if (!radius_.empty()) F(2, 2) = hoop_stretch(place, i);
  double affine = 0;
  for (int a = 0; a < dimension_; ++a) affine += D.row(a).dot(F.row(a));
  stretched = std::max(0.0, squares - affine);
  return F;
}

/// Where neighbours have come or gone with a plane's contact, F at the beginning of the step [s] is that of the new ones: what
/// they change of F is no strain, density goes on, and the zero-energy modes' stored energy that goes with them is booked as
/// viscous.
void TotalLagrangian::begin_anew(SolidParticles& p, std::uint32_t i, double dt) {
  const std::uint32_t a = begin_ + i;
  double stretched = 0;
  deformation_[i] = gradient_of([&](std::uint32_t k) -> Vec3 { return p.x[begin_ + k] - dt * p.v[begin_ + k]; }, i, stretched);
  const double density = p.rho[a] * deformation_[i].determinant();
  swollen_[i] *= start_density_[i] / density;
  start_density_[i] = density;
  const double lost = 0.5 * stiffness_[i] * (stretched_[i] - stretched) / p.mass[a];
  p.energy[a] += lost;
  p.viscous_energy[a] += lost;
}

void TotalLagrangian::update(SolidParticles& p, double dt) {
  follow_contact(p);
  const std::uint32_t n = end_ - begin_;
  const std::uint32_t batch = materials::points_at_once;
#pragma omp parallel for schedule(static)
  for (std::uint32_t first = 0; first < n; first += batch) {
    Deformation step;
    Mat3 after[materials::points_at_once];
    const std::uint32_t last = std::min(n, first + batch);
    for (std::uint32_t i = first; i < last; ++i) {
      if (!anew_.empty() && anew_[i]) begin_anew(p, i, dt);
      Mat3& F = after[i - first];
      F = gradient_of([&](std::uint32_t k) -> const Vec3& { return p.x[begin_ + k]; }, i, stretched_[i]);
      step.append(begin_ + i, deformation_[i], F, start_density_[i] / F.determinant());
    }
    update_stress(body_->material, viscosity_, step, dt, p);
    for (std::uint32_t i = first; i < last; ++i) {
      deformation_rate_[i] = (after[i - first] - deformation_[i]) / dt;
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
  const Mat3 piola = (F.determinant() * swollen_[k]) * sigma * F.inverse().transpose();
  const Mat3 a = volume_[k] * piola * inverse_moment_[k] - stiffness_[k] * F;
  Row& row = rows_[k];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) row.a[3 * r + c] = a(r, c);
    row.x[r] = p.x[i][r];
  }
  row.k = stiffness_[k];
  row.hoop = volume_[k] * piola(2, 2);
}

void TotalLagrangian::add_forces(SolidParticles& p, const std::vector<Vec3>& acceleration, double dt) {
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
        if (!counts(i, j)) continue;
        const Row& other = rows_[j.index];
        const Image& m = images_[j.image];
        const double sx = m.sign[0], sy = m.sign[1], sz = m.sign[2];
        const double wx = j.wx, wy = j.wy, wz = j.wz, stiff = j.s * (me.k + other.k);
        // The mirrored matrix times w is the mirror image of the matrix times the mirrored w.
        const double mx = sx * wx, my = sy * wy, mz = sz * wz;
        const double* a = other.a;
        f[0] += me.a[0] * wx + me.a[1] * wy + me.a[2] * wz + sx * (a[0] * mx + a[1] * my + a[2] * mz) +
                stiff * (sx * other.x[0] + m.offset[0] - me.x[0]);
        f[1] += me.a[3] * wx + me.a[4] * wy + me.a[5] * wz + sy * (a[3] * mx + a[4] * my + a[5] * mz) +
                stiff * (sy * other.x[1] + m.offset[1] - me.x[1]);
        f[2] += me.a[6] * wx + me.a[7] * wy + me.a[8] * wz + sz * (a[6] * mx + a[7] * my + a[8] * mz) +
                stiff * (sz * other.x[2] + m.offset[2] - me.x[2]);
      }
      for (int axis = 0; axis < dimension_; ++axis) p.force[begin_ + i][axis] += f[axis];
    }
  }
  if (!radius_.empty()) add_hoop_forces(p);
  add_pair_viscosity(p, acceleration, dt);
}

/// The viscosity of pairs behind strong shocks: on the relative velocity along the pair that neither side's F carries.
void TotalLagrangian::add_pair_viscosity(SolidParticles& p, const std::vector<Vec3>& acceleration, double dt) {
  constexpr double alpha = 0.5, beta = 2.0;
  constexpr double from = 0.10, in_full = 0.15;  // compression, 1 - rho0/rho
  const std::uint32_t n = end_ - begin_;
  std::fill(p.heat.begin() + begin_, p.heat.begin() + end_, 0.0);
  const double rho0 = body_->material.rho0;
  const double densest = n > 0 ? *std::max_element(p.rho.begin() + begin_, p.rho.begin() + end_) : 0.0;
  if (dt <= 0.0 || 1.0 - rho0 / densest <= from) return;
#pragma omp parallel for schedule(static)
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = begin_ + i;
    const Vec3 v = p.v[a] + 0.5 * dt * acceleration[a];
    Vec3 force = Vec3::Zero();
    double heat = 0, fastest = 0;
    for (std::uint64_t k = first_[i]; k < first_[i + 1]; ++k) {
      const Neighbour& j = neighbours_[k];
      if (!counts(i, j)) continue;
      const std::uint32_t b = begin_ + j.index;
      const double rho = 0.5 * (p.rho[a] + p.rho[b]);
      const double share = std::min((1.0 - rho0 / rho - from) / (in_full - from), 1.0);
      if (share <= 0.0) continue;
      const Image& m = images_[j.image];
      const Eigen::Map<const Vec3> sign(m.sign), offset(m.offset);
      const Vec3 X = Vec3(j.wx, j.wy, j.wz) / j.s;
      const Vec3 e = (sign.cwiseProduct(p.x[b]) + offset - p.x[a]).normalized();
      const double parting = e.dot(sign.cwiseProduct(p.v[b] + 0.5 * dt * acceleration[b]) - v);
      const Vec3 carried = deformation_rate_[i] * X + sign.cwiseProduct(deformation_rate_[j.index] * sign.cwiseProduct(X));
      const double jump = parting - 0.5 * e.dot(carried);
      const double speed = share * (alpha * 0.5 * (p.sound[a] + p.sound[b]) + beta * std::abs(jump));
      const double pull = j.s * X.norm() * rho * speed * jump;
      force += pull * e;
      heat += 0.5 * pull * parting;
      fastest = std::max(fastest, speed);
    }
    for (int axis = 0; axis < dimension_; ++axis) p.force[a][axis] += force[axis];
    p.heat[a] = heat / p.mass[a];
    p.rate[a] += 2.0 * fastest / spacing_;
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
  state("backed", backed_);
  state("inverse moment", inverse_moment_);
  state("start density", start_density_);
  state("swollen", swollen_);
}

double TotalLagrangian::hourglass_energy() const {
  return 0.5 * blocked_sum<double>(0, end_ - begin_, [&](std::uint32_t i) { return stiffness_[i] * stretched_[i]; });
}

std::size_t TotalLagrangian::memory_bytes() const {
  return neighbours_.capacity() * sizeof(Neighbour) + first_.capacity() * sizeof(std::uint64_t) +
         radius_.size() * (sizeof(double) + sizeof(std::uint32_t)) +
         (end_ - begin_) *
             (3 * sizeof(Mat3) + 5 * sizeof(double) + sizeof(Row) + sizeof(PlaneSet) + below_.size() * sizeof(std::uint32_t));
}

}  // namespace undex::solid
