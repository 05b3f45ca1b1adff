#include "sph_fluid/pairs/pair_memory.hpp"

namespace undex::sph {

PairMemory::~PairMemory() {
  for (Scratch& s : scratch_) release(s);
  for (SingleRows& rows : single_) release(rows);
}

void PairMemory::describe(PairInput& in) {
  in.scratch = scratch_.data();
  in.single = single_;
  in.frame = &frame_;
}

std::size_t PairMemory::memory_bytes() const {
  std::size_t bytes = 0;
  for (const SingleRows& rows : single_) bytes += rows.main_bytes + rows.tail_bytes + 3 * rows.place_bytes;
  return bytes;
}

}  // namespace undex::sph
