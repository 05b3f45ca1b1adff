// The start of solids in particles: each body filled with particles on a lattice of its own, fitted to its shape.
#pragma once

#include <vector>

#include "sph_fluid/lattice.hpp"
#include "sph_solid/settings.hpp"

namespace undex::solid {

/// Particles of every body, in the scene's order. Throws std::invalid_argument where a body gets none, or cannot have rings.
std::vector<sph::BodyParticles> fill_solids(const Settings& settings, const sph::Settings& around);

}  // namespace undex::solid
