// What a scene says about the coupling of water and structure, and of water and solids in particles.
#pragma once

namespace undex::coupling {

/// How water and solids in particles (solid::Solids) meet.
enum class SolidContact {
  particles,  ///< one system of particles: a solid particle is a wall particle of the water's pair loop
  surface,    ///< through the wet faces, as water and finite elements do
};

struct Settings {
  SolidContact solids = SolidContact::particles;
  /// Slip of the water along the wet faces.
  bool free_slip = true;
  /// Longest coupling window, in structure steps: the structure is advanced once the fluid has covered this share of the
  /// structure's stable step (or at every fluid step, when the fluid's is the longer one).
  double window = 1.0;
};

}  // namespace undex::coupling
