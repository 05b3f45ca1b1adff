#include "sph_fluid/schemes/loops.hpp"

#include <stdexcept>

#include "sph_fluid/pairs/compiled_levels.hpp"
#include "sph_fluid/pairs/cpu_level.hpp"

namespace undex::sph {
namespace {

PairLoops put_together(KernelName kernel, CompiledLoop rates, PairLoop gradients) {
  return {.second = rates.second, .support = kernel_choice(kernel, 1).support, .gradients = gradients, .rates = rates.run};
}

}  // namespace

// Every scheme's loops are functions of the instruction sets' namespaces, defined in files made of schemes/loop.cpp.in.
#define UNDEX_DECLARE_no_rings(pass) CompiledLoop pass(KernelName, Precision);
#define UNDEX_DECLARE_rings(pass) CompiledLoop pass(KernelName, Precision), pass##_of_rings(KernelName, Precision);
#define UNDEX_DECLARE_ONE(name, rates, kind, ringed, ...) UNDEX_DECLARE_##ringed(name##_rates)
#define UNDEX_DECLARE_TWO(name, rates, gradients, kind, ringed, ...) \
  UNDEX_DECLARE_##ringed(name##_rates) UNDEX_DECLARE_##ringed(name##_gradients)
#define UNDEX_PASS_no_rings(pass) pass(kernel, precision)
#define UNDEX_PASS_rings(pass) (rings ? pass##_of_rings : pass)(kernel, precision)
#define UNDEX_CHOOSE_ONE(name, rates, kind, ringed, ...) \
  if (scheme == SchemeName::name) return put_together(kernel, UNDEX_PASS_##ringed(name##_rates), nullptr);
#define UNDEX_CHOOSE_TWO(name, rates, gradients, kind, ringed, ...) \
  if (scheme == SchemeName::name)                                   \
    return put_together(kernel, UNDEX_PASS_##ringed(name##_rates), UNDEX_PASS_##ringed(name##_gradients).run);
#define UNDEX_LOOPS_OF(level)                                                                     \
  namespace level {                                                                               \
  UNDEX_SCHEMES(UNDEX_DECLARE_ONE, UNDEX_DECLARE_TWO)                                             \
  static PairLoops loops(KernelName kernel, SchemeName scheme, Precision precision, bool rings) { \
    UNDEX_SCHEMES(UNDEX_CHOOSE_ONE, UNDEX_CHOOSE_TWO)                                             \
    return {};                                                                                    \
  }                                                                                               \
  }

UNDEX_COMPILED_LEVELS(UNDEX_LOOPS_OF)

#define UNDEX_LOOPS_AT(level) \
  case CpuLevel::level: return level::loops(kernel, scheme, precision, rings);

PairLoops pair_loops(KernelName kernel, SchemeName scheme, Precision precision, bool rings) {
  if (rings && !has_rings(scheme)) throw std::invalid_argument("scheme.name: this scheme does not compute rings about an axis");
  switch (chosen_cpu_level()) {
    UNDEX_COMPILED_LEVELS(UNDEX_LOOPS_AT)
    default: break;
  }
  throw std::logic_error("no pair loops for this machine: wrong_cpu_level() was not asked");
}

}  // namespace undex::sph
