#include "sph_fluid/schemes/loops.hpp"

#include "sph_fluid/pairs/cpu_level.hpp"

namespace undex::sph {
namespace {

PairLoops put_together(KernelName kernel, CompiledLoop rates, PairLoop gradients) {
  return {.second = rates.second, .support = kernel_choice(kernel, 1).support, .gradients = gradients, .rates = rates.run};
}

}  // namespace

// Every scheme's loops are functions of the instruction sets' namespaces, defined in files made of schemes/loop.cpp.in.
#define UNDEX_DECLARE(pass) CompiledLoop pass(KernelName, Precision), pass##_of_rings(KernelName, Precision);
#define UNDEX_DECLARE_ONE(name, ...) UNDEX_DECLARE(name##_rates)
#define UNDEX_DECLARE_TWO(name, ...) UNDEX_DECLARE(name##_rates) UNDEX_DECLARE(name##_gradients)
#define UNDEX_PASS(pass) (rings ? pass##_of_rings : pass)(kernel, precision)
#define UNDEX_CHOOSE_ONE(name, ...) \
  if (scheme == SchemeName::name) return put_together(kernel, UNDEX_PASS(name##_rates), nullptr);
#define UNDEX_CHOOSE_TWO(name, ...) \
  if (scheme == SchemeName::name) return put_together(kernel, UNDEX_PASS(name##_rates), UNDEX_PASS(name##_gradients).run);
#define UNDEX_LOOPS_OF(level)                                                                     \
  namespace level {                                                                               \
  UNDEX_SCHEMES(UNDEX_DECLARE_ONE, UNDEX_DECLARE_TWO)                                             \
  static PairLoops loops(KernelName kernel, SchemeName scheme, Precision precision, bool rings) { \
    UNDEX_SCHEMES(UNDEX_CHOOSE_ONE, UNDEX_CHOOSE_TWO)                                             \
    return {};                                                                                    \
  }                                                                                               \
  }

UNDEX_LOOPS_OF(v4)
UNDEX_LOOPS_OF(v3)
UNDEX_LOOPS_OF(v2)

PairLoops pair_loops(KernelName kernel, SchemeName scheme, Precision precision, bool rings) {
  switch (chosen_cpu_level()) {
    case CpuLevel::v4: return v4::loops(kernel, scheme, precision, rings);
    case CpuLevel::v3: return v3::loops(kernel, scheme, precision, rings);
    case CpuLevel::v2: break;
  }
  return v2::loops(kernel, scheme, precision, rings);
}

}  // namespace undex::sph
