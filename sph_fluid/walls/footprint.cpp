#include "sph_fluid/walls/footprint.hpp"

#include <algorithm>
#include <numeric>

#include "core/surface.hpp"

namespace undex::sph {

Footprint::Footprint(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position, double width,
                     const std::array<bool, 3>& symmetry, bool rings) {
  const std::size_t count = position.size();
  const std::vector<double> area = nodal_areas(faces, position, rings);
  Bounds box;
  for (const Vec3& x : position) box.include(x);
  // Only nodes near each other along the longest axis are compared.
  int along = 0;
  (box.high - box.low).maxCoeff(&along);
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return position[a][along] < position[b][along]; });

  begin_.push_back(0);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t first = shares_.size();
    double sum = 0;
    for (unsigned mirror = 0; mirror < 8; ++mirror) {
      bool wanted = true;
      for (int a = 0; a < 3; ++a) wanted = wanted && (!(mirror >> a & 1) || (symmetry[a] && position[n][a] < width));
      if (!wanted) continue;
      const Vec3 at = mirrored(position[n], mirror);
      auto it = std::lower_bound(order.begin(), order.end(), at[along] - width,
                                 [&](int node, double low) { return position[node][along] < low; });
      for (; it != order.end() && position[*it][along] < at[along] + width; ++it) {
        // A node on the plane is its own image: counted once, with all of its area.
        bool doubled = false;
        for (int a = 0; a < 3; ++a) doubled = doubled || ((mirror >> a & 1) && position[*it][a] < 1e-9 * width);
        if (doubled) continue;
        double whole = area[*it];
        for (int a = 0; a < 3; ++a)
          if (symmetry[a] && position[*it][a] < 1e-9 * width) whole *= 2.0;
        const double weight = whole * (1.0 - (position[*it] - at).norm() / width);
        if (weight <= 0.0) continue;
        shares_.push_back({*it, mirror, weight});
        sum += weight;
      }
    }
    for (std::size_t k = first; k < shares_.size(); ++k) shares_[k].weight /= sum;
    begin_.push_back(shares_.size());
  }
}

Footprint::Footprint(std::size_t nodes) {
  for (std::size_t n = 0; n < nodes; ++n) {
    begin_.push_back(n);
    shares_.push_back({.node = int(n), .mirror = 0, .weight = 1.0});
  }
  begin_.push_back(nodes);
}

std::vector<Vec3> Footprint::seen(std::span<const Vec3> nodal) const {
  if (begin_.empty()) return {nodal.begin(), nodal.end()};
  std::vector<Vec3> result(nodal.size(), Vec3::Zero());
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < nodal.size(); ++n)
    for (std::size_t k = begin_[n]; k < begin_[n + 1]; ++k)
      result[n] += shares_[k].weight * mirrored(nodal[shares_[k].node], shares_[k].mirror);
  return result;
}

void Footprint::spread(std::span<const Vec3> nodal, std::vector<Vec3>& sum) const {
  for (std::size_t n = 0; begin_.empty() && n < nodal.size(); ++n) sum[n] += nodal[n];
  for (std::size_t n = 0; n + 1 < begin_.size(); ++n)
    for (std::size_t k = begin_[n]; k < begin_[n + 1]; ++k)
      sum[shares_[k].node] += shares_[k].weight * mirrored(nodal[n], shares_[k].mirror);
}

}  // namespace undex::sph
