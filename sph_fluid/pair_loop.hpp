// Entry points of the pair loops: one table of functions per instruction set, one of them chosen at start-up.
#pragma once

#include "sph_fluid/pair_data.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::sph {

struct PairLoops {
  const char* cpu_level;
  int lanes;  ///< particles per cluster
  bool needs_gradients;  ///< must PairInput::gradients be given?
  void (*fluid_rates)(const PairInput&, const FluidRates&);
  void (*wall_forces)(const PairInput&, const Cluster* wall_clusters, std::uint32_t count, const WallForces&);
};

/// The loops of the best instruction set that this machine has; the environment variable UNDEX_CPU_LEVEL (x86-64-v2, -v3,
/// -v4) asks for a lower one.
PairLoops pair_loops(KernelName kernel, SchemeName scheme);

}  // namespace undex::sph
