#include <cstdlib>
#include <new>
#include <string_view>

#include "sph_fluid/fluid.hpp"
#include "sph_fluid/kernels.hpp"
#include "sph_fluid/pair_loop.hpp"

namespace undex::sph {

// The schemes' definitions stay with the loops; here their names are enough.
#define UNDEX_DECLARE_LEVEL(level)                                                                              \
  namespace level {                                                                                             \
  struct Monaghan;                                                                                              \
  struct Riemann;                                                                                               \
  template <class Kernel, class Scheme>                                                                         \
  void fluid_rates(const PairInput&, const FluidRates&);                                                        \
  template <class Kernel, class Scheme>                                                                         \
  void wall_forces(const PairInput&, const Cluster*, std::uint32_t, const WallForces&);                         \
  template <class Kernel>                                                                                       \
  PairLoops loops(SchemeName scheme, const char* name, int lanes) {                                             \
    if (scheme == SchemeName::riemann)                                                                          \
      return {name, lanes, true, &fluid_rates<Kernel, Riemann>, &wall_forces<Kernel, Riemann>};                 \
    return {name, lanes, false, &fluid_rates<Kernel, Monaghan>, &wall_forces<Kernel, Monaghan>};                \
  }                                                                                                             \
  PairLoops loops(KernelName kernel, SchemeName scheme, const char* name, int lanes) {                          \
    return kernel == KernelName::gaussian ? loops<Gaussian>(scheme, name, lanes)                                \
                                          : loops<WendlandC2>(scheme, name, lanes);                             \
  }                                                                                                             \
  }

UNDEX_DECLARE_LEVEL(v4)
UNDEX_DECLARE_LEVEL(v3)
UNDEX_DECLARE_LEVEL(v2)

namespace {

int machine_level() {
  __builtin_cpu_init();
  int level = 2;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) level = 3;
  if (level == 3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    level = 4;
  if (const char* asked = std::getenv("UNDEX_CPU_LEVEL")) {
    const std::string_view name(asked);
    if (name == "x86-64-v2") level = 2;
    if (name == "x86-64-v3" && level > 3) level = 3;
  }
  return level;
}

template <class T>
void grow(T*& data, std::uint32_t& capacity, std::uint32_t needed) {
  const std::uint32_t bigger = needed + needed / 2 + 64;
  T* fresh = static_cast<T*>(std::aligned_alloc(64, (std::size_t(bigger) * sizeof(T) + 63) / 64 * 64));
  if (fresh == nullptr) throw std::bad_alloc();
  for (std::uint32_t k = 0; k < capacity; ++k) fresh[k] = data[k];
  std::free(data);
  data = fresh;
  capacity = bigger;
}

}  // namespace

void grow_near(Scratch& s, std::uint32_t needed) {
  std::uint32_t same = s.near_capacity;
  grow(s.near_gradient, same, needed);
  grow(s.near, s.near_capacity, needed);
}
void grow_variable(Scratch& s, std::uint32_t needed) {
  std::uint32_t same = s.variable_capacity;
  grow(s.variable_gradient, same, needed);
  grow(s.variable, s.variable_capacity, needed);
}
void grow_wall(Scratch& s, std::uint32_t needed) { grow(s.wall, s.wall_capacity, needed); }
void grow_index(Scratch& s, std::uint32_t needed) { grow(s.index, s.index_capacity, needed); }

PairLoops pair_loops(KernelName kernel, SchemeName scheme) {
  switch (machine_level()) {
    case 4: return v4::loops(kernel, scheme, "x86-64-v4", 8);
    case 3: return v3::loops(kernel, scheme, "x86-64-v3", 4);
    default: return v2::loops(kernel, scheme, "x86-64-v2", 2);
  }
}

const char* cpu_level() { return pair_loops(KernelName::wendland_c2, SchemeName::monaghan).cpu_level; }

}  // namespace undex::sph
