// Bodies of a total Lagrangian description on rigid planes: their images behind them, and what changes as contact begins and
// ends.
#include <Eigen/LU>
#include <cmath>

#include "sph_fluid/pairs/kernels.hpp"
#include "sph_solid/bins.hpp"
#include "sph_solid/total_lagrangian.hpp"

namespace undex::solid {

/// The particles of a flat layer, and the one of them that each of the others lies upon.
void TotalLagrangian::find_layers(const Settings& settings, std::span<const OuterLayer> layer, const SolidParticles& p) {
  const std::uint32_t n = end_ - begin_;
  for (std::size_t k = 0; k < settings.planes.size(); ++k) {
    std::vector<std::uint32_t>& below = below_.emplace_back(n, none);
    if (!layer[k].flat) continue;
    const int axis = settings.planes[k].axis;
    const double side = side_of(settings.planes[k]);
    double lowest = 1e300;
    for (std::uint32_t i = 0; i < n; ++i) lowest = std::min(lowest, side * p.start[begin_ + i][axis]);
    std::vector<Vec3> flat;  // across the plane, in the order of `member`
    std::vector<std::uint32_t> member;
    const auto across = [&](std::uint32_t i) {
      Vec3 x = p.start[begin_ + i];
      x[axis] = 0.0;
      return x;
    };
    const auto above = [&](std::uint32_t i) { return side * p.start[begin_ + i][axis] - lowest; };
    for (std::uint32_t i = 0; i < n; ++i)
      if (above(i) < 1e-6 * spacing_) {
        flat.push_back(across(i));
        member.push_back(i);
      }
    const Bins bins(flat, spacing_);
#pragma omp parallel for schedule(dynamic, 256)
    for (std::uint32_t i = 0; i < n; ++i) {
      if (above(i) > Kernel::support * h_) continue;
      double best = 0.5 * spacing_;
      const Vec3 here = across(i);
      bins.around(here, [&](std::uint32_t m) {
        const double away = (flat[m] - here).norm();
        if (away < best) best = away, below[i] = member[m];
      });
    }
  }
}

void TotalLagrangian::list_images(const sph::Settings& around, const Settings& settings, std::span<const OuterLayer> layer,
                                  const SolidParticles& p) {
  images_.push_back({{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, 0});
  const auto mirror_all = [&](int axis, double offset, double at_start, PlaneSet plane) {
    const std::size_t count = images_.size();
    for (std::size_t m = 0; m < count; ++m) {
      Image image = images_[m];
      if (image.sign[axis] < 0) continue;  // images between two planes across one axis are out of reach
      image.sign[axis] = -1;
      image.offset[axis] = offset;
      image.at_start[axis] = at_start;
      image.planes |= plane;
      images_.push_back(image);
    }
  };
  for (int a = 0; a < 3; ++a)
    if (around.symmetry.axis[a]) mirror_all(a, 0.0, 0.0, 0);
  for (std::size_t k = 0; k < settings.planes.size(); ++k) {
    if (!layer[k].flat) continue;
    const RigidPlane& plane = settings.planes[k];
    double lowest = 1e300;
    for (std::uint32_t i = begin_; i < end_; ++i) lowest = std::min(lowest, side_of(plane) * p.start[i][plane.axis]);
    mirror_all(plane.axis, 2.0 * plane.position, 2.0 * side_of(plane) * (lowest - layer[k].half), PlaneSet(1) << k);
  }
}

bool TotalLagrangian::may_touch(std::size_t plane, std::uint32_t particle) const {
  const std::uint32_t i = particle - begin_;
  if (below_[plane][i] != i) return false;
  constexpr double most_turned = 0.05;  // of a layer that comes down on the plane with its face
  const Mat3& F = deformation_[i];
  const int axis = planes_[plane].axis;
  for (int a = 0; a < dimension_; ++a)
    if (a != axis && (std::abs(F(axis, a)) > most_turned || std::abs(F(a, axis)) > most_turned)) return false;
  return F(axis, axis) > 0.0;
}

Mat3 TotalLagrangian::moment_of(std::uint32_t i) const {
  Mat3 moment = Mat3::Zero();
  for (std::uint64_t k = first_[i]; k < first_[i + 1]; ++k) {
    const Neighbour& j = neighbours_[k];
    if (!counts(i, j)) continue;
    const Vec3 w(j.wx, j.wy, j.wz);
    moment += w * w.transpose() / j.s;
  }
  for (int a = dimension_; a < 3; ++a) moment(a, a) = volume_[i];
  return moment;
}

void TotalLagrangian::follow_contact(const SolidParticles& p) {
  anew_.clear();
  if (planes_.empty()) return;
  const std::uint32_t n = end_ - begin_;
  bool changed = false;
  std::vector<PlaneSet> backed(n, 0);
#pragma omp parallel for schedule(static) reduction(|| : changed)
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < planes_.size(); ++k)
      if (below_[k][i] != none) backed[i] |= p.touching[begin_ + below_[k][i]] & (PlaneSet(1) << k);
    changed = changed || backed[i] != backed_[i];
  }
  if (!changed) return;
  backed_.swap(backed);
  anew_.assign(n, 0);
#pragma omp parallel for schedule(dynamic, 256)
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint64_t k = first_[i]; k < first_[i + 1]; ++k)
      if (images_[neighbours_[k].image].planes) {
        inverse_moment_[i] = moment_of(i).inverse();
        anew_[i] = 1;
        break;
      }
}

}  // namespace undex::solid
