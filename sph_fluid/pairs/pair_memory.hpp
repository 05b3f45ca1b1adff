// Memory that the pair loops work in, kept from one to the next.
#pragma once

#include <vector>

#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::sph {

class PairMemory {
 public:
  /// For loops of up to that many threads.
  explicit PairMemory(int threads) : scratch_(threads) {}
  PairMemory(const PairMemory&) = delete;
  PairMemory& operator=(const PairMemory&) = delete;
  ~PairMemory();

  /// Lends it to a loop.
  void describe(PairInput& in);
  /// Without what threads need for a cluster.
  std::size_t memory_bytes() const;

 private:
  std::vector<Scratch> scratch_;
  SingleRows single_[2];
  FixedFrame frame_{};
};

}  // namespace undex::sph
