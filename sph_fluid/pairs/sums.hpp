// Sums over particles that do not depend on the number of threads: fixed blocks, added up in order.
#pragma once

#include <cstdint>
#include <vector>

namespace undex::sph {

/// sum over first <= i < last of f(i), for any T with a default of zero and +=.
template <class T, class F>
T blocked_sum(std::uint32_t first, std::uint32_t last, F f) {
  constexpr std::uint32_t block = 4096;
  const std::uint32_t blocks = (last - first + block - 1) / block;
  std::vector<T> partial(blocks);
#pragma omp parallel for schedule(static)
  for (std::uint32_t b = 0; b < blocks; ++b) {
    const std::uint32_t from = first + b * block, to = from + block < last ? from + block : last;
    T sum{};
    for (std::uint32_t i = from; i < to; ++i) sum += f(i);
    partial[b] = sum;
  }
  T total{};
  for (const T& sum : partial) total += sum;
  return total;
}

}  // namespace undex::sph
