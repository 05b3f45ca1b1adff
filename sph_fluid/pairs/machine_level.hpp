// What this machine's processor can do. CMake runs it too, to build loops for this machine alone.
#pragma once

namespace undex::sph {

/// Of the levels x86-64-v2, -v3 and -v4 the highest that the processor has: 2, 3 or 4.
inline int machine_level() {
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 2;
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  return wide ? 4 : 3;
}

}  // namespace undex::sph
