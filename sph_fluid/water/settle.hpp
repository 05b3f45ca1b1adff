// A settled start: particles are moved until uniform pressure leaves them at rest. Under the pressure p a particle of the density
// rho is accelerated by
//   a_i = -(2 p/rho) g_i,   g_i = sum_j V_j grad W_ij,
// images, dummies and whatever the scheme corrects included. That is -2 p/(rho V_i) times the gradient of sum V_i V_j W_ij/2, so
// descent along -g ends where all g vanish (Litvinov, Hu, Adams 2015, J. Comput. Phys. 301, 394). Here g is what the scheme
// itself computes. Volumes stay as they are.
#pragma once

#include <vector>

#include "sph_fluid/lattice.hpp"
#include "sph_fluid/water/water.hpp"

namespace undex::sph {

/// |g| h that counts as rest: pressures are uneven by about this share of it.
inline constexpr double rest_residual = 5e-3;

/// Moves the particles of `bodies` where |g| h is larger, and those within reach of them. Left alone are particles within reach
/// of a free surface, of bodies with another spacing and of bodies that a start has laid. `water` has the scene's settings and
/// all walls; its particles become others, and it is of no use afterwards. Returns false where all are at rest as they are.
bool settle(Water& water, std::vector<BodyParticles>& bodies);

}  // namespace undex::sph
