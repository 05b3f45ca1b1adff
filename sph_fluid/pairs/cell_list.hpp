// Sorting particles into cells: the order in which they lie in memory, and where each cell starts.
#pragma once

#include <cstdint>
#include <vector>

#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::sph {

/// Counting sort of the particles first..last of three position arrays by cell, x fastest. Stable, so the result depends on
/// the positions and the previous order alone, not on the number of threads.
class CellList {
 public:
  /// Cells are `width` [m] wide (y, z) and a quarter of that long (x); they grow where stray particles would make them
  /// too many. Throws std::domain_error when a position is not finite.
  void build(const double* x, const double* y, const double* z, std::uint32_t first, std::uint32_t last, double width);

  /// order()[k] is the present index of the particle that belongs at first + k.
  const std::vector<std::uint32_t>& order() const { return order_; }
  CellGrid view() const;

  std::size_t memory_bytes() const;

 private:
  CellGrid grid_{};
  std::uint32_t first_ = 0;
  std::vector<std::uint32_t> start_, key_, order_, histogram_;
};

}  // namespace undex::sph
