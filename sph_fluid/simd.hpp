// A thin layer over the compiler's vector types: W doubles at a time, W set by the instruction set that the including
// file is compiled for. Everything lives in a namespace of that level, so that one program can hold several levels.
// Chosen over std::experimental::simd because the compiler contracts plain + and * of these types to FMA, compiles them
// ten times faster, and no library template can leak AVX-512 code into the baseline part of the program.
#pragma once

#if defined(__AVX512F__)
#include <immintrin.h>
#define UNDEX_LEVEL v4
#define UNDEX_LANES 8
#elif defined(__AVX2__)
#define UNDEX_LEVEL v3
#define UNDEX_LANES 4
#else
#define UNDEX_LEVEL v2
#define UNDEX_LANES 2
#endif

namespace undex::sph::UNDEX_LEVEL {

inline constexpr int lanes = UNDEX_LANES;
typedef double Vec __attribute__((vector_size(UNDEX_LANES * 8)));
typedef long long Mask __attribute__((vector_size(UNDEX_LANES * 8)));  // all bits set where true

#define UNDEX_INLINE inline __attribute__((always_inline))

UNDEX_INLINE Vec broadcast(double a) { return a - Vec{}; }
UNDEX_INLINE Vec minimum(Vec a, Vec b) { return a < b ? a : b; }
UNDEX_INLINE Vec maximum(Vec a, Vec b) { return a > b ? a : b; }
UNDEX_INLINE Vec keep(Mask m, Vec a) { return m ? a : Vec{}; }

#if UNDEX_LANES == 8
/// 1/a to 3e-13 relative: 14-bit estimate and one third-order step.
UNDEX_INLINE Vec reciprocal(Vec a) {
  const Vec r = (Vec)_mm512_rcp14_pd((__m512d)a);
  const Vec e = 1.0 - a * r;
  return r + r * (e + e * e);
}
/// 1/sqrt(a) to about 1e-12 relative, a > 0.
UNDEX_INLINE Vec reciprocal_sqrt(Vec a) {
  const Vec r = (Vec)_mm512_rsqrt14_pd((__m512d)a);
  const Vec e = 1.0 - a * r * r;
  return r + r * e * (0.5 + e * (0.375 + e * 0.3125));
}
#else
UNDEX_INLINE Vec reciprocal(Vec a) { return 1.0 / a; }
UNDEX_INLINE Vec reciprocal_sqrt(Vec a) {
  Vec r;
  for (int l = 0; l < lanes; ++l) r[l] = 1.0 / __builtin_sqrt(a[l]);
  return r;
}
#endif

}  // namespace undex::sph::UNDEX_LEVEL
