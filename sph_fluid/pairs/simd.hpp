// A thin layer over the compiler's vector types: as many numbers at a time as the instruction set holds that the including
// file is compiled for. Everything lives in a namespace of that level, so that one program can hold several levels.
// Chosen over std::experimental::simd because the compiler contracts plain + and * of these types to FMA, compiles them
// ten times faster, and no library template can leak AVX-512 code into the baseline part of the program.
#pragma once

#include <immintrin.h>

#if defined(__AVX512F__)
#define UNDEX_LEVEL v4
#define UNDEX_VECTOR_BYTES 64
#elif defined(__AVX2__)
#define UNDEX_LEVEL v3
#define UNDEX_VECTOR_BYTES 32
#else
#define UNDEX_LEVEL v2
#define UNDEX_VECTOR_BYTES 16
#endif

#define UNDEX_INLINE inline __attribute__((always_inline))
#define UNDEX_LAMBDA_INLINE __attribute__((always_inline))

namespace undex::sph::UNDEX_LEVEL {

/// A vector of T (double or float), and of masks for it (all bits set where true).
template <class T>
struct VectorOf;
template <>
struct VectorOf<double> {
  typedef double type __attribute__((vector_size(UNDEX_VECTOR_BYTES)));
  typedef long long mask __attribute__((vector_size(UNDEX_VECTOR_BYTES)));
};
template <>
struct VectorOf<float> {
  typedef float type __attribute__((vector_size(UNDEX_VECTOR_BYTES)));
  typedef int mask __attribute__((vector_size(UNDEX_VECTOR_BYTES)));
};
template <class T>
using Vec = typename VectorOf<T>::type;
template <class T>
using Mask = typename VectorOf<T>::mask;
template <class T>
inline constexpr int lanes = UNDEX_VECTOR_BYTES / int(sizeof(T));

/// Are two types the same? (The standard's own lives in a library header, which must stay out of these files.)
template <class A, class B>
inline constexpr bool same_type = false;
template <class A>
inline constexpr bool same_type<A, A> = true;

/// The number type in a vector.
template <class V>
struct ElementOf;
template <>
struct ElementOf<Vec<double>> {
  using type = double;
};
template <>
struct ElementOf<Vec<float>> {
  using type = float;
};
template <class V>
using Element = typename ElementOf<V>::type;

template <class T>
UNDEX_INLINE Vec<T> broadcast(T a) {
  return a - Vec<T>{};
}
template <class T>
UNDEX_INLINE Vec<T> load(const T* from) {
  return *reinterpret_cast<const Vec<T>*>(from);
}
template <class T>
UNDEX_INLINE void store(T* to, Vec<T> a) {
  *reinterpret_cast<Vec<T>*>(to) = a;
}
template <class V>
UNDEX_INLINE V minimum(V a, V b) {
  return a < b ? a : b;
}
template <class V>
UNDEX_INLINE V maximum(V a, V b) {
  return a > b ? a : b;
}
template <class M, class V>
UNDEX_INLINE V keep(M m, V a) {
  return m ? a : V{};
}

/// Loads lanes<double> numbers from anywhere, converted to double.
UNDEX_INLINE Vec<double> load_double(const double* from) {
  Vec<double> a;
  __builtin_memcpy(&a, from, sizeof a);
  return a;
}
UNDEX_INLINE Vec<double> load_double(const float* from) {
  float part __attribute__((vector_size(UNDEX_VECTOR_BYTES / 2)));
  __builtin_memcpy(&part, from, sizeof part);
  return __builtin_convertvector(part, Vec<double>);
}
/// Stores lanes<double> numbers, converted.
UNDEX_INLINE void store_converted(double* to, Vec<double> a) { __builtin_memcpy(to, &a, sizeof a); }
UNDEX_INLINE void store_converted(float* to, Vec<double> a) {
  typedef float Half __attribute__((vector_size(UNDEX_VECTOR_BYTES / 2)));
  const Half part = __builtin_convertvector(a, Half);
  __builtin_memcpy(to, &part, sizeof part);
}

#if UNDEX_VECTOR_BYTES < 64
/// Bit l is set where lane l is true.
template <class M>
UNDEX_INLINE int bits_of(M m) {
#if UNDEX_VECTOR_BYTES == 32
  return sizeof m[0] == 8 ? _mm256_movemask_pd((__m256d)m) : _mm256_movemask_ps((__m256)m);
#else
  return sizeof m[0] == 8 ? _mm_movemask_pd((__m128d)m) : _mm_movemask_ps((__m128)m);
#endif
}
#endif

/// r[a][b] becomes r[b][a].
UNDEX_INLINE void transpose(Vec<double> (&r)[lanes<double>]) {
#define UNDEX_SWAP(a, b, low, high)             \
  {                                             \
    const Vec<double> x = r[a], y = r[b];       \
    r[a] = __builtin_shufflevector(x, y, low);  \
    r[b] = __builtin_shufflevector(x, y, high); \
  }
#define UNDEX_LIST(...) __VA_ARGS__
#if UNDEX_VECTOR_BYTES == 64
  _Pragma("GCC unroll 8") for (int a = 0; a < 4; ++a)
      UNDEX_SWAP(a, a + 4, UNDEX_LIST(0, 1, 2, 3, 8, 9, 10, 11), UNDEX_LIST(4, 5, 6, 7, 12, 13, 14, 15))
          _Pragma("GCC unroll 8") for (int b = 0; b < 4; ++b) UNDEX_SWAP(
              b + (b & 2), b + (b & 2) + 2, UNDEX_LIST(0, 1, 8, 9, 4, 5, 12, 13), UNDEX_LIST(2, 3, 10, 11, 6, 7, 14, 15))
              _Pragma("GCC unroll 8") for (int a = 0; a < 8; a += 2)
                  UNDEX_SWAP(a, a + 1, UNDEX_LIST(0, 8, 2, 10, 4, 12, 6, 14), UNDEX_LIST(1, 9, 3, 11, 5, 13, 7, 15))
#elif UNDEX_VECTOR_BYTES == 32
  for (int a = 0; a < 2; ++a) UNDEX_SWAP(a, a + 2, UNDEX_LIST(0, 1, 4, 5), UNDEX_LIST(2, 3, 6, 7))
  for (int a = 0; a < 4; a += 2) UNDEX_SWAP(a, a + 1, UNDEX_LIST(0, 4, 2, 6), UNDEX_LIST(1, 5, 3, 7))
#else
  UNDEX_SWAP(0, 1, UNDEX_LIST(0, 2), UNDEX_LIST(1, 3))
#endif
#undef UNDEX_LIST
#undef UNDEX_SWAP
}

#if UNDEX_VECTOR_BYTES >= 32
/// r[k] has the eight numbers of row k (and in its upper half, where there is one, those of row k + 8); it becomes number k of
/// all rows.
UNDEX_INLINE void transpose_eights(Vec<float> (&r)[8]) {
#if UNDEX_VECTOR_BYTES == 64
#define UNDEX_EACH_HALF(a, b, c, d, e, f, g, h) a, b, c, d, e, f, g, h, a + 8, b + 8, c + 8, d + 8, e + 8, f + 8, g + 8, h + 8
#define UNDEX_OTHER 16
#else
#define UNDEX_EACH_HALF(a, b, c, d, e, f, g, h) a, b, c, d, e, f, g, h
#define UNDEX_OTHER 8
#endif
  constexpr int o = UNDEX_OTHER;
  Vec<float> s[8], t[8];
#pragma GCC unroll 4
  for (int k = 0; k < 8; k += 2) {
    s[k] = __builtin_shufflevector(r[k], r[k + 1], UNDEX_EACH_HALF(0, o, 1, o + 1, 4, o + 4, 5, o + 5));
    s[k + 1] = __builtin_shufflevector(r[k], r[k + 1], UNDEX_EACH_HALF(2, o + 2, 3, o + 3, 6, o + 6, 7, o + 7));
  }
#pragma GCC unroll 2
  for (int k = 0; k < 8; k += 4)
#pragma GCC unroll 2
    for (int m = 0; m < 2; ++m) {
      t[k + 2 * m] = __builtin_shufflevector(s[k + m], s[k + 2 + m], UNDEX_EACH_HALF(0, 1, o, o + 1, 4, 5, o + 4, o + 5));
      t[k + 2 * m + 1] = __builtin_shufflevector(s[k + m], s[k + 2 + m], UNDEX_EACH_HALF(2, 3, o + 2, o + 3, 6, 7, o + 6, o + 7));
    }
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k) {
    r[k] = __builtin_shufflevector(t[k], t[k + 4], UNDEX_EACH_HALF(0, 1, 2, 3, o, o + 1, o + 2, o + 3));
    r[k + 4] = __builtin_shufflevector(t[k], t[k + 4], UNDEX_EACH_HALF(4, 5, 6, 7, o + 4, o + 5, o + 6, o + 7));
  }
#undef UNDEX_EACH_HALF
#undef UNDEX_OTHER
}

