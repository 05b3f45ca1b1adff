// The compiled loops of a scheme (schemes/table.hpp), of the instruction set that is chosen at start-up.
#pragma once

#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/schemes/table.hpp"

namespace undex::sph {

struct PairLoops {
  SecondRow second;    ///< the rows that `rates` reads beside FluidRow
  double support;      ///< of the kernel, in smoothing lengths
  PairLoop gradients;  ///< fills those rows; null where the scheme has no use for it
  PairLoop rates;      ///< adds every pair to the sums of `out`, which the caller has set to zero

  /// Does a pass for gradients come before the fluxes?
  bool reconstructs() const { return gradients != nullptr; }
};

/// The loops of the best instruction set that this machine has; the environment variable UNDEX_CPU_LEVEL (x86-64-v2, -v3,
/// -v4) asks for a lower one. `rings`: those over rings about an axis (schemes/rings.hpp); throws
/// std::invalid_argument where the scheme has none.
PairLoops pair_loops(KernelName kernel, SchemeName scheme, Precision precision, bool rings = false);

}  // namespace undex::sph
