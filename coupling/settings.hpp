// What a scene says about the coupling of water and structure, and of water and solids in particles.
#pragma once

#include "core/record.hpp"

namespace undex::coupling {

/// How water and solids in particles (solid::Solids) meet.
enum class SolidContact {
  particles,  ///< one system of particles: a solid particle is a wall particle of the water's pair loop
  surface,    ///< through the wet faces, as water and finite elements do
};
constexpr auto words(SolidContact) {
  return std::to_array<Word<SolidContact>>({{"particles", SolidContact::particles}, {"surface", SolidContact::surface}});
}

struct Settings {
  SolidContact solids = SolidContact::particles;
  /// Slip of the water along the wet faces.
  bool free_slip = true;
  /// Longest coupling window, in structure steps: the structure is advanced once the fluid has covered this share of the
  /// structure's stable step (or at every fluid step, when the fluid's is the longer one).
  double window = 1.0;
};

template <class Visit>
void describe(Settings& coupling, Visit&& visit) {
  visit(coupling.free_slip, {.name = "slip", .meaning = "water slips along the wet faces and solids"});
  visit(coupling.window, {.name = "window",
                          .range = Range::between(0.01, 100),
                          .meaning = "longest coupling window, in stable steps of the structure"});
  visit(coupling.solids, {.name = "solids",
                          .meaning = "water and solids are one system of particles, pair by pair, or meet through "
                                     "the solids' wet faces (`wet` is needed then)"});
}

}  // namespace undex::coupling
