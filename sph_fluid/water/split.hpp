// Gas that expands keeps its neighbours: a particle of gas or products that has grown to twice its width on the lattice, and has
// that space, splits in two along the direction in which its neighbours are farthest. Both halves have its density and rates, and
// stand symmetrically about its place; they part with the flow about them, and their heat pays for it: mass, momentum, angular
// momentum and the energy of the body stay what they are.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_fluid/water/particle_set.hpp"

namespace undex::sph {

/// Volume over that of the lattice's cell (of a ring: area) at which a particle splits: it is twice as wide. Gas is never coarser
/// than that, and the water meets it within its own reach.
inline double full_growth(int dimension) { return std::exp2(dimension); }

/// Growth that h follows, of a particle of this growth. From the mean of the volumes between which halves live, half the full and
/// the full one, to where it splits h stays, and halves keep it until they are compressed: splitting changes no neighbour's sums
/// by a jump of h.
inline double even_growth(double growth, bool half, int dimension) {
  const double even = full_growth(dimension) / std::sqrt(2.0);
  return std::max(std::min(half ? 2.0 * growth : growth, even), growth / std::sqrt(2.0));
}

/// A particle, and how its halves differ from it, one by plus, one by minus that; of rings, whose halves have masses as their
/// radii and so one area, each by as much as leaves the mean of velocity and of z.
struct Split {
  std::uint32_t particle;
  Vec3 offset;                  ///< of their places [m]
  Vec3 parting = Vec3::Zero();  ///< of their velocities, along the offset: no angular momentum [m/s]
  double share = 0.5;           ///< of the mass, of the first
};

/// Has a particle of the set grown so far by `time` [s]?
bool any_has_grown(const ParticleSet& set, const Settings& settings, double time);
/// All that have, in the order of memory, with their neighbours seen: `in` has the particles and images of the evaluation that is
/// under way.
std::vector<Split> find_splits(const ParticleSet& set, const Settings& settings, double time, const PairInput& in);
/// They become two. One half keeps the number (id), the other has a new one after all others'. The energy of their parting comes
/// from their heat; returns what bodies without an energy field owe [J].
double split(ParticleSet& set, const std::vector<Split>& splits);

}  // namespace undex::sph
