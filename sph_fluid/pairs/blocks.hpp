// The order in which a pair loop works through the clusters. Rows of cells are gathered into columns along x, as wide as a
// kernel's reach plus half a row; a column's clusters are a block. A block adds to particles within reach of its rows, so
// blocks that lie three columns apart never touch the same one: they are taken in nine colours, and a block that comes
// later waits for the blocks less than three columns away that come before it. Every particle therefore receives its sums
// in one order, whatever the number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::sph {

class BlockOrder {
 public:
  /// Cuts the rows of the groups' grids into clusters and sorts these by block. `reach` is the largest distance of a pair [m].
  void build(const std::vector<GroupView>& groups, double reach);

  /// Hands clusters, blocks and their order to a loop.
  void describe(PairInput& in);

  std::size_t block_count() const { return blocks_.size(); }
  std::size_t memory_bytes() const;

 private:
  std::vector<Cluster> clusters_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> rank_, next_;
  std::vector<unsigned char> finished_;
  int columns_y_ = 0, columns_z_ = 0;
};

}  // namespace undex::sph
