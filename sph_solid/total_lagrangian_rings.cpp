// Bodies of revolution in a total Lagrangian description: what becomes of pairs of rings, and the forces round the axis.
#include <cmath>
#include <numbers>

#include "sph_solid/first_column.hpp"
#include "sph_solid/total_lagrangian.hpp"

namespace undex::solid {
void TotalLagrangian::find_rings(double eta, const SolidParticles& p) {
  const std::uint32_t n = end_ - begin_;
  radius_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) radius_[i] = p.start[begin_ + i][0];
  next_column_.assign(n, none);
  borrowed_ = 1.0 - first_column(eta).inward;
  std::vector<std::uint32_t> near_axis;
  for (std::uint32_t i = 0; i < n; ++i)
    if (radius_[i] < 2.0 * spacing_) near_axis.push_back(i);
  for (const std::uint32_t i : near_axis) {
    if (radius_[i] > 0.75 * spacing_) continue;
    const Vec3 outside = p.start[begin_ + i] + spacing_ * Vec3::UnitX();
    double best = 0.3 * spacing_;
    for (const std::uint32_t k : near_axis) {
      const double away = (p.start[begin_ + k] - outside).norm();
      if (away < best) best = away, next_column_[i] = k;
    }
  }
}

/// The length of the ring half-way between two particles, over the lengths of both. A pair half-way on the axis, of a particle
/// and an image beside it, has none.
double TotalLagrangian::ring_of_pair(std::uint32_t i, std::uint32_t j, const Vec3& d) const {
  if (radius_.empty()) return 1.0;
  const double half_way = std::abs(radius_[i] - 0.5 * d[0]);
  if (half_way < 1e-9 * spacing_) return 0.0;
  return half_way / (2.0 * std::numbers::pi * radius_[i] * radius_[j]);
}

void TotalLagrangian::add_hoop_forces(SolidParticles& p) const {
  const std::uint32_t n = end_ - begin_;
#pragma omp parallel for schedule(static)
  for (std::uint32_t i = 0; i < n; ++i) {
    const double own = next_column_[i] == none ? 1.0 : 1.0 - borrowed_;
    p.force[begin_ + i][0] -= own * rows_[i].hoop / radius_[i];
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = next_column_[i];
    if (next != none) p.force[begin_ + next][0] -= borrowed_ * rows_[i].hoop / radius_[next];
  }
}

}  // namespace undex::solid
