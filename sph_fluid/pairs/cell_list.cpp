#include "sph_fluid/pairs/cell_list.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace undex::sph {
namespace {

/// Bounds of particles first..last along the three axes, into low and high.
void find_bounds(const double* const axes[3], std::uint32_t first, std::uint32_t last, double low[3], double high[3]) {
  const double *const x = axes[0], *const y = axes[1], *const z = axes[2];
  double x0 = 1e300, y0 = 1e300, z0 = 1e300, x1 = -1e300, y1 = -1e300, z1 = -1e300;
  bool finite = true;
#pragma omp parallel for schedule(static) reduction(min : x0, y0, z0) reduction(max : x1, y1, z1) reduction(&& : finite)
  for (std::uint32_t i = first; i < last; ++i) {
    finite = finite && std::isfinite(x[i]) && std::isfinite(y[i]) && std::isfinite(z[i]);
    x0 = std::min(x0, x[i]), y0 = std::min(y0, y[i]), z0 = std::min(z0, z[i]);
    x1 = std::max(x1, x[i]), y1 = std::max(y1, y[i]), z1 = std::max(z1, z[i]);
  }
  if (!finite) throw std::domain_error("a particle's position is not finite");
  low[0] = x0, low[1] = y0, low[2] = z0;
  high[0] = x1, high[1] = y1, high[2] = z1;
}

}  // namespace

void CellList::build(const double* x, const double* y, const double* z, std::uint32_t first, std::uint32_t last, double width,
                     const std::uint32_t* number) {
  first_ = first;
  const std::uint32_t n = last - first;
  const double* axes[3] = {x, y, z};
  for (int a = 0; a < 3; ++a) grid_.bound_low[a] = grid_.bound_high[a] = 0.0;
  if (n > 0) find_bounds(axes, first, last, grid_.bound_low, grid_.bound_high);
  // Stray particles stretch the box: then wider cells, not more memory.
  const double limit = 4.0 * n + 4096.0;
  double cells;
  for (;; width *= 1.25) {
    cells = 1.0;
    for (int a = 0; a < 3; ++a) {
      grid_.size[a] = a == 0 ? 0.25 * width : width;
      grid_.low[a] = grid_.bound_low[a] - 1e-6 * width;
      const double count = std::floor((grid_.bound_high[a] - grid_.low[a]) / grid_.size[a]) + 1.0;
      grid_.count[a] = int(std::min(count, 1e9));
      cells *= count;
    }
    if (cells <= limit) break;
  }

  key_.resize(n);
  const double inverse[3] = {1.0 / grid_.size[0], 1.0 / grid_.size[1], 1.0 / grid_.size[2]};
  const std::uint32_t nx = grid_.count[0], ny = grid_.count[1];
  const std::size_t cell_count = std::size_t(cells);
  const int threads = std::max(1, std::min<int>(omp_get_max_threads(), int(n / 4096) + 1));
  histogram_.assign(cell_count * threads, 0);
  start_.resize(cell_count + 1);
  order_.resize(n);
#pragma omp parallel num_threads(threads)
  {
    const int t = omp_get_thread_num(), team = omp_get_num_threads();  // the team may be smaller than asked for
    const std::uint32_t from = std::uint32_t(std::uint64_t(n) * t / team);
    const std::uint32_t to = std::uint32_t(std::uint64_t(n) * (t + 1) / team);
    std::uint32_t* mine = histogram_.data() + std::size_t(t) * cell_count;
    for (std::uint32_t k = from; k < to; ++k) {
      const std::uint32_t ix = std::uint32_t((x[first + k] - grid_.low[0]) * inverse[0]);
      const std::uint32_t iy = std::uint32_t((y[first + k] - grid_.low[1]) * inverse[1]);
      const std::uint32_t iz = std::uint32_t((z[first + k] - grid_.low[2]) * inverse[2]);
      key_[k] = std::min(std::uint32_t(cell_count - 1), (iz * ny + iy) * nx + std::min(ix, nx - 1));
      ++mine[key_[k]];
    }
#pragma omp barrier
#pragma omp single
    {
      std::uint32_t sum = 0;
      for (std::size_t c = 0; c < cell_count; ++c) {
        start_[c] = first + sum;
        for (int u = 0; u < team; ++u) {
          std::uint32_t& slot = histogram_[std::size_t(u) * cell_count + c];
          const std::uint32_t here = slot;
          slot = sum;
          sum += here;
        }
      }
      start_[cell_count] = first + sum;
    }
    for (std::uint32_t k = from; k < to; ++k) order_[mine[key_[k]]++] = first + k;
  }
  if (number != nullptr) sort_within_cells(number);
}

void CellList::sort_within_cells(const std::uint32_t* number) {
  const auto earlier = [number](std::uint32_t a, std::uint32_t b) { return number[a] < number[b]; };
  std::uint32_t* const order = order_.data();
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < start_.size() - 1; ++c) {
    std::uint32_t *const begin = order + (start_[c] - first_), *const end = order + (start_[c + 1] - first_);
    if (!std::is_sorted(begin, end, earlier)) std::sort(begin, end, earlier);
  }
}

CellGrid CellList::view() const {
  CellGrid grid = grid_;
  grid.start = start_.data();
  return grid;
}

std::size_t CellList::memory_bytes() const {
  return 4 * (start_.capacity() + key_.capacity() + order_.capacity() + histogram_.capacity());
}

}  // namespace undex::sph
