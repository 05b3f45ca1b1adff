// What a pass over pairs is to the loop (cluster_work.hpp): the contract of a pair scheme. Nothing in a pass knows of vectors'
// lengths, images, clusters or threads. Given for one number type T, V being Vec<T>:
//   State      what is read of a particle: read(k -> number k of its FluidRow); where it has a `Second` other than NoRow also
//              read_second(k -> number k of that row)
//   Wall       the same of a wall's dummy particle, from its WallRow
//   Sums       what is added up for a particle: `count` numbers, number k by sum or (is_maximum(k)) by maximum; each(visit)
//   rings      where it is there and true: particles are rings, the state has read_ring(k -> number k of its RingRow), and pairs
//              have W
//   partners   whom particles are paired with
//   symmetric  true: a pair is met once and adds to both sides. False: every particle meets all its neighbours, adds to its own
//              sums alone, and `store` says what becomes of them
//   pair       two particles; wall: a particle and a wall's
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// Reads any number of any row.
template <class V>
struct AnyEntry {
  V operator()(int) const { return V{}; }
};

/// Does a pass work on rings?
template <class P>
inline constexpr bool over_rings = false;
template <class P>
requires(P::rings) inline constexpr bool over_rings<P> = true;

template <class P>
concept PairPass = requires(const P pass, typename P::State i, typename P::Wall wall, typename P::Sums sums,
                            WallSums<typename P::V> wall_sums, const Pair<typename P::V> pair, const PairInput in,
                            AnyEntry<typename P::V> entry, const Vec<double>* totals) {
  P(in);
  i.read(entry);
  wall.read(entry);
  requires same_type<typename P::State::Second, NoRow> || requires { i.read_second(entry); };
  Partners(P::partners);
  int(P::Sums::count);
  bool(P::Sums::is_maximum(0));
  pass.pair(i, i, pair, sums, sums);
  pass.wall(i, wall, pair, sums, wall_sums);
  requires P::symmetric || requires { pass.store(totals, true, in, 0u, 1); };
};

}  // namespace undex::sph::UNDEX_LEVEL
