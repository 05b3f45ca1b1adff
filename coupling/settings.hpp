// What a scene says about the coupling of water and structure.
#pragma once

namespace undex::coupling {

struct Settings {
  /// Slip of the water along the wet faces.
  bool free_slip = true;
  /// Longest coupling window, in structure steps: the structure is advanced once the fluid has covered this share of the
  /// structure's stable step (or at every fluid step, when the fluid's is the longer one).
  double window = 1.0;
};

}  // namespace undex::coupling
