#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>

#include "sph_fluid/pairs/cpu_level.hpp"
#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/pairs/pair_loop.hpp"

namespace undex::sph {

using Pass = void (*)(const PairInput&, const PairOutput&);

// The oldest two kernels and schemes have loops of their own; all else goes through one loop that serves any kernel, which
// costs a little time in a run and saves much in the build (docs/performance.md).
#define UNDEX_DECLARE_LEVEL(level)                                                                                \
  namespace level {                                                                                               \
  struct AnyKernel;                                                                                               \
  template <class Kernel, class T>                                                                                \
  void reconstruction(const PairInput&, const PairOutput&);                                                       \
  template <class T>                                                                                              \
  void corrected_reconstruction(const PairInput&, const PairOutput&);                                             \
  template <class Kernel, class T>                                                                                \
  void monaghan_rates(const PairInput&, const PairOutput&);                                                       \
  template <class Kernel, class T>                                                                                \
  void riemann_rates(const PairInput&, const PairOutput&);                                                        \
  template <class T>                                                                                              \
  void paper_rates(const PairInput&, const PairOutput&);                                                          \
  template <class T>                                                                                              \
  void monaghan_switch_rates(const PairInput&, const PairOutput&);                                                \
  template <class T>                                                                                              \
  void riemann_corrected_rates(const PairInput&, const PairOutput&);                                              \
  template <class T>                                                                                              \
  Pass rates(KernelName kernel, SchemeName scheme) {                                                              \
    switch (scheme) {                                                                                             \
      case SchemeName::paper: return &paper_rates<T>;                                                             \
      case SchemeName::monaghan_switch: return &monaghan_switch_rates<T>;                                         \
      case SchemeName::riemann_corrected: return &riemann_corrected_rates<T>;                                     \
      case SchemeName::monaghan:                                                                                  \
        return kernel == KernelName::gaussian      ? &monaghan_rates<Gaussian, T>                                 \
               : kernel == KernelName::wendland_c2 ? &monaghan_rates<WendlandC2, T>                               \
                                                   : &monaghan_rates<AnyKernel, T>;                               \
      case SchemeName::riemann: break;                                                                            \
    }                                                                                                             \
    return kernel == KernelName::gaussian      ? &riemann_rates<Gaussian, T>                                      \
           : kernel == KernelName::wendland_c2 ? &riemann_rates<WendlandC2, T>                                    \
                                               : &riemann_rates<AnyKernel, T>;                                    \
  }                                                                                                               \
  template <class T>                                                                                              \
  Pass gradients(KernelName kernel, SchemeName scheme) {                                                          \
    if (scheme == SchemeName::riemann_corrected) return &corrected_reconstruction<T>;                             \
    if (scheme != SchemeName::riemann) return nullptr;                                                            \
    return kernel == KernelName::gaussian      ? &reconstruction<Gaussian, T>                                     \
           : kernel == KernelName::wendland_c2 ? &reconstruction<WendlandC2, T>                                   \
                                               : &reconstruction<AnyKernel, T>;                                   \
  }                                                                                                               \
  PairLoops loops(KernelName kernel, SchemeName scheme, Precision precision) {                                    \
    return {second_row(scheme), kernel_choice(kernel, 1).support,                                                 \
            precision == Precision::mixed ? gradients<float>(kernel, scheme) : gradients<double>(kernel, scheme), \
            precision == Precision::mixed ? rates<float>(kernel, scheme) : rates<double>(kernel, scheme)};        \
  }                                                                                                               \
  }

namespace {

SecondRow second_row(SchemeName scheme) {
  switch (scheme) {
    case SchemeName::riemann: return SecondRow::gradient;
    case SchemeName::riemann_corrected: return SecondRow::corrected;
    case SchemeName::monaghan_switch: return SecondRow::viscosity;
    case SchemeName::monaghan:
    case SchemeName::paper: break;
  }
  return SecondRow::none;
}

}  // namespace

KernelChoice kernel_choice(KernelName kernel, int dimension) {
  return with_kernel(kernel, [&](auto k) { return KernelChoice{kernel, k.support, k.norm(dimension)}; });
}

UNDEX_DECLARE_LEVEL(v4)
UNDEX_DECLARE_LEVEL(v3)
UNDEX_DECLARE_LEVEL(v2)

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
    s.capacity = candidates;
  }
}

void release(Scratch& s) {
  for (void* data :
       {s.blocks, static_cast<void*>(s.index), static_cast<void*>(s.x), static_cast<void*>(s.y), static_cast<void*>(s.z)})
    std::free(data);
  s = {};
}

PairLoops pair_loops(KernelName kernel, SchemeName scheme, Precision precision) {
  switch (chosen_cpu_level()) {
    case CpuLevel::v4: return v4::loops(kernel, scheme, precision);
    case CpuLevel::v3: return v3::loops(kernel, scheme, precision);
    case CpuLevel::v2: break;
  }
  return v2::loops(kernel, scheme, precision);
}

}  // namespace undex::sph
