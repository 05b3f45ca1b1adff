// Fluid particles in SIMD lanes, and the rates that every scheme sums.
#pragma once

#include "sph_fluid/pair_data.hpp"
#include "sph_fluid/simd.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// State of the particles in the lanes.
struct FluidLanes {
  Vec x, y, z, vx, vy, vz, p, rho, inverse_rho, c, h, gas;
};

UNDEX_INLINE FluidLanes load_fluid(const PackedParticle* first, int count) {
  FluidLanes i;
  for (int l = 0; l < lanes; ++l) {
    const PackedParticle& q = first[l < count ? l : 0];
    i.x[l] = l < count ? q.x : 1e30;  // an empty lane is out of everybody's reach
    i.y[l] = q.y;
    i.z[l] = q.z;
    i.vx[l] = q.vx;
    i.vy[l] = q.vy;
    i.vz[l] = q.vz;
    i.p[l] = q.p;
    i.rho[l] = q.rho;
    i.c[l] = q.c;
    i.h[l] = q.h;
    i.gas[l] = q.gas;
  }
  i.inverse_rho = 1.0 / i.rho;
  return i;
}

struct FluidSums {
  Vec ax{}, ay{}, az{}, compression{}, heat{}, closing{};
};

UNDEX_INLINE void store_fluid(const FluidSums& sums, std::uint32_t begin, int count, const FluidRates& out) {
  for (int l = 0; l < count; ++l) {
    out.ax[begin + l] = sums.ax[l];
    out.ay[begin + l] = sums.ay[l];
    out.az[begin + l] = sums.az[l];
    out.compression[begin + l] = sums.compression[l];
    out.heat[begin + l] = sums.heat[l];
    out.closing[begin + l] = sums.closing[l];
  }
}

}  // namespace undex::sph::UNDEX_LEVEL
