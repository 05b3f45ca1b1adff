#include "sph_fluid/pairs/block_queue.hpp"

#include <algorithm>

namespace undex::sph {

void BlockQueue::fill(std::span<const Block> blocks, std::span<const std::uint32_t> waits,
                      std::span<const std::uint32_t> shares) {
  blocks_ = blocks;
  waits_ = waits;
  if (blocks.size() > capacity_) {
    capacity_ = blocks.size();
    states_ = std::make_unique<std::atomic<unsigned char>[]>(capacity_);
  }
  if (shares.size() - 1 != share_count_) {
    share_count_ = shares.size() - 1;
    shares_ = std::make_unique<Share[]>(share_count_);
  }
  for (std::size_t t = 0; t < share_count_; ++t) {
    shares_[t].begin = shares[t];
    shares_[t].end = shares[t + 1];
  }
}

void BlockQueue::start(Turns turns) {
  turns_ = turns;
  for (std::size_t t = 0; t < share_count_; ++t) shares_[t].first = shares_[t].begin;
  for (std::size_t b = 0; b < blocks_.size(); ++b) states_[b].store(waiting, std::memory_order_relaxed);
  finished_count_ = 0;
}

std::uint32_t BlockQueue::take(int thread) {
  const std::uint32_t none = std::uint32_t(blocks_.size());
  const std::size_t mine = std::size_t(thread) % share_count_;
  for (;;) {
    const std::uint32_t finished_before = finished_count_.load(std::memory_order_acquire);
    Search search = own(shares_[mine]);
    bool left = search.left;
    for (std::size_t k = 1; k < share_count_ && search.block == none; ++k) {
      search = helping(shares_[(mine + k) % share_count_]);
      left = left || search.left;
    }
    if (search.block != none || !left) return search.block;
    finished_count_.wait(finished_before, std::memory_order_acquire);
  }
}

void BlockQueue::finish(std::uint32_t block) {
  states_[block].store(finished, std::memory_order_release);
  finished_count_.fetch_add(1, std::memory_order_release);
  finished_count_.notify_all();
}

bool BlockQueue::ready(std::uint32_t block) const {
  if (states_[block].load(std::memory_order_relaxed) != waiting) return false;
  if (turns_ == Turns::any) return true;
  return std::all_of(waits_.begin() + blocks_[block].first_wait, waits_.begin() + blocks_[block].last_wait,
                     [&](std::uint32_t other) { return states_[other].load(std::memory_order_acquire) == finished; });
}

bool BlockQueue::claim(std::uint32_t block) {
  unsigned char expected = waiting;
  return ready(block) && states_[block].compare_exchange_strong(expected, taken, std::memory_order_acquire);
}

BlockQueue::Search BlockQueue::own(Share& share) {
  std::uint32_t first = share.first.load(std::memory_order_relaxed);
  while (first < share.end && states_[first].load(std::memory_order_relaxed) != waiting) ++first;
  share.first.store(first, std::memory_order_relaxed);
  bool left = false;
  for (std::uint32_t block = first; block < share.end; ++block) {
    if (claim(block)) return {block, left};
    left = left || states_[block].load(std::memory_order_relaxed) == waiting;
  }
  return {std::uint32_t(blocks_.size()), left};
}

BlockQueue::Search BlockQueue::helping(Share& share) {
  bool left = false;
  for (std::uint32_t block = share.end; block-- > share.first.load(std::memory_order_relaxed);) {
    if (claim(block)) return {block, left};
    left = left || states_[block].load(std::memory_order_relaxed) == waiting;
  }
  return {std::uint32_t(blocks_.size()), left};
}

std::size_t BlockQueue::memory_bytes() const { return share_count_ * sizeof(Share) + capacity_; }

void start(BlockQueue& queue, Turns turns) { queue.start(turns); }
std::uint32_t take(BlockQueue& queue, int thread) { return queue.take(thread); }
void finish(BlockQueue& queue, std::uint32_t block) { queue.finish(block); }

}  // namespace undex::sph
