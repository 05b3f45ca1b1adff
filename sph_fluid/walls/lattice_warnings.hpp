// What a lattice does badly beside symmetry planes and slip walls.
#pragma once

#include <string>
#include <vector>

#include "sph_fluid/settings.hpp"

namespace undex::sph {

/// Symmetry planes and slip walls that lie between the lattice's cell faces, and what to do about it; one sentence each.
/// None where particles settle (water/settle.hpp).
std::vector<std::string> lattice_warnings(const Settings& settings);

}  // namespace undex::sph
