// Wall particles in SIMD lanes, for the pass that gathers the fluid's force on them.
#pragma once

#include "sph_fluid/pair_data.hpp"
#include "sph_fluid/simd.hpp"

namespace undex::sph::UNDEX_LEVEL {

struct WallLanes {
  Vec x, y, z, vx, vy, vz, nx, ny, nz, V, slip;
};
struct WallSums {
  Vec fx{}, fy{}, fz{};
};

UNDEX_INLINE WallLanes load_walls(const PackedWall* first, int count) {
  WallLanes w;
  for (int l = 0; l < lanes; ++l) {
    const PackedWall& q = first[l < count ? l : 0];
    w.x[l] = l < count ? q.x : 1e30;  // an empty lane is out of everybody's reach
    w.y[l] = q.y;
    w.z[l] = q.z;
    w.vx[l] = q.vx;
    w.vy[l] = q.vy;
    w.vz[l] = q.vz;
    w.nx[l] = q.nx;
    w.ny[l] = q.ny;
    w.nz[l] = q.nz;
    w.V[l] = q.V;
    w.slip[l] = q.slip;
  }
  return w;
}

UNDEX_INLINE void store_walls(const WallSums& sums, std::uint32_t begin, int count, const WallForces& out) {
  for (int l = 0; l < count; ++l) {
    out.fx[begin + l] = sums.fx[l];
    out.fy[begin + l] = sums.fy[l];
    out.fz[begin + l] = sums.fz[l];
  }
}

}  // namespace undex::sph::UNDEX_LEVEL
