// A rigid, smooth plane that solids, of elements or of particles, cannot pass; they may leave it again.
#pragma once

#include "core/record.hpp"

namespace undex {

struct RigidPlane {
  int axis = 2;            ///< of its normal
  double position = 0;     ///< [m]
  bool body_above = true;  ///< do the bodies lie at x[axis] >= position? Otherwise at <=
};

template <class Visit>
void describe(RigidPlane& plane, Visit&& visit) {
  visit(plane.axis, {.name = "axis",
                     .needed = true,
                     .remedy = "say across which axis the plane lies, e.g. axis = \"z\"",
                     .form = Form::scene_axis,
                     .meaning = "across which the plane lies"});
  visit(plane.position, {.name = "position", .unit = "m", .range = Range::position(), .meaning = "along that axis"});
  visit(plane.body_above, {.name = "free_side",
                           .yes = "above",
                           .no = "below",
                           .meaning = "where the bodies are: at larger or at smaller coordinates"});
}

}  // namespace undex
