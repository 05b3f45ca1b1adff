#include "sph_fluid/pairs/pair_data.hpp"

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <new>
#include <type_traits>

#include "sph_fluid/pairs/large_pages.hpp"

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
    // Of doubles or of floats.
    for (void*& axis : s.place) {
      double* numbers = static_cast<double*>(axis);
      enlarge(numbers, s.capacity * sizeof *numbers, candidates * sizeof *numbers);
      axis = numbers;
    }
    enlarge(s.share, 0, candidates * cluster_size * sizeof *s.share);
    enlarge(s.kept, s.capacity * 2 * sizeof *s.kept, candidates * 2 * sizeof *s.kept);
    s.capacity = candidates;
  }
}

void release(Scratch& s) {
  for (void* data :
       {s.blocks, static_cast<void*>(s.index), static_cast<void*>(s.x), static_cast<void*>(s.y), static_cast<void*>(s.z),
        s.place[0], s.place[1], s.place[2], static_cast<void*>(s.share), static_cast<void*>(s.kept)})
    std::free(data);
  s = {};
}

void grow(SingleRows& rows, std::size_t particles, int main, int tail) {
  const auto enlarge = [](std::size_t& bytes, std::size_t wanted, auto*&... arrays) {
    if (wanted <= bytes) return;
    bytes = 0;
    const std::size_t page = wanted < large_page ? 64 : large_page, room = (wanted + wanted / 8 + page - 1) / page * page;
    const auto renew = [room, page](auto*& data) {
      std::free(data);
      data = static_cast<std::remove_reference_t<decltype(data)>>(std::aligned_alloc(page, room));
      if (data == nullptr) throw std::bad_alloc();
      ask_for_large_pages(data, room);
    };
    (renew(arrays), ...);
    bytes = room;
  };
  enlarge(rows.main_bytes, particles * main * sizeof(float), rows.main);
  enlarge(rows.tail_bytes, particles * tail * sizeof(float), rows.tail);
  enlarge(rows.place_bytes, particles * sizeof(std::int32_t) + 64, rows.place[0], rows.place[1], rows.place[2]);
}

void release(SingleRows& rows) {
  for (void* data : {static_cast<void*>(rows.main), static_cast<void*>(rows.tail), static_cast<void*>(rows.place[0]),
                     static_cast<void*>(rows.place[1]), static_cast<void*>(rows.place[2])})
    std::free(data);
  rows = {};
}

}  // namespace undex::sph
