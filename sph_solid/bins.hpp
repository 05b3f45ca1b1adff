// Points sorted into cubes, for searches of what is near.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/shapes.hpp"
#include "core/vector.hpp"

namespace undex::solid {

/// Keeps a view of the points, which must stay. Cubes are at least as wide as what is searched.
class Bins {
 public:
  Bins(std::span<const Vec3> x, double width) : x_(x), width_(width) {
    for (const Vec3& point : x) box_.include(point);
    const double most = 1e4 + 64.0 * double(x.size());  // cubes; scattered points get wider ones
    for (;; width_ *= 1.5) {
      double cubes = 1.0;
      for (int a = 0; a < 3; ++a) {
        const double count = std::max(1.0, std::ceil((box_.high[a] - box_.low[a]) / width_));
        cubes *= count;
        count_[a] = count < most ? long(count) : 0;
      }
      if (cubes <= most) break;
    }
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

}  // namespace undex::solid
