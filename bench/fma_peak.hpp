// What the floating-point units can do at most: independent chains of fused multiply-adds, at the instruction set that the
// pair loops run with.
#pragma once

namespace undex::bench {

/// Runs `rounds` rounds of multiply-adds in registers and returns the number of floating-point operations that took.
using FmaChains = double (*)(long rounds);

FmaChains fma_chains_double();
FmaChains fma_chains_float();

}  // namespace undex::bench
