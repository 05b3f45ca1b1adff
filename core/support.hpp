// A face that is held.
#pragma once

#include <array>
#include <string>

#include "core/record.hpp"

namespace undex {

/// Nodes of a named face, or the particles of the row beneath it, whose marked velocity components stay zero.
struct Support {
  std::string face;
  std::array<bool, 3> fixed{true, true, true};
};
template <class Visit>
void describe(Support& support, Visit&& visit) {
  visit(support.face, {.name = "face", .needed = true, .remedy = "name the face that is held", .values = "a face"});
  visit(support.fixed, {.name = "fixed", .meaning = "components of the motion that are held"});
}

}  // namespace undex