/// The eight numbers of one row; of two.
UNDEX_INLINE Vec<float> load_eights(const float* a, [[maybe_unused]] const float* b) {
#if UNDEX_VECTOR_BYTES == 64
  const __m512 low = _mm512_castps256_ps512(_mm256_load_ps(a));
  return (Vec<float>)_mm512_insertf32x8(low, _mm256_load_ps(b), 1);
#else
  return (Vec<float>)_mm256_load_ps(a);
#endif
}
#endif

template <bool by_maximum, class V>
UNDEX_INLINE V together(V a, V b) {
  return by_maximum ? maximum(a, b) : a + b;
}

/// Lane l of the result is the sum (or maximum) over the lanes of r[l].
template <bool by_maximum>
UNDEX_INLINE Vec<double> folded(Vec<double> (&r)[lanes<double>]) {
  transpose(r);
#pragma GCC unroll 8
  for (int l = 1; l < lanes<double>; ++l) r[0] = together<by_maximum>(r[0], r[l]);
  return r[0];
}
/// The same of as many vectors in single precision, half by half.
template <bool by_maximum>
UNDEX_INLINE Vec<double> folded(Vec<float> (&r)[lanes<double>]) {
  constexpr int D = lanes<double>;
  typedef float Half __attribute__((vector_size(UNDEX_VECTOR_BYTES / 2)));
  Half s[D];
#pragma GCC unroll 8
  for (int l = 0; l < D; ++l) {
    Half half[2];
    __builtin_memcpy(&half, &r[l], sizeof half);
    s[l] = together<by_maximum>(half[0], half[1]);
  }
#define UNDEX_HALVE(count, low, high)                                                  \
  _Pragma("GCC unroll 8") for (int l = 0; l < count; ++l) s[l] = together<by_maximum>( \
      __builtin_shufflevector(s[2 * l], s[2 * l + 1], low), __builtin_shufflevector(s[2 * l], s[2 * l + 1], high));
#define UNDEX_LIST(...) __VA_ARGS__
#if UNDEX_VECTOR_BYTES == 64
  UNDEX_HALVE(4, UNDEX_LIST(0, 8, 2, 10, 4, 12, 6, 14), UNDEX_LIST(1, 9, 3, 11, 5, 13, 7, 15))
  UNDEX_HALVE(2, UNDEX_LIST(0, 1, 8, 9, 4, 5, 12, 13), UNDEX_LIST(2, 3, 10, 11, 6, 7, 14, 15))
  UNDEX_HALVE(1, UNDEX_LIST(0, 1, 2, 3, 8, 9, 10, 11), UNDEX_LIST(4, 5, 6, 7, 12, 13, 14, 15))
#elif UNDEX_VECTOR_BYTES == 32
  UNDEX_HALVE(2, UNDEX_LIST(0, 4, 2, 6), UNDEX_LIST(1, 5, 3, 7))
  UNDEX_HALVE(1, UNDEX_LIST(0, 1, 4, 5), UNDEX_LIST(2, 3, 6, 7))
#else
  UNDEX_HALVE(1, UNDEX_LIST(0, 2), UNDEX_LIST(1, 3))
#endif
#undef UNDEX_LIST
#undef UNDEX_HALVE
  return __builtin_convertvector(s[0], Vec<double>);
}

