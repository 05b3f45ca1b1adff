#include "sph_fluid/pairs/cpu_level.hpp"

#include <cstdlib>
#include <string_view>

namespace undex::sph {

CpuLevel chosen_cpu_level() {
  __builtin_cpu_init();
  CpuLevel level = CpuLevel::v2;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) level = CpuLevel::v3;
  if (level == CpuLevel::v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    level = CpuLevel::v4;
  if (const char* asked = std::getenv("UNDEX_CPU_LEVEL")) {
    const std::string_view name(asked);
    if (name == "x86-64-v2") level = CpuLevel::v2;
    if (name == "x86-64-v3" && level > CpuLevel::v3) level = CpuLevel::v3;
  }
  return level;
}

const char* cpu_level() {
  switch (chosen_cpu_level()) {
    case CpuLevel::v4: return "x86-64-v4";
    case CpuLevel::v3: return "x86-64-v3";
    case CpuLevel::v2: break;
  }
  return "x86-64-v2";
}

}  // namespace undex::sph
