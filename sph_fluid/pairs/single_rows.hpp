// What pairs in single precision read of a particle, rounded once a pass and packed: half the memory to gather, and rows of a
// cache line. The main row has the seven numbers of a fluid particle's state and what follows in the scheme's second row; what
// only some pairs read, or has no room, is the tail:
//   without a second row   main: FluidRow 0 to 7
//   with one               main: FluidRow 0 to 6, second row 0 to 8;   tail: FluidRow 7, second row from 9 on
// Places are whole numbers of a unit that is small beside a pair's distance wherever in the scene the pair is: differences are
// exact, and the search looks at as many at a time as there are floats in a vector.
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

/// Packs particles 0..count: all threads of a team together, as the next.
template <class Second>
void pack_rows(const FluidRow* fluid, const Second* second, std::uint32_t count, const SingleRows& to) {
  using Layout = SingleLayout<Second>;
#pragma omp for schedule(static) nowait
  for (std::uint32_t i = 0; i < count; ++i) {
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

/// The frame of all particles and images. It is fine where the unit is a millionth of the shortest reach.
inline FixedFrame frame_over(const PairInput& in) {
  constexpr double steps = 1 << 30;
  double low[3] = {0, 0, 0}, high[3] = {0, 0, 0}, reach = 1e300;
  for (int g = 0; g < in.group_count; ++g) {
    const GroupView& group = in.groups[g];
    if (group.begin == group.end) continue;
    const bool first = reach == 1e300;
    for (int a = 0; a < 3; ++a) {
      const double from = group.grid.bound_low[a], to = group.grid.bound_high[a];
      low[a] = first || from < low[a] ? from : low[a];
      high[a] = first || to > high[a] ? to : high[a];
    }
    const double own = in.kernel.support * group.h_max;
    reach = own < reach ? own : reach;
  }
  FixedFrame frame{{}, {}, true};
  for (int a = 0; a < 3; ++a) {
    frame.unit[a] = (high[a] > low[a] ? high[a] - low[a] : reach) / steps;
    frame.low[a] = __builtin_floor(low[a] / frame.unit[a]);
    // Whole numbers of units, here and in mirrors, must be exact.
    frame.fine = frame.fine && frame.unit[a] < 1e-6 * reach && __builtin_fabs(frame.low[a]) < 1e12;
  }
  return frame;
}

/// Their places along one axis.
inline void pack_places(const double* x, std::uint32_t count, double low, double unit, std::int32_t* to) {
  const double inverse = 1.0 / unit;
#pragma omp for schedule(static) nowait
  for (std::uint32_t i = 0; i < count; ++i) to[i] = std::int32_t(x[i] * inverse - low);
}

/// Packs all particles and images of a pass.
template <class Second>
void pack(const PairInput& in) {
  using Layout = SingleLayout<Second>;
  *in.frame = frame_over(in);
  std::uint32_t end[2] = {0, 0};
  for (int g = 0; g < in.group_count; ++g) {
    std::uint32_t& last = end[in.groups[g].images_of >= 0];
    last = in.groups[g].end > last ? in.groups[g].end : last;
  }
  for (int images = 0; images < 2; ++images)
    if (end[images] > 0) grow(in.single[images], end[images], Layout::main, Layout::tail);
#pragma omp parallel
  for (int images = 0; images < 2; ++images) {
    const SingleRows& to = in.single[images];
    pack_rows(images ? in.images.fluid : in.fluid, static_cast<const Second*>(images ? in.images.second : in.second), end[images],
              to);
    const double* const axes[2][3] = {{in.x, in.y, in.z}, {in.images.x, in.images.y, in.images.z}};
    for (int a = 0; a < 3; ++a) pack_places(axes[images][a], end[images], in.frame->low[a], in.frame->unit[a], to.place[a]);
  }
}

}  // namespace undex::sph::UNDEX_LEVEL
