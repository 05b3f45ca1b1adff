#include "sph_fluid/schemes/loops.hpp"

#include "sph_fluid/pairs/cpu_level.hpp"

namespace undex::sph {
namespace {

PairLoops put_together(KernelName kernel, CompiledLoop rates, PairLoop gradients) {
  return {.second = rates.second, .support = kernel_choice(kernel, 1).support, .gradients = gradients, .rates = rates.run};
}

}  // namespace

// Every scheme's loops are functions of the instruction sets' namespaces, defined in files made of schemes/loop.cpp.in.
#define UNDEX_DECLARE_ONE(name, ...) CompiledLoop name##_rates(KernelName, Precision);
#define UNDEX_DECLARE_TWO(name, ...)                \
  CompiledLoop name##_rates(KernelName, Precision); \
  CompiledLoop name##_gradients(KernelName, Precision);
#define UNDEX_CHOOSE_ONE(name, ...) \
  if (scheme == SchemeName::name) return put_together(kernel, name##_rates(kernel, precision), nullptr);
#define UNDEX_CHOOSE_TWO(name, ...) \
  if (scheme == SchemeName::name)   \
    return put_together(kernel, name##_rates(kernel, precision), name##_gradients(kernel, precision).run);
#define UNDEX_LOOPS_OF(level)                                                         \
  namespace level {                                                                   \
  UNDEX_SCHEMES(UNDEX_DECLARE_ONE, UNDEX_DECLARE_TWO)                                 \
  static PairLoops loops(KernelName kernel, SchemeName scheme, Precision precision) { \
    UNDEX_SCHEMES(UNDEX_CHOOSE_ONE, UNDEX_CHOOSE_TWO)                                 \
    return {};                                                                        \
  }                                                                                   \
  }

UNDEX_LOOPS_OF(v4)
UNDEX_LOOPS_OF(v3)
UNDEX_LOOPS_OF(v2)

PairLoops pair_loops(KernelName kernel, SchemeName scheme, Precision precision) {
  switch (chosen_cpu_level()) {
    case CpuLevel::v4: return v4::loops(kernel, scheme, precision);
    case CpuLevel::v3: return v3::loops(kernel, scheme, precision);
    case CpuLevel::v2: break;
  }
  return v2::loops(kernel, scheme, precision);
}

}  // namespace undex::sph
