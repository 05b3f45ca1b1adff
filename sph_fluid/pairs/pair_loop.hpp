// Entry points of the pair loops: one table of functions per instruction set, one of them chosen at start-up.
#pragma once

#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::sph {

/// What a scheme reads of a particle beside FluidRow: which of PairInput's arrays must be there.
enum class SecondRow { none, gradient, corrected, viscosity };

struct PairLoops {
  SecondRow second;
  double support;  ///< of the kernel, in smoothing lengths
  /// Fills PairInput::gradient or ::corrected, for `rates`; null where the scheme has no use for them.
  void (*gradients)(const PairInput&, const PairOutput&);
  /// Adds every pair to the sums of `out`, which the caller has set to zero.
  void (*rates)(const PairInput&, const PairOutput&);

  /// Does a pass for gradients come before the fluxes?
  bool reconstructs() const { return gradients != nullptr; }
};

/// The loops of the best instruction set that this machine has; the environment variable UNDEX_CPU_LEVEL (x86-64-v2, -v3,
/// -v4) asks for a lower one.
PairLoops pair_loops(KernelName kernel, SchemeName scheme, Precision precision);
KernelChoice kernel_choice(KernelName kernel, int dimension);

}  // namespace undex::sph
