// Which block a thread works on next. Each thread has a share of the blocks, one after the other as suits its cache, and takes
// the first of them that is ready: all blocks that it waits for are finished. Without such a one it helps: it takes the last that
// is ready of another's share, so that nobody idles while there is work. A block is taken only when it is ready, so threads never
// wait for each other with work in hand, however many they are. A thread that finds nothing sleeps until a block is finished.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::sph {

class BlockQueue {
 public:
  /// Thread t has the blocks shares[t] to shares[t + 1]. Blocks and waits must outlive the queue's use.
  void fill(std::span<const Block> blocks, std::span<const std::uint32_t> waits, std::span<const std::uint32_t> shares);

  /// Before a loop over all blocks: do they wait for each other?
  void start(Turns turns);
  /// The next block for a thread, or their number where none is left.
  std::uint32_t take(int thread);
  void finish(std::uint32_t block);

  std::size_t memory_bytes() const;

 private:
  enum : unsigned char { waiting, taken, finished };
  struct alignas(64) Share {
    std::uint32_t begin, end;
    std::atomic<std::uint32_t> first;  ///< all before it are taken
  };
  struct Search {
    std::uint32_t block;
    bool left;  ///< is a block left that is not ready?
  };

  bool ready(std::uint32_t block) const;
  bool claim(std::uint32_t block);
  Search own(Share& share);
  Search helping(Share& share);

  std::span<const Block> blocks_;
  std::span<const std::uint32_t> waits_;
  Turns turns_ = Turns::any;
  std::unique_ptr<Share[]> shares_;
  std::unique_ptr<std::atomic<unsigned char>[]> states_;
  std::size_t share_count_ = 0, capacity_ = 0;
  std::atomic<std::uint32_t> finished_count_{0};
};

}  // namespace undex::sph
