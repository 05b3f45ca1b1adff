// The instruction sets that this build has pair loops for (CMake's UNDEX_CPU_LEVELS), as a list for macros.
#pragma once

#ifdef UNDEX_HAS_LEVEL_v4
#define UNDEX_IF_LEVEL_v4(use) use(v4)
#else
#define UNDEX_IF_LEVEL_v4(use)
#endif
#ifdef UNDEX_HAS_LEVEL_v3
#define UNDEX_IF_LEVEL_v3(use) use(v3)
#else
#define UNDEX_IF_LEVEL_v3(use)
#endif
#ifdef UNDEX_HAS_LEVEL_v2
#define UNDEX_IF_LEVEL_v2(use) use(v2)
#else
#define UNDEX_IF_LEVEL_v2(use)
#endif

/// use(level) for each of them, the highest first.
#define UNDEX_COMPILED_LEVELS(use) UNDEX_IF_LEVEL_v4(use) UNDEX_IF_LEVEL_v3(use) UNDEX_IF_LEVEL_v2(use)
