// Gas that expands keeps its neighbours: a particle of gas or products that has grown to twice its volume on the lattice
// splits in two along the direction in which its neighbours are farthest. Both halves have its density, velocity, specific
// energy and rates, and stand symmetrically about its place: mass, momentum, angular momentum and every energy of the body
// stay what they are.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_fluid/water/particle_set.hpp"

namespace undex::sph {

/// Volume over that of the lattice's cell (of a ring: area) at which a particle splits. Its halves begin where it began, so the
/// gas is never coarser than its lattice by more than this, and the water meets it within its own reach.
inline constexpr double full_growth = 2.0;

/// Growth that h follows, of a particle of this growth. From the mean of the volumes between which halves live, 1 and 2, to where
/// it splits h stays, and halves keep it until they are compressed: splitting changes no neighbour's sums by a jump of h.
inline double even_growth(double growth, bool half) {
  const double even = std::sqrt(full_growth);
  return std::max(std::min(half ? full_growth * growth : growth, even), growth * even / full_growth);
}

/// A particle, and how its halves differ from it, one by plus, one by minus that.
struct Split {
  std::uint32_t particle;
  Vec3 offset;                  ///< of their places [m]
  Vec3 parting = Vec3::Zero();  ///< of their velocities, along the offset: no angular momentum [m/s]
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
