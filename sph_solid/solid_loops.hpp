// The passes of solids over pairs (solid_schemes.hpp), with Wendland's kernel: the loops of the instruction set in use.
#pragma once

#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::solid {

struct SolidLoops {
  void (*deformation)(const sph::PairInput&, const sph::PairOutput&);
  void (*forces)(const sph::PairInput&, const sph::PairOutput&);
  void (*contact_overlap)(const sph::PairInput&, const sph::PairOutput&);
  void (*contact_forces)(const sph::PairInput&, const sph::PairOutput&);
};
/// Those of rings about an axis (solid_rings.hpp), or of the plane and of space.
SolidLoops solid_loops(bool rings);

}  // namespace undex::solid
