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

/// |g| h that counts as rest, and where descent ends: pressures are uneven by about this share of it.
inline constexpr double rest_residual = 5e-3, descended_residual = 5e-4;
/// The same about an axis, and where a descent ends short of the above.
inline constexpr double easy_residual = 5e-4, settled_residual = 2e-4;

struct Settled {
  bool moved = false;
  double residual = 0;  ///< the largest |g| h of those that were moved
};

/// Moves the particles of `bodies` that are not at rest, and those within reach of them, until all are, or as near to that as it
/// gets; with a larger `goal` until |g| h is below that. Left alone are particles within reach of a free surface, of bodies with
/// another spacing and of bodies that a start has laid. `water` has the scene's settings and all walls; its particles become
/// others.
Settled settle(Water& water, std::vector<BodyParticles>& bodies, double goal = settled_residual, const SettleNews& news = {});

}  // namespace undex::sph
