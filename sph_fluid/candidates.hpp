// Finding, for one cluster, all particles within reach of its bounding box, mirrored images included: by rows of cells,
// then by distance to the box. Images are never stored: a cluster near a symmetry plane asks again with its box mirrored,
// and what it finds is mirrored as it is copied.
#pragma once

#include "sph_fluid/pair_data.hpp"
#include "sph_fluid/simd.hpp"

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

/// Appends to scratch.index the particles of begin..end within `reach` of the box; returns the new number of entries.
inline std::uint32_t scan_run(const double* x, const double* y, const double* z, std::uint32_t begin, std::uint32_t end,
                              const Box3& box, double reach2, std::uint32_t found, Scratch& scratch) {
  if (found + (end - begin) + 16 > scratch.index_capacity) grow_index(scratch, found + (end - begin) + 16);
  std::uint32_t* index = scratch.index;
#if UNDEX_LANES == 8
  const Vec zero{};
  __m256i ids = _mm256_add_epi32(_mm256_set1_epi32(int(begin)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  for (std::uint32_t s = begin; s < end; s += 8) {
    const __mmask8 inside = end - s >= 8 ? 0xff : __mmask8((1u << (end - s)) - 1u);
    const Vec px = (Vec)_mm512_maskz_loadu_pd(inside, x + s), py = (Vec)_mm512_maskz_loadu_pd(inside, y + s),
              pz = (Vec)_mm512_maskz_loadu_pd(inside, z + s);
    const Vec a = maximum(zero, maximum(box.low[0] - px, px - box.high[0]));
    const Vec b = maximum(zero, maximum(box.low[1] - py, py - box.high[1]));
    const Vec c = maximum(zero, maximum(box.low[2] - pz, pz - box.high[2]));
    const Vec d2 = a * a + b * b + c * c;
    const __mmask8 near = _mm512_mask_cmp_pd_mask(inside, (__m512d)d2, _mm512_set1_pd(reach2), _CMP_LT_OQ);
    _mm256_storeu_si256((__m256i*)(index + found), _mm256_maskz_compress_epi32(near, ids));
    found += std::uint32_t(__builtin_popcount(near));
    ids = _mm256_add_epi32(ids, _mm256_set1_epi32(8));
  }
#else
  for (std::uint32_t s = begin; s < end; ++s) {
    const double a = gap(box.low[0], box.high[0], x[s], x[s]), b = gap(box.low[1], box.high[1], y[s], y[s]),
                 c = gap(box.low[2], box.high[2], z[s], z[s]);
    index[found] = s;
    found += a * a + b * b + c * c < reach2;
  }
#endif
  return found;
}

/// Particles of one grid within `reach` of the box, into scratch.index; returns their number.
inline std::uint32_t scan_grid(const CellGrid& grid, const double* x, const double* y, const double* z, const Box3& box,
                               double reach, Scratch& scratch) {
  int first[3], last[3];
  for (int a = 0; a < 3; ++a) {
    if (box.low[a] - reach > grid.bound_high[a] || box.high[a] + reach < grid.bound_low[a]) return 0;
    const double from = (box.low[a] - reach - grid.low[a]) / grid.size[a];
    const double to = (box.high[a] + reach - grid.low[a]) / grid.size[a];
    first[a] = from > 0.0 ? int(from) : 0;
    last[a] = to < double(grid.count[a]) ? int(to) : grid.count[a] - 1;
    if (first[a] > last[a]) return 0;
  }
  std::uint32_t found = 0;
  const double reach2 = reach * reach;
  for (int iz = first[2]; iz <= last[2]; ++iz) {
    const double z_low = grid.low[2] + iz * grid.size[2];
    const double dz = gap(box.low[2], box.high[2], z_low, z_low + grid.size[2]);
    for (int iy = first[1]; iy <= last[1]; ++iy) {
      const double y_low = grid.low[1] + iy * grid.size[1];
      const double dy = gap(box.low[1], box.high[1], y_low, y_low + grid.size[1]);
      if (dy * dy + dz * dz >= reach2) continue;
      const std::uint32_t* row = grid.start + std::size_t(iz * std::size_t(grid.count[1]) + iy) * grid.count[0];
      const std::uint32_t begin = row[first[0]], end = row[last[0] + 1];
      if (begin < end) found = scan_run(x, y, z, begin, end, box, reach2, found, scratch);
    }
  }
  return found;
}

/// Calls visit(sign_x, sign_y, sign_z, mirrored_box) for the box itself and for every image of it within `reach` of the
/// symmetry planes it is mirrored in.
template <class Visit>
UNDEX_INLINE void for_each_image(const bool mirror[3], const Box3& box, double reach, Visit visit) {
  bool use[3];
  for (int a = 0; a < 3; ++a) use[a] = mirror[a] && box.low[a] < reach;
  for (int image = 0; image < 8; ++image) {
    double sign[3];
    Box3 mirrored = box;
    bool wanted = true;
    for (int a = 0; a < 3; ++a) {
      const bool flip = image >> a & 1;
      wanted = wanted && (!flip || use[a]);
      sign[a] = flip ? -1.0 : 1.0;
      if (flip) {
        mirrored.low[a] = -box.high[a];
        mirrored.high[a] = -box.low[a];
      }
    }
    if (wanted) visit(sign[0], sign[1], sign[2], mirrored);
  }
}

/// Copies the fluid candidates found in one grid to `out`, mirrored by the signs.
UNDEX_INLINE void copy_candidates(const PackedParticle* packed, const std::uint32_t* index, std::uint32_t found,
                                  double sx, double sy, double sz, PackedParticle* out) {
  for (std::uint32_t k = 0; k < found; ++k) {
    PackedParticle q = packed[index[k]];
    q.x *= sx;
    q.y *= sy;
    q.z *= sz;
    q.vx *= sx;
    q.vy *= sy;
    q.vz *= sz;
    out[k] = q;
  }
}

UNDEX_INLINE void copy_candidates(const PackedGradient* gradients, const std::uint32_t* index, std::uint32_t found,
                                  double sx, double sy, double sz, PackedGradient* out) {
  const float fx = float(sx), fy = float(sy), fz = float(sz);
  for (std::uint32_t k = 0; k < found; ++k) {
    PackedGradient q = gradients[index[k]];
    q.strain[3] *= fx * fy;
    q.strain[4] *= fy * fz;
    q.strain[5] *= fz * fx;
    q.pressure[0] *= fx;
    q.pressure[1] *= fy;
    q.pressure[2] *= fz;
    out[k] = q;
  }
}

UNDEX_INLINE void copy_candidates(const PackedWall* packed, const std::uint32_t* index, std::uint32_t found, double sx,
                                  double sy, double sz, PackedWall* out) {
  for (std::uint32_t k = 0; k < found; ++k) {
    PackedWall q = packed[index[k]];
    q.x *= sx;
    q.y *= sy;
    q.z *= sz;
    q.vx *= sx;
    q.vy *= sy;
    q.vz *= sz;
    q.nx *= sx;
    q.ny *= sy;
    q.nz *= sz;
    out[k] = q;
  }
}

}  // namespace undex::sph::UNDEX_LEVEL
