#include "bench/fma_peak.hpp"

#include <string_view>

#include "sph_fluid/water/fluid.hpp"
#include "sph_fluid/pairs/cpu_level.hpp"

namespace undex::bench {

#define UNDEX_DECLARE_LEVEL(level)       \
  namespace level {                      \
  double fma_chains_double(long rounds); \
  double fma_chains_float(long rounds);  \
  }
UNDEX_DECLARE_LEVEL(v2)
UNDEX_DECLARE_LEVEL(v3)
UNDEX_DECLARE_LEVEL(v4)

namespace {

FmaChains choose(FmaChains v2, FmaChains v3, FmaChains v4) {
  const std::string_view level = sph::cpu_level();
  return level == "x86-64-v4" ? v4 : level == "x86-64-v3" ? v3 : v2;
}

}  // namespace

FmaChains fma_chains_double() { return choose(v2::fma_chains_double, v3::fma_chains_double, v4::fma_chains_double); }
FmaChains fma_chains_float() { return choose(v2::fma_chains_float, v3::fma_chains_float, v4::fma_chains_float); }

}  // namespace undex::bench
