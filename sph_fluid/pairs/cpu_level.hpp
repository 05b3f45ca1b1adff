// The instruction set that the pair loops run with: the best that this machine and this build have, or a lower one that is asked
// for.
#pragma once

#include <string>

namespace undex::sph {

enum class CpuLevel : int { none = 0, v2 = 2, v3 = 3, v4 = 4 };

/// The best of the build's levels that this machine can run; the environment variable UNDEX_CPU_LEVEL (x86-64-v2, -v3, -v4) asks
/// for a lower one. none: see wrong_cpu_level().
CpuLevel chosen_cpu_level();

/// Its name: "x86-64-v4", "x86-64-v3" or "x86-64-v2".
const char* cpu_level();

/// Why no loops can be chosen: UNDEX_CPU_LEVEL is a word that is no level, or one that this machine or this build has not; or the
/// build has none for this machine. Empty: nothing is wrong.
std::string wrong_cpu_level();

}  // namespace undex::sph
