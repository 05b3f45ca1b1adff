// The instruction set that the pair loops run with: the best that this machine has, or a lower one that is asked for.
#pragma once

#include <string>

namespace undex::sph {

enum class CpuLevel : int { v2 = 2, v3 = 3, v4 = 4 };

/// What this machine can do; the environment variable UNDEX_CPU_LEVEL (x86-64-v2, -v3, -v4) asks for less.
CpuLevel chosen_cpu_level();

/// Its name: "x86-64-v4", "x86-64-v3" or "x86-64-v2".
const char* cpu_level();

/// What is wrong with UNDEX_CPU_LEVEL: a word that is no level, or one that this machine has not; empty: nothing.
std::string wrong_cpu_level();

}  // namespace undex::sph
