#include "sph_fluid/pairs/cpu_level.hpp"

#include <cstdlib>
#include <string_view>

#include "sph_fluid/pairs/compiled_levels.hpp"
#include "sph_fluid/pairs/machine_level.hpp"

namespace undex::sph {

namespace {

#define UNDEX_LEVEL_NAME(level) CpuLevel::level,
constexpr CpuLevel compiled[] = {UNDEX_COMPILED_LEVELS(UNDEX_LEVEL_NAME)};  // the highest first

const char* name_of(CpuLevel level) {
  switch (level) {
    case CpuLevel::v4: return "x86-64-v4";
    case CpuLevel::v3: return "x86-64-v3";
    case CpuLevel::v2: return "x86-64-v2";
    case CpuLevel::none: break;
  }
  return "none";
}

std::string names_of_compiled() {
  std::string names;
  for (const CpuLevel level : compiled) names += (names.empty() ? "" : ", ") + std::string(name_of(level));
  return names;
}

/// The level that UNDEX_CPU_LEVEL names; of a word that is none, or where it is not set, the machine's.
CpuLevel asked_level() {
  if (const char* asked = std::getenv("UNDEX_CPU_LEVEL"))
    for (const CpuLevel level : {CpuLevel::v2, CpuLevel::v3, CpuLevel::v4})
      if (std::string_view(asked) == name_of(level)) return level;
  return CpuLevel(machine_level());
}

}  // namespace

CpuLevel chosen_cpu_level() {
  for (const CpuLevel level : compiled)
    if (int(level) <= machine_level() && level <= asked_level()) return level;
  return CpuLevel::none;
}

const char* cpu_level() { return name_of(chosen_cpu_level()); }

std::string wrong_cpu_level() {
  const std::string machine = name_of(CpuLevel(machine_level()));
  const char* asked = std::getenv("UNDEX_CPU_LEVEL");
  if (asked != nullptr && *asked != '\0') {
    const std::string words = std::string("UNDEX_CPU_LEVEL=") + asked + ": ";
    if (std::string_view(asked) != name_of(asked_level())) return words + "no such level; known: x86-64-v2, x86-64-v3, x86-64-v4";
    if (int(asked_level()) > machine_level()) return words + "this machine has at most " + machine;
    if (chosen_cpu_level() != asked_level()) return words + "this build has no loops for it, but for " + names_of_compiled();
    return "";
  }
  if (chosen_cpu_level() != CpuLevel::none) return "";
  return "this program was built for " + names_of_compiled() + ", and this machine has " + machine +
         ": build it here, or with -DUNDEX_CPU_LEVELS=all";
}

}  // namespace undex::sph
