#include "sph_fluid/pairs/blocks.hpp"

#include <algorithm>

namespace undex::sph {
namespace {

struct Columns {
  double low[2], width;
  int count[2];

  std::size_t of_row(const CellGrid& grid, int iy, int iz) const {
    const int row[2] = {iy, iz};
    int column[2];
    for (int a = 0; a < 2; ++a) {
      const double centre = grid.low[a + 1] + (row[a] + 0.5) * grid.size[a + 1];
      column[a] = std::clamp(int((centre - low[a]) / width), 0, count[a] - 1);
    }
    return std::size_t(column[1]) * count[0] + column[0];
  }
};

Columns columns_over(const std::vector<GroupView>& groups, double reach) {
  Columns columns{{1e300, 1e300}, 0.0, {1, 1}};
  double high[2] = {-1e300, -1e300}, row = 0;
  for (const GroupView& group : groups) {
    if (group.begin == group.end) continue;
    for (int a = 0; a < 2; ++a) {
      columns.low[a] = std::min(columns.low[a], group.grid.low[a + 1]);
      high[a] = std::max(high[a], group.grid.low[a + 1] + group.grid.count[a + 1] * group.grid.size[a + 1]);
      row = std::max(row, group.grid.size[a + 1]);
    }
  }
  columns.width = (reach + 0.5 * row) * (1.0 + 1e-9);
  for (int a = 0; a < 2; ++a) columns.count[a] = std::max(1, int(std::min((high[a] - columns.low[a]) / columns.width, 1e6)) + 1);
  return columns;
}

/// Calls visit(column, begin, end, group) for every row that has particles.
template <class Visit>
void for_each_row(const std::vector<GroupView>& groups, const Columns& columns, Visit visit) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const CellGrid& grid = groups[g].grid;
    if (groups[g].begin == groups[g].end) continue;
    for (int iz = 0; iz < grid.count[2]; ++iz)
      for (int iy = 0; iy < grid.count[1]; ++iy) {
        const std::uint32_t* row = grid.start + (std::size_t(iz) * grid.count[1] + iy) * grid.count[0];
        if (row[0] < row[grid.count[0]]) visit(columns.of_row(grid, iy, iz), row[0], row[grid.count[0]], std::uint16_t(g));
      }
  }
}

}  // namespace

void BlockOrder::build(const std::vector<GroupView>& groups, double reach) {
  const Columns columns = columns_over(groups, reach);
  columns_y_ = columns.count[0];
  columns_z_ = columns.count[1];
  next_.assign(std::size_t(columns_y_) * columns_z_, 0);
  for_each_row(groups, columns, [&](std::size_t column, std::uint32_t begin, std::uint32_t end, std::uint16_t) {
    next_[column] += (end - begin + cluster_size - 1) / cluster_size;
  });

  blocks_.clear();
  std::uint32_t clusters = 0;
  for (int colour = 0; colour < 9; ++colour)
    for (int iz = colour / 3; iz < columns_z_; iz += 3)
      for (int iy = colour % 3; iy < columns_y_; iy += 3) {
        std::uint32_t& slot = next_[std::size_t(iz) * columns_y_ + iy];
        if (slot == 0) continue;
        const std::uint32_t here = slot;
        slot = clusters;
        clusters += here;
        blocks_.push_back({.begin = slot, .end = clusters, .iy = iy, .iz = iz});
      }
  rank_.assign(next_.size(), std::uint32_t(blocks_.size()));
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    rank_[std::size_t(blocks_[b].iz) * columns_y_ + blocks_[b].iy] = std::uint32_t(b);
  finished_.resize(blocks_.size());

  clusters_.resize(clusters);
  for_each_row(groups, columns, [&](std::size_t column, std::uint32_t begin, std::uint32_t end, std::uint16_t group) {
    for (std::uint32_t i = begin; i < end; i += cluster_size)
      clusters_[next_[column]++] = {i, std::uint16_t(std::min<std::uint32_t>(cluster_size, end - i)), group};
  });
}

void BlockOrder::describe(PairInput& in) {
  in.clusters = clusters_.data();
  in.blocks = blocks_.data();
  in.block_count = std::uint32_t(blocks_.size());
  in.columns_y = columns_y_;
  in.columns_z = columns_z_;
  in.rank = rank_.data();
  in.finished = finished_.data();
}

std::size_t BlockOrder::memory_bytes() const {
  return clusters_.capacity() * sizeof(Cluster) + blocks_.capacity() * sizeof(Block) + 4 * (rank_.capacity() + next_.capacity()) +
         finished_.capacity();
}

}  // namespace undex::sph
