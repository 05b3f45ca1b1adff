// Sorting particles into cells: the order in which they lie in memory, and where each cell starts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::sph {

/// Counting sort of the particles first..last of three position arrays by cell, x fastest, and by number within a cell: the
/// result depends on the positions and numbers alone, not on the order before or on the number of threads. Without numbers the
/// particles of a cell keep their order.
class CellList {
 public:
  /// Cells are `width` [m] wide (y, z) and a quarter of that long (x); they grow where stray particles would make them
  /// too many. `number[i]` is that of particle i. Throws std::domain_error when a position is not finite.
  void build(const double* x, const double* y, const double* z, std::uint32_t first, std::uint32_t last, double width,
             const std::uint32_t* number = nullptr);

  /// order()[k] is the present index of the particle that belongs at first + k.
  const std::vector<std::uint32_t>& order() const { return order_; }
  CellGrid view() const;

  std::size_t memory_bytes() const;

 private:
  void sort_within_cells(const std::uint32_t* number);

  CellGrid grid_{};
  std::uint32_t first_ = 0;
  std::vector<std::uint32_t> start_, key_, order_, histogram_;
};

/// Calls visit(i) for all first <= i < last, in the cells' order, in the cells that the box from low to high touches.
template <class Visit>
void for_each_in_cells(const CellGrid& grid, const double* low, const double* high, Visit visit) {
  int first[3], last[3];
  for (int a = 0; a < 3; ++a) {
    if (low[a] > grid.bound_high[a] || high[a] < grid.bound_low[a]) return;
    first[a] = int(std::clamp((low[a] - grid.low[a]) / grid.size[a], 0.0, grid.count[a] - 1.0));
    last[a] = int(std::clamp((high[a] - grid.low[a]) / grid.size[a], 0.0, grid.count[a] - 1.0));
  }
  for (int iz = first[2]; iz <= last[2]; ++iz)
    for (int iy = first[1]; iy <= last[1]; ++iy) {
      const std::uint32_t* row = grid.start + (std::size_t(iz) * grid.count[1] + iy) * grid.count[0];
      for (std::uint32_t i = row[first[0]]; i < row[last[0] + 1]; ++i) visit(i);
    }
}

}  // namespace undex::sph
