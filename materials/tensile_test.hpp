// Static hardening of a metal from the three numbers of a handbook's tensile test, by Considere's condition.
// SI units.
#pragma once

#include "materials/flow_stress.hpp"

namespace undex::materials {

/// Engineering values of a tensile test.
struct TensileTest {
  double yield;               ///< [Pa]
  double ultimate;            ///< largest load over initial area [Pa]
  double uniform_elongation;  ///< engineering strain at the largest load [-]. Handbooks give the elongation
                              ///< at break, which is larger: to use it puts the necking point too far out
};

/// The curve that starts at `yield`, passes through true stress `ultimate` (1 + elongation) at true strain
/// ln(1 + elongation), and necks there: dsigma/deps = sigma (Considere). The elastic part of the strain,
/// about half a per cent, is neglected. Throws std::invalid_argument unless 0 < yield < ultimate (1 +
/// elongation), elongation > 0.
PowerHardening hardening_from(const TensileTest& test);

}  // namespace undex::materials
