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
UNDEX_DECLARE_LEVEL(v4)
UNDEX_DECLARE_LEVEL(v3)
UNDEX_DECLARE_LEVEL(v2)

SolidLoops solid_loops(bool rings) {
  switch (chosen_cpu_level()) {
    case CpuLevel::v4:
      return {.deformation = rings ? &v4::ring_deformation : &v4::solid_deformation,
              .forces = rings ? &v4::ring_forces : &v4::solid_forces,
              .contact_overlap = &v4::contact_overlap,
              .contact_forces = &v4::contact_forces};
    case CpuLevel::v3:
      return {.deformation = rings ? &v3::ring_deformation : &v3::solid_deformation,
              .forces = rings ? &v3::ring_forces : &v3::solid_forces,
              .contact_overlap = &v3::contact_overlap,
              .contact_forces = &v3::contact_forces};
    case CpuLevel::v2: break;
  }
  return {.deformation = rings ? &v2::ring_deformation : &v2::solid_deformation,
          .forces = rings ? &v2::ring_forces : &v2::solid_forces,
          .contact_overlap = &v2::contact_overlap,
          .contact_forces = &v2::contact_forces};
}

}  // namespace undex::solid
