// Predict, evaluate once, correct: kick-drift-kick with rates taken at a predicted state. A predictor by the last rates alone
// makes waves grow by a relative (omega dt)^4/4 a step; extrapolating them by a sixth of their last change cancels that term: an
// undamped wave still grows, by 1e-3 a step at omega dt = 0.45, but by O((omega dt)^6), at no further evaluation.
#pragma once

#include "sph_fluid/water/water.hpp"

namespace undex::sph {

/// One step of all. One that goes wrong ends between its two kicks: that state is finite, the ledger holds for it, and its
/// pressures are evaluated; it has no rates.
void step_leapfrog(Water& water, double dt);

}  // namespace undex::sph
