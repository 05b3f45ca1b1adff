// The passes of solids over pairs (solid_schemes.hpp), with Wendland's kernel: the loops of the instruction set in use.
#pragma once

#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::sph {

struct SolidLoops {
  void (*deformation)(const PairInput&, const PairOutput&);
  void (*forces)(const PairInput&, const PairOutput&);
  void (*contact_overlap)(const PairInput&, const PairOutput&);
  void (*contact_forces)(const PairInput&, const PairOutput&);
};
SolidLoops solid_loops();

}  // namespace undex::sph
