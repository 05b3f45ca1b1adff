// The order in which a pair loop works through the clusters. Space is cut into boxes, each at least twice a kernel's reach and a
// cell wide, so that none but neighbouring boxes add to the same particle; the clusters of a box are a block. Of two neighbours
// the one of lower rank comes first: layer by layer along x, and within a layer in four colours, even and odd along y and z.
// Every particle therefore receives its sums in one order, whatever the number of threads and whatever else is worked on. Each
// thread has a compact part of every layer, and a sequence through it that finds in the cache what the last blocks have left
// there: along y, each block after those neighbours of the part that must come before it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sph_fluid/pairs/block_queue.hpp"
#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::sph {

class BlockOrder {
 public:
  /// Cuts the rows of the groups' grids into clusters and sorts these by block. `reach` is the largest distance of a pair [m].
  /// The number of threads shapes the sequence, not the ranks.
  void build(const std::vector<GroupView>& groups, double reach, int threads);

  /// Hands clusters, blocks and their order to a loop.
  void describe(PairInput& in);

  std::size_t block_count() const { return blocks_.size(); }
  std::size_t memory_bytes() const;

 private:
  std::vector<Cluster> clusters_;
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> waits_, next_;
  std::unique_ptr<BlockQueue> queue_;
};

}  // namespace undex::sph