// 1/a and 1/sqrt(a) for a > 0: an estimate of 14 bits where there is one, and a Newton step of third order (relative
// error below 1e-12 in double, a rounding or two in float).
#if UNDEX_VECTOR_BYTES == 64
UNDEX_INLINE Vec<double> reciprocal(Vec<double> a) {
  const Vec<double> r = (Vec<double>)_mm512_rcp14_pd((__m512d)a);
  const Vec<double> e = 1.0 - a * r;
  return r + r * (e + e * e);
}
UNDEX_INLINE Vec<float> reciprocal(Vec<float> a) {
  const Vec<float> r = (Vec<float>)_mm512_rcp14_ps((__m512)a);
  return r + r * (1.0f - a * r);
}
UNDEX_INLINE Vec<double> reciprocal_sqrt(Vec<double> a) {
  const Vec<double> r = (Vec<double>)_mm512_rsqrt14_pd((__m512d)a);
  const Vec<double> e = 1.0 - a * r * r;
  return r + r * e * (0.5 + e * (0.375 + e * 0.3125));
}
UNDEX_INLINE Vec<float> reciprocal_sqrt(Vec<float> a) {
  const Vec<float> r = (Vec<float>)_mm512_rsqrt14_ps((__m512)a);
  return r + 0.5f * r * (1.0f - a * r * r);
}
#else
template <class V>
UNDEX_INLINE V reciprocal(V a) {
  return Element<V>(1) / a;
}
#if UNDEX_VECTOR_BYTES == 32
UNDEX_INLINE Vec<double> reciprocal_sqrt(Vec<double> a) { return 1.0 / (Vec<double>)_mm256_sqrt_pd((__m256d)a); }
UNDEX_INLINE Vec<float> reciprocal_sqrt(Vec<float> a) { return 1.0f / (Vec<float>)_mm256_sqrt_ps((__m256)a); }
#else
UNDEX_INLINE Vec<double> reciprocal_sqrt(Vec<double> a) { return 1.0 / (Vec<double>)_mm_sqrt_pd((__m128d)a); }
UNDEX_INLINE Vec<float> reciprocal_sqrt(Vec<float> a) { return 1.0f / (Vec<float>)_mm_sqrt_ps((__m128)a); }
#endif
#endif

}  // namespace undex::sph::UNDEX_LEVEL
