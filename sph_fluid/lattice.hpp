// The start: shapes filled with particles, and the lengths that go with a lattice.
#pragma once

#include <string>
#include <vector>

#include "sph_fluid/lattice_grid.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::sph {

struct BodyParticles {
  std::vector<Vec3> position;  ///< [m]
  std::vector<double> volume;  ///< [m^d]; of a shape their sum is the exact volume of its kept part
  double scale = 1.0;          ///< of a shape: these volumes over those of the lattice's cells
};

/// The points of a grid inside a shape, on the kept side of the symmetry planes. Throws std::invalid_argument, as `who`, where
/// there are none.
BodyParticles fill(const Grid& grid, const Settings& settings, const Shape& shape, const std::string& who);

/// Particles of every body, in the scene's order. Throws std::invalid_argument where a body gets none.
std::vector<BodyParticles> fill_bodies(const Settings& settings);

/// The smoothing length of the scene's lattice [m], and the reach of its kernel [m].
double smoothing_length(const Settings& settings, double spacing);
double kernel_support(KernelName kernel);
/// See kernels.hpp.
double kernel_value(KernelName kernel, double r, double h, int dimension);
double lattice_factor(KernelName kernel, double eta, int dimension);

}  // namespace undex::sph
