// The inverse of a particle's moment matrix M = -sum_j V_j x_ij x_ij^T F, by which sums over uneven neighbours become gradients:
// adjugate over determinant. How far the inverse is to be trusted, each pass says for itself.
#pragma once

#include "sph_fluid/pairs/simd.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// Adjugate of a symmetric matrix of three rows, and its determinant.
template <class V>
struct Adjugate {
  V xx, yy, zz, xy, yz, zx, determinant;
};

/// Of m = (xx, yy, zz, xy, yz, zx), a number or a vector of them each; axes beyond the dimension are those of the unit matrix.
template <class V>
UNDEX_INLINE Adjugate<V> adjugate(const V* m, int dimension, V one) {
  const V xx = m[0], yy = dimension < 2 ? one : m[1], zz = dimension < 3 ? one : m[2], xy = m[3], yz = m[4], zx = m[5];
  Adjugate<V> a;
  a.xx = yy * zz - yz * yz, a.xy = zx * yz - xy * zz, a.zx = xy * yz - zx * yy;
  a.yy = xx * zz - zx * zx, a.yz = xy * zx - xx * yz, a.zz = xx * yy - xy * xy;
  a.determinant = xx * a.xx + xy * a.xy + zx * a.zx;
  return a;
}

}  // namespace undex::sph::UNDEX_LEVEL
