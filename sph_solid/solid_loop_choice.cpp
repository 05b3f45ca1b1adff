#include <stdexcept>

#include "sph_fluid/pairs/compiled_levels.hpp"
#include "sph_fluid/pairs/cpu_level.hpp"
#include "sph_solid/solid_loops.hpp"

namespace undex::solid {

using namespace sph;  // pairs, cells and kernels

#define UNDEX_DECLARE_LEVEL(level)                             \
  namespace level {                                            \
  void solid_deformation(const PairInput&, const PairOutput&); \
  void solid_forces(const PairInput&, const PairOutput&);      \
  void ring_deformation(const PairInput&, const PairOutput&);  \
  void ring_forces(const PairInput&, const PairOutput&);       \
  void contact_overlap(const PairInput&, const PairOutput&);   \
  void contact_forces(const PairInput&, const PairOutput&);    \
  }
UNDEX_COMPILED_LEVELS(UNDEX_DECLARE_LEVEL)

#define UNDEX_LOOPS_AT(level)                                                            \
  case CpuLevel::level:                                                                  \
    return {.deformation = rings ? &level::ring_deformation : &level::solid_deformation, \
            .forces = rings ? &level::ring_forces : &level::solid_forces,                \
            .contact_overlap = &level::contact_overlap,                                  \
            .contact_forces = &level::contact_forces};

SolidLoops solid_loops(bool rings) {
  switch (chosen_cpu_level()) {
    UNDEX_COMPILED_LEVELS(UNDEX_LOOPS_AT)
    default: break;
  }
  throw std::logic_error("no pair loops for this machine: wrong_cpu_level() was not asked");
}

}  // namespace undex::solid
