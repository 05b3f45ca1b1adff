#include "sph_fluid/pairs/pair_data.hpp"

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <new>
#include <type_traits>

namespace undex::sph {

KernelChoice kernel_choice(KernelName name, int dimension) {
  return with_kernel(name, [&](Kernel auto kernel) { return KernelChoice{name, kernel.support, kernel.norm(dimension)}; });
}

void grow(Scratch& s, std::size_t bytes, std::uint32_t candidates) {
  const auto enlarge = [](auto*& data, std::size_t held, std::size_t wanted) {
    using T = std::remove_reference_t<decltype(data)>;
    void* fresh = std::aligned_alloc(64, (wanted + 63) / 64 * 64);
    if (fresh == nullptr) throw std::bad_alloc();
    if (held > 0) std::memcpy(fresh, data, held);
    std::free(data);
    data = static_cast<T>(fresh);
  };
  if (bytes > s.bytes) {
    bytes += bytes / 2;
    enlarge(s.blocks, s.bytes, bytes);
    s.bytes = bytes;
  }
  if (candidates > s.capacity) {
    candidates += candidates / 2;
    enlarge(s.index, s.capacity * sizeof *s.index, candidates * sizeof *s.index);
    for (double** axis : {&s.x, &s.y, &s.z}) enlarge(*axis, s.capacity * sizeof **axis, candidates * sizeof **axis);
    enlarge(s.share, 0, candidates * cluster_size * sizeof *s.share);
    enlarge(s.kept, s.capacity * 2 * sizeof *s.kept, candidates * 2 * sizeof *s.kept);
    s.capacity = candidates;
  }
}

void release(Scratch& s) {
  for (void* data : {s.blocks, static_cast<void*>(s.index), static_cast<void*>(s.x), static_cast<void*>(s.y),
                     static_cast<void*>(s.z), static_cast<void*>(s.share), static_cast<void*>(s.kept)})
    std::free(data);
  s = {};
}

void grow(SingleRows& rows, std::size_t particles, int main, int tail) {
  const auto enlarge = [&](float*& data, std::size_t& bytes, int numbers) {
    const std::size_t wanted = particles * numbers * sizeof(float);
    if (wanted <= bytes) return;
    std::free(data);
    bytes = (wanted + wanted / 8 + 63) / 64 * 64;
    data = static_cast<float*>(std::aligned_alloc(64, bytes));
    if (data == nullptr) bytes = 0;
    if (data == nullptr) throw std::bad_alloc();
  };
  enlarge(rows.main, rows.main_bytes, main);
  enlarge(rows.tail, rows.tail_bytes, tail);
}

void release(SingleRows& rows) {
  std::free(rows.main);
  std::free(rows.tail);
  rows = {};
}

}  // namespace undex::sph
