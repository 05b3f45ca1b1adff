// Rigid walls lined with dummy particles.
#pragma once

#include <vector>

#include "sph_fluid/settings.hpp"
#include "sph_fluid/walls/moving_walls.hpp"

namespace undex::sph {

/// Dummy particles of the rigid walls: the lattice continued beyond every face that is not open and in which the fluid is not
/// mirrored, as deep as the kernel reaches (at least three layers). One wall per slip condition; their velocity is zero.
std::vector<LinedWall> line_walls(const Settings& settings);

}  // namespace undex::sph
