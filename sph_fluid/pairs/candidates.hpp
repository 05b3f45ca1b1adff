// Finding, for one cluster, all particles within reach of its bounding box, mirrored images included: by rows of cells,
// then by distance to the box. Images are never stored: a cluster near a symmetry plane asks again with its box mirrored,
// and what it finds is mirrored as it is copied.
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"
#include "sph_fluid/pairs/single_rows.hpp"

namespace undex::sph::UNDEX_LEVEL {

struct Box3 {
  double low[3], high[3];
};

UNDEX_INLINE Box3 box_of(const double* x, const double* y, const double* z, std::uint32_t begin, int count) {
  Box3 box{{x[begin], y[begin], z[begin]}, {x[begin], y[begin], z[begin]}};
  for (int l = 1; l < count; ++l) {
    const double at[3] = {x[begin + l], y[begin + l], z[begin + l]};
    for (int a = 0; a < 3; ++a) {
      box.low[a] = at[a] < box.low[a] ? at[a] : box.low[a];
      box.high[a] = at[a] > box.high[a] ? at[a] : box.high[a];
    }
  }
  return box;
}

/// Distance from [low, high] to [cell_low, cell_high] along one axis.
UNDEX_INLINE double gap(double low, double high, double cell_low, double cell_high) {
  const double below = low - cell_high, above = cell_low - high;
  return below > 0.0 ? below : above > 0.0 ? above : 0.0;
}

/// Appends the particles of begin..end within `reach` of the box to `to`; returns the new number of entries.
inline std::uint32_t scan_run(const double* x, const double* y, const double* z, std::uint32_t begin, std::uint32_t end,
                              const Box3& box, double reach2, std::uint32_t found, Scratch& to) {
#if UNDEX_VECTOR_BYTES == 64
  using V = Vec<double>;
  const V zero{};
  __m256i ids = _mm256_add_epi32(_mm256_set1_epi32(int(begin)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  for (std::uint32_t s = begin; s < end; s += 8) {
    const __mmask8 inside = end - s >= 8 ? 0xff : __mmask8((1u << (end - s)) - 1u);
    const V px = (V)_mm512_maskz_loadu_pd(inside, x + s), py = (V)_mm512_maskz_loadu_pd(inside, y + s),
            pz = (V)_mm512_maskz_loadu_pd(inside, z + s);
    const V a = maximum(zero, maximum(box.low[0] - px, px - box.high[0]));
    const V b = maximum(zero, maximum(box.low[1] - py, py - box.high[1]));
    const V c = maximum(zero, maximum(box.low[2] - pz, pz - box.high[2]));
    const V d2 = a * a + b * b + c * c;
    const __mmask8 near = _mm512_mask_cmp_pd_mask(inside, (__m512d)d2, _mm512_set1_pd(reach2), _CMP_LT_OQ);
    _mm256_storeu_si256((__m256i*)(to.index + found), _mm256_maskz_compress_epi32(near, ids));
    _mm512_storeu_pd(to.x + found, _mm512_maskz_compress_pd(near, (__m512d)px));
    _mm512_storeu_pd(to.y + found, _mm512_maskz_compress_pd(near, (__m512d)py));
    _mm512_storeu_pd(to.z + found, _mm512_maskz_compress_pd(near, (__m512d)pz));
    found += std::uint32_t(__builtin_popcount(near));
    ids = _mm256_add_epi32(ids, _mm256_set1_epi32(8));
  }
#else
  using V = Vec<double>;
  constexpr std::uint32_t D = lanes<double>;
  const V zero{};
  const auto keep_if = [&](std::uint32_t s, bool near) UNDEX_LAMBDA_INLINE {
    to.index[found] = s;
    to.x[found] = x[s];
    to.y[found] = y[s];
    to.z[found] = z[s];
    found += near;
  };
  std::uint32_t s = begin;
  for (; s + D <= end; s += D) {
    const V px = load_double(x + s), py = load_double(y + s), pz = load_double(z + s);
    const V a = maximum(zero, maximum(box.low[0] - px, px - box.high[0]));
    const V b = maximum(zero, maximum(box.low[1] - py, py - box.high[1]));
    const V c = maximum(zero, maximum(box.low[2] - pz, pz - box.high[2]));
    int near = bits_of(a * a + b * b + c * c < reach2);
    for (; near != 0; near &= near - 1) keep_if(s + std::uint32_t(__builtin_ctz(unsigned(near))), true);
  }
  for (; s < end; ++s) {
    const double a = gap(box.low[0], box.high[0], x[s], x[s]), b = gap(box.low[1], box.high[1], y[s], y[s]),
                 c = gap(box.low[2], box.high[2], z[s], z[s]);
    keep_if(s, a * a + b * b + c * c < reach2);
  }
#endif
  return found;
}

/// Places in fixed point as a cluster sees them, mirrored or not: (n - middle) times unit from its middle; `half` its box's
/// half widths [m].
struct FixedView {
  const std::int32_t* n[3];
  std::int32_t middle[3];
  float unit[3], half[3];
};

/// The same on places in fixed point; the places found go to to.place.
inline std::uint32_t scan_run(const FixedView& view, std::uint32_t begin, std::uint32_t end, float reach2, std::uint32_t found,
                              Scratch& to) {
  using V = Vec<float>;
  typedef std::int32_t Whole __attribute__((vector_size(UNDEX_VECTOR_BYTES)));
  constexpr std::uint32_t W = lanes<float>;
  float* const place[3] = {static_cast<float*>(to.place[0]), static_cast<float*>(to.place[1]), static_cast<float*>(to.place[2])};
  for (std::uint32_t s = begin; s < end; s += W) {
    V at[3], d2{};
    for (int a = 0; a < 3; ++a) {
      Whole n;
      __builtin_memcpy(&n, view.n[a] + s, sizeof n);  // beyond the end: there is room
      at[a] = __builtin_convertvector(n - view.middle[a], V) * view.unit[a];
      const V beyond = maximum(V{}, maximum(at[a], -at[a]) - view.half[a]);
      d2 += beyond * beyond;
    }
#if UNDEX_VECTOR_BYTES == 64
    const __mmask16 inside = end - s >= 16 ? 0xffff : __mmask16((1u << (end - s)) - 1u);
    const __mmask16 near = _mm512_mask_cmp_ps_mask(inside, (__m512)d2, _mm512_set1_ps(reach2), _CMP_LT_OQ);
    const __m512i ids =
        _mm512_add_epi32(_mm512_set1_epi32(int(s)), _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    _mm512_storeu_si512(to.index + found, _mm512_maskz_compress_epi32(near, ids));
    for (int a = 0; a < 3; ++a) _mm512_storeu_ps(place[a] + found, _mm512_maskz_compress_ps(near, (__m512)at[a]));
    found += std::uint32_t(__builtin_popcount(near));
#else
    int near = bits_of(d2 < reach2);
    if (end - s < W) near &= (1 << (end - s)) - 1;
    for (; near != 0; near &= near - 1) {
      const int l = __builtin_ctz(unsigned(near));
      to.index[found] = s + std::uint32_t(l);
      for (int a = 0; a < 3; ++a) place[a][found] = at[a][l];
      ++found;
    }
#endif
  }
  return found;
}

/// Appends to the list the particles of one grid, from `from` on, within `reach` of the box: those that
/// run(begin, end, found) finds among begin..end, which returns the new number of entries.
template <class List, class Run>
UNDEX_INLINE void scan_grid(const CellGrid& grid, const Box3& box, double reach, std::uint32_t from, List& list, Run run) {
  int first[3], last[3];
  for (int a = 0; a < 3; ++a) {
    if (box.low[a] - reach > grid.bound_high[a] || box.high[a] + reach < grid.bound_low[a]) return;
    const double low = (box.low[a] - reach - grid.low[a]) / grid.size[a];
    const double high = (box.high[a] + reach - grid.low[a]) / grid.size[a];
    first[a] = low > 0.0 ? int(low) : 0;
    last[a] = high < double(grid.count[a]) ? int(high) : grid.count[a] - 1;
    if (first[a] > last[a]) return;
  }
  const double reach2 = reach * reach, inverse = 1.0 / grid.size[0];
  for (int iz = first[2]; iz <= last[2]; ++iz) {
    const double z_low = grid.low[2] + iz * grid.size[2];
    const double dz = gap(box.low[2], box.high[2], z_low, z_low + grid.size[2]);
    for (int iy = first[1]; iy <= last[1]; ++iy) {
      const std::uint32_t* row = grid.start + std::size_t(iz * std::size_t(grid.count[1]) + iy) * grid.count[0];
      if (row[last[0] + 1] <= from || row[first[0]] == row[last[0] + 1]) continue;
      const double y_low = grid.low[1] + iy * grid.size[1];
      const double dy = gap(box.low[1], box.high[1], y_low, y_low + grid.size[1]);
      const double left2 = reach2 - dy * dy - dz * dz;
      if (left2 <= 0.0) continue;
      // Within this row the reach along x is shorter; a hair more than it, for rounding.
      const double along = __builtin_sqrt(left2) * (1.0 + 1e-12);
      const int low = int((box.low[0] - along - grid.low[0]) * inverse);
      const int high = int((box.high[0] + along - grid.low[0]) * inverse);
      if (low > last[0] || high < first[0]) continue;
      const std::uint32_t start = row[low > first[0] ? low : first[0]], end = row[(high < last[0] ? high : last[0]) + 1];
      const std::uint32_t begin = start < from ? from : start;
      if (begin < end) {
        list.reserve(list.size + (end - begin) + 16);
        list.size = run(begin, end, list.size);
      }
    }
  }
}

/// Calls visit(image, mirrored_box) for the box itself (image 0) and for every image of it within `reach` of the symmetry
/// planes it is mirrored in; bit a of `image` is set where axis a is mirrored.
template <class Visit>
UNDEX_INLINE void for_each_image(const bool mirror[3], const Box3& box, double reach, Visit visit) {
  bool use[3];
  for (int a = 0; a < 3; ++a) use[a] = mirror[a] && box.low[a] < reach;
  for (int image = 0; image < 8; ++image) {
    Box3 mirrored = box;
    bool wanted = true;
    for (int a = 0; a < 3; ++a) {
      const bool flip = image >> a & 1;
      wanted = wanted && (!flip || use[a]);
      if (flip) {
        mirrored.low[a] = -box.high[a];
        mirrored.high[a] = -box.low[a];
      }
    }
    if (wanted) visit(image, mirrored);
  }
}

/// The candidates of one cluster in a thread's scratch memory. Their places (from an origin) stand beside; the rest a vector's
/// worth after the other: each block holds `lanes` weights, rows, second rows where the pass wants them, and room for what the
/// pairs add to them.
template <class T, class Second, int sums, bool rings = false>
class CandidateList {
 public:
  static constexpr int W = lanes<T>, D = lanes<double>;
  static constexpr int row = 8;
  /// Offsets of the parts within a block, and from block to block.
  static constexpr int weight = 0, state = W, second = (1 + row) * W;
  static constexpr int ring = second + length_of<Second> * W, sum = ring + (rings ? length_of<RingRow> * W : 0);
  static constexpr int stride = sum + sums * W;
  std::uint32_t size = 0;  ///< candidates

  explicit CandidateList(Scratch& scratch) : scratch_(scratch) { reserve(64); }

  UNDEX_INLINE T* block(std::uint32_t b) const { return static_cast<T*>(scratch_.blocks) + std::size_t(b) * stride; }
  Scratch& scratch() const { return scratch_; }
  UNDEX_INLINE T* place(int axis) const { return static_cast<T*>(scratch_.place[axis]); }
  const std::uint32_t* index() const { return scratch_.index; }
  std::uint32_t blocks() const { return (size + W - 1) / W; }

  void reserve(std::uint32_t candidates) {
    const std::size_t bytes = std::size_t(candidates / W + 2) * stride * sizeof(T);
    if (bytes > scratch_.bytes || candidates + W > scratch_.capacity) grow(scratch_, bytes, candidates + W);
  }

  void append(std::uint32_t which, double x, double y, double z) {
    scratch_.index[size] = which;
    scratch_.x[size] = x;
    scratch_.y[size] = y;
    scratch_.z[size] = z;
    ++size;
  }

  /// Fills the last block up with copies of candidate `begin`.
  void pad(std::uint32_t begin) {
    reserve(size + W);
    while (size % W != 0) append(scratch_.index[begin], scratch_.x[begin], scratch_.y[begin], scratch_.z[begin]);
  }

  /// Candidates from `begin` on get their places, mirrored and relative to the origin; those from `real` on go far away.
  UNDEX_INLINE void fill_places(std::uint32_t begin, std::uint32_t real, const double origin[3], int image, T far) {
    const double* axes[3] = {scratch_.x, scratch_.y, scratch_.z};
    for (std::uint32_t c = begin; c < size; c += D)
      for (int a = 0; a < 3; ++a)
        store_converted(place(a) + c, (image >> a & 1 ? -1.0 : 1.0) * load_double(axes[a] + c) - origin[a]);
    set_aside(real, far);
  }
  /// Candidates from `real` on go far away.
  UNDEX_INLINE void set_aside(std::uint32_t real, T far) {
    for (; real < size; ++real)
      for (int a = 0; a < 3; ++a) place(a)[real] = far;
  }

  /// What a pair with each counts: one half for the first `halves` candidates from `begin` on, one for the others.
  UNDEX_INLINE void fill_weights(std::uint32_t begin, std::uint32_t halves) {
    for (std::uint32_t c = begin; c < size; c += W) store(block(c / W) + weight, broadcast(T(1)));
    for (std::uint32_t c = begin; c < begin + halves; ++c) block(c / W)[weight + c % W] = T(0.5);
  }

  /// Candidates from `begin` on get their rows, mirrored.
  template <int offset, class Row>
  UNDEX_INLINE void fill_rows(std::uint32_t begin, const Row* rows, int image) {
    constexpr int length = length_of<Row>;
    for (std::uint32_t c = begin; c < size; c += D) {
      T* to = block(c / W) + c % W + offset;
      fill_tiles<0, length / D * D>(to, rows, scratch_.index + c);
      for (int k = length / D * D; k < length; ++k)
        for (int l = 0; l < D; ++l) to[k * W + l] = T(numbers(rows + scratch_.index[c + l])[k]);
      if (image == 0) continue;
      for (int k = 0; k < length; ++k)
        if (__builtin_popcount(unsigned(Row::parity(k) & image)) & 1)
          for (int l = 0; l < D; ++l) to[k * W + l] = -to[k * W + l];
    }
  }

  /// The same from rows in single precision. Without `tail` what stands there is not to be read.
  UNDEX_INLINE void fill_single(std::uint32_t begin, const SingleRows& rows, bool tail, int image) {
    using Layout = SingleLayout<Second>;
    for (std::uint32_t c = begin; c < size; c += W) {
      const std::uint32_t* which = scratch_.index + c;
      T* to = block(c / W);
      fill_eights<0>(to, rows.main, Layout::main, which);
      if constexpr (Layout::main > Layout::tile) {
        fill_eights<Layout::tile>(to, rows.main + Layout::tile, Layout::main, which);
        if (tail) fill_eights<Layout::main>(to, rows.tail, Layout::tail, which);
      }
      if (image == 0) continue;
      turn_signs<FluidRow>(to + state, image);
      turn_signs<Second>(to + second, image);
    }
  }

  /// Adds what candidates begin..real have received to the rows of the particles that they are, mirrored back.
  template <class Sums, class Row>
  UNDEX_INLINE void scatter_sums(std::uint32_t begin, std::uint32_t real, Row* rows, int image) {
    constexpr int length = Sums::count;
    double part[D][length + D];
    for (std::uint32_t c = begin; c < real; c += D) {
      const T* from = block(c / W) + c % W + sum;
      const int count = real - c < std::uint32_t(D) ? int(real - c) : D;
#pragma GCC unroll 4
      for (int first = 0; first < length; first += D) {
        Vec<double> tile[D];
#pragma GCC unroll 8
        for (int k = 0; k < D; ++k) tile[k] = first + k < length ? load_double(from + (first + k) * W) : Vec<double>{};
        transpose(tile);
#pragma GCC unroll 8
        for (int l = 0; l < D; ++l) store_converted(part[l] + first, tile[l]);
      }
      for (int l = 0; l < count; ++l) {
        double* row = &rows[scratch_.index[c + l]].fx;
        for (int axis = 0; image >> axis; ++axis)
          if (image >> axis & 1) part[l][axis] = -part[l][axis];
        add_row<Sums>(row, part[l]);
      }
    }
  }

  /// row[k] += part[k], or their maximum. Not one masked vector: the next row's load would wait for its store.
  template <class Sums>
  static UNDEX_INLINE void add_row(double* row, const double* part) {
    typedef double Four __attribute__((vector_size(32)));
    constexpr int vector = Sums::count >= 4 ? 4 : 0;
    if constexpr (vector > 0) {
      Four held, more;
      __builtin_memcpy(&held, row, sizeof held);
      __builtin_memcpy(&more, part, sizeof more);
      held += more;
      __builtin_memcpy(row, &held, sizeof held);
    }
#pragma GCC unroll 8
    for (int k = vector; k < Sums::count; ++k)
      row[k] = !Sums::is_maximum(k) ? row[k] + part[k] : part[k] > row[k] ? part[k] : row[k];
  }

 private:
  template <int first, int end, class Row>
  UNDEX_INLINE void fill_tiles(T* to, const Row* rows, const std::uint32_t* which) {
    if constexpr (first < end) {
      Vec<double> tile[D];
#pragma GCC unroll 8
      for (int l = 0; l < D; ++l) tile[l] = load_double(numbers(rows + which[l]) + first);
      transpose(tile);
#pragma GCC unroll 8
      for (int k = 0; k < D; ++k) store_converted(to + (first + k) * W, tile[k]);
      fill_tiles<first + D, end>(to, rows, which);
    }
  }

  /// Where number n of main row and tail goes; beyond the last none: -1.
  static constexpr int place_of(int n) {
    using Layout = SingleLayout<Second>;
    if (Layout::alone || n < Layout::state) return state + n * W;
    if (n == Layout::main) return state + Layout::state * W;
    const int k = n < Layout::main ? n - Layout::state : n - Layout::main - 1 + Layout::in_main;
    return k < length_of<Second> ? second + k * W : -1;
  }

  /// Eight numbers of a vector of rows that are `length` long, the first of them number `first` of main row and tail.
  template <int first>
  UNDEX_INLINE void fill_eights(T* to, const float* rows, int length, const std::uint32_t* which) {
#if UNDEX_VECTOR_BYTES >= 32
    Vec<float> tile[8];
#pragma GCC unroll 8
    for (int k = 0; k < 8; ++k)
      tile[k] = load_eights(rows + std::size_t(which[k]) * length, rows + std::size_t(which[(k + 8) % W]) * length);
    transpose_eights(tile);
#pragma GCC unroll 8
    for (int k = 0; k < 8; ++k)
      if (place_of(first + k) >= 0) store(to + place_of(first + k), tile[k]);
#else
    for (int k = 0; k < 8; ++k)
      for (int l = 0; l < W; ++l)
        if (place_of(first + k) >= 0) to[place_of(first + k) + l] = rows[std::size_t(which[l]) * length + k];
#endif
  }

  /// Of a block's numbers those that change their sign in the mirror.
  template <class Row>
  UNDEX_INLINE static void turn_signs(T* to, int image) {
    for (int k = 0; k < length_of<Row>; ++k)
      if (__builtin_popcount(unsigned(Row::parity(k) & image)) & 1) store(to + k * W, -load(to + k * W));
  }

  Scratch& scratch_;
};

}  // namespace undex::sph::UNDEX_LEVEL
