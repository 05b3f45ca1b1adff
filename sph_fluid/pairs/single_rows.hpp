// What pairs in single precision read of a particle, rounded once a pass and packed: half the memory to gather, and rows of a
// cache line. The main row has the seven numbers of a fluid particle's state and what follows in the scheme's second row; what
// only some pairs read, or has no room, is the tail:
//   without a second row   main: FluidRow 0 to 7
//   with one               main: FluidRow 0 to 6, second row 0 to 8;   tail: FluidRow 7, second row from 9 on
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class Second>
struct SingleLayout {
  static constexpr int state = 7, tile = 8;  // tile: numbers that are transposed at a time
  static constexpr bool alone = same_type<Second, NoRow>;
  static constexpr int main = alone ? tile : 2 * tile, tail = alone ? 0 : tile;
  static constexpr int in_main = alone ? 0 : main - state;  // of the second row
  /// Rows of double numbers keep them.
  static constexpr bool serves = alone || same_type<typename Second::Number, float>;
};

/// Packs particles first..last.
template <class Second>
void pack(const FluidRow* fluid, const Second* second, std::uint32_t first, std::uint32_t last, const SingleRows& to) {
  using Layout = SingleLayout<Second>;
#pragma omp parallel for schedule(static)
  for (std::uint32_t i = first; i < last; ++i) {
    float* const main = to.main + std::size_t(i) * Layout::main;
    const double* const from = numbers(fluid + i);
    for (int k = 0; k < 8; ++k) main[k] = float(from[k]);
    if constexpr (!Layout::alone) {
      const float* const more = numbers(second + i);
      for (int k = 0; k < Layout::in_main; ++k) main[Layout::state + k] = more[k];
      float* const tail = to.tail + std::size_t(i) * Layout::tail;
      tail[0] = float(from[Layout::state]);
      for (int k = Layout::in_main; k < length_of<Second>; ++k) tail[1 + k - Layout::in_main] = more[k];
    }
  }
}

/// Packs all particles and images of a pass.
template <class Second>
void pack(const PairInput& in) {
  using Layout = SingleLayout<Second>;
  std::uint32_t end[2] = {0, 0};
  for (int g = 0; g < in.group_count; ++g) {
    std::uint32_t& last = end[in.groups[g].images_of >= 0];
    last = in.groups[g].end > last ? in.groups[g].end : last;
  }
  for (int images = 0; images < 2; ++images) {
    if (end[images] == 0) continue;
    grow(in.single[images], end[images], Layout::main, Layout::tail);
    pack(images ? in.images.fluid : in.fluid, static_cast<const Second*>(images ? in.images.second : in.second), 0, end[images],
         in.single[images]);
  }
}

}  // namespace undex::sph::UNDEX_LEVEL
