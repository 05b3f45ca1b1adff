// Particles that take a step together, by bodies, and what the passes over them work with: all, or (local_steps.hpp) some.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sph_fluid/pairs/blocks.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/walls/particles.hpp"
#include "sph_fluid/walls/wall_images.hpp"

namespace undex::sph {

/// A body's particles: one material, one smoothing-length policy, one range in memory.
struct Group {
  const Body* body = nullptr;
  std::uint32_t begin = 0, end = 0;
  std::uint32_t first_id = 0;
  std::uint32_t laid = 0;        // particles at the start
  bool fast = false;             // does it take substeps (local_steps.hpp)?
  double spacing = 0, h0 = 0;    // [m]
  double h_max = 0;              // [m], the largest at present
  std::uint32_t material = 0;    // one number for all groups of one material
  double rest_density = 0;       // [kg/m^3], of what no signal has reached
  std::vector<double> lighting;  // burning charges only, by id - first_id [s]
  CellList cells;
};

/// Share of particle k = id - first_id of a burning charge over which the front has gone by `time` [s].
double share_burnt(const Group& group, std::uint32_t k, double time);

struct ParticleSet {
  Particles particles;
  std::vector<Group> groups;
  PairChoice choice = PairChoice::all;  // whose rates Particles::rate holds
  bool meets_walls = true;              // can a particle of this set meet a wall's?
  double last_step = 0;                 // [s]; 0: none that the predictor could go on

  // Of the last evaluation.
  std::vector<GroupView> views;
  WallImages images;  // of the particles, in slip walls
  BlockOrder blocks;
  std::vector<long long> interactions;  // per block
  WallLoads wall_force;                 // [N]
  WallShare wall_power;                 // work on moving walls [W]
  double reach = 0;                     // largest distance of a pair [m]
  bool healthy = true;                  // all finite, and slower than `fastest`

  /// Is it one with particles of this group that move by the rates in hand?
  bool moves(const Group& group) const { return choice == PairChoice::all || group.fast == (choice == PairChoice::fast); }
  std::size_t memory_bytes() const;
  /// What the last evaluation has left for the next step beside the particles' arrays.
  void visit_loads(StateVisitor& state);
  /// That, the particles, and who takes which steps.
  void visit_state(StateVisitor& state);
};

/// Speed at which a run has lost its physics: a hundred times what any explosive does [m/s].
inline constexpr double fastest = 1e7;

/// How far a fluid has come.
struct Clock {
  double time = 0;  ///< [s]
  long steps = 0;
  long long updates = 0;  ///< of particles: their number, step by step
};

inline Vec3 place_of(const Particles& p, std::size_t i) { return {p.x[i], p.y[i], p.z[i]}; }
const Body& body_of(const ParticleSet& set, std::uint32_t i);

/// Why the run cannot go on: which particle, where, and a remedy.
std::string what_is_wrong(const ParticleSet& set, const Settings& settings, const Clock& clock);

}  // namespace undex::sph
