#include "sph_fluid/pairs/cpu_level.hpp"

#include <cstdlib>
#include <string_view>

namespace undex::sph {

namespace {

CpuLevel best_cpu_level() {
  __builtin_cpu_init();
  CpuLevel level = CpuLevel::v2;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) level = CpuLevel::v3;
  if (level == CpuLevel::v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    level = CpuLevel::v4;
  return level;
}

const char* name_of(CpuLevel level) {
  switch (level) {
    case CpuLevel::v4: return "x86-64-v4";
    case CpuLevel::v3: return "x86-64-v3";
    case CpuLevel::v2: break;
  }
  return "x86-64-v2";
}

}  // namespace

CpuLevel chosen_cpu_level() {
  CpuLevel level = best_cpu_level();
  if (const char* asked = std::getenv("UNDEX_CPU_LEVEL")) {
    const std::string_view name(asked);
    if (name == "x86-64-v2") level = CpuLevel::v2;
    if (name == "x86-64-v3" && level > CpuLevel::v3) level = CpuLevel::v3;
  }
  return level;
}

const char* cpu_level() { return name_of(chosen_cpu_level()); }

std::string wrong_cpu_level() {
  const char* asked = std::getenv("UNDEX_CPU_LEVEL");
  if (asked == nullptr || *asked == '\0') return "";
  for (const CpuLevel level : {CpuLevel::v2, CpuLevel::v3, CpuLevel::v4})
    if (std::string_view(asked) == name_of(level))
      return level <= best_cpu_level()
                 ? ""
                 : std::string("UNDEX_CPU_LEVEL=") + asked + ": this machine has at most " + name_of(best_cpu_level());
  return std::string("UNDEX_CPU_LEVEL=") + asked + ": no such level; known: x86-64-v2, x86-64-v3, x86-64-v4";
}

}  // namespace undex::sph
