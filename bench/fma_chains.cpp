// Compiled once per instruction set, like the pair loops; UNDEX_BENCH_LEVEL is its namespace.
namespace undex::bench::UNDEX_BENCH_LEVEL {
namespace {

#if defined(__AVX512F__)
constexpr int width = 64;  // [byte]
#elif defined(__AVX__)
constexpr int width = 32;
#else
constexpr int width = 16;
#endif
constexpr int chains = 12;  // enough to hide the latency, few enough for sixteen registers

template <class Real>
double fma_chains(long rounds) {
  typedef Real Vec __attribute__((vector_size(width)));
  constexpr int lanes = width / sizeof(Real);
  const Vec factor = Real(0.75) - Vec{}, term = Real(0.25) - Vec{};
  Vec x[chains];
#pragma GCC unroll 12
  for (int k = 0; k < chains; ++k) x[k] = Real(k) - Vec{};
  for (long round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
    for (int k = 0; k < chains; ++k) {
      x[k] = x[k] * factor + term;
      __asm__ volatile("" : "+v"(x[k]));  // every one is computed, in a register
    }
  }
  return 2.0 * lanes * chains * double(rounds);
}

}  // namespace

double fma_chains_double(long rounds) { return fma_chains<double>(rounds); }
double fma_chains_float(long rounds) { return fma_chains<float>(rounds); }

}  // namespace undex::bench::UNDEX_BENCH_LEVEL
