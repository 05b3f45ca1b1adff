// The pair scheme of Chen et al. 2019, eqs 5 and 6, in its energy-consistent form.
//   (d rho/dt)_i = rho_i sum_j V_j v_ij . grad W_ij
//   (d v/dt)_i   = - sum_j m_j ((p_i + p_j)/(rho_i rho_j) + Pi_ij) grad W_ij
//   heat_i       = 1/2 sum_j m_j Pi_ij v_ij . grad W_ij
// with grad W_ij = F x_ij, x_ij = x_i - x_j, and Monaghan's viscosity Pi on approach. With V_j = m_j/rho_j in the
// continuity equation, p/rho^2 d rho/dt is exactly the counterpart of the pressure force, pair by pair: kinetic plus
// internal energy is conserved to round-off by the space discretisation, whatever the density ratio (the paper's own
// continuity equation, sum m_j v_ij . grad W, is that only where all densities are equal).
//
// Walls: a dummy particle shows i its own state, with the velocity mirrored about the wall's: wholly (no slip) or its
// normal part only (free slip). Free slip also keeps only the normal part of the pair force, which makes the work done on
// the wall exactly the energy that the fluid gives.
#pragma once

#include "sph_fluid/pair_data.hpp"
#include "sph_fluid/simd.hpp"

namespace undex::sph::UNDEX_LEVEL {

struct Monaghan {
  /// State of the particles in the lanes.
  struct Lanes {
    Vec x, y, z, vx, vy, vz, p, rho, inverse_rho, c, h;
  };
  struct Sums {
    Vec ax{}, ay{}, az{}, compression{}, heat{}, closing{};
  };
  double alpha, beta;

  UNDEX_INLINE static Lanes load(const PackedParticle* first, int count) {
    Lanes i;
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
    }
    i.inverse_rho = 1.0 / i.rho;
    return i;
  }

  /// Viscous pressure times 1/(rho_i rho_j): Pi of eq. 6, and books the closing speed. `sound` and `density` are the
  /// SUMS over i and j; vr = v_ij . x_ij < 0 on approach.
  UNDEX_INLINE Vec viscosity(Vec vr, Vec r2, Vec h, Vec sound, Vec density, Mask near, Sums& sums) const {
    const Vec reach = r2 + 0.01 * (h * h);
    const Vec inverse = reciprocal(reach * density);
    const Vec mu = h * minimum(vr, Vec{}) * (inverse * density);
    sums.closing = maximum(sums.closing, keep(near, -mu));
    return mu * (2.0 * beta * mu - alpha * sound) * (inverse * reach);
  }

  UNDEX_INLINE void pair(const Lanes& i, const PackedParticle& j, Vec dx, Vec dy, Vec dz, Vec r2, Vec h, Vec F,
                         Mask near, Sums& sums) const {
    const Vec vr = (i.vx - j.vx) * dx + (i.vy - j.vy) * dy + (i.vz - j.vz) * dz;
    const Vec Pi = viscosity(vr, r2, h, i.c + j.c, i.rho + j.rho, near, sums);
    const Vec FV = F * j.V;
    const Vec viscous = Pi * j.rho;
    const Vec G = FV * ((i.p + j.p) * i.inverse_rho + viscous);
    sums.ax -= G * dx;
    sums.ay -= G * dy;
    sums.az -= G * dz;
    sums.compression += FV * vr;
    sums.heat += FV * viscous * vr;
  }

  UNDEX_INLINE void wall(const Lanes& i, const PackedWall& w, Vec dx, Vec dy, Vec dz, Vec r2, Vec h, Vec F, Mask near,
                         Sums& sums) const {
    const double stick = 1.0 - w.slip;
    const Vec ux = i.vx - w.vx, uy = i.vy - w.vy, uz = i.vz - w.vz;
    const Vec un = w.slip * (ux * w.nx + uy * w.ny + uz * w.nz);
    const Vec xn = w.slip * (dx * w.nx + dy * w.ny + dz * w.nz);
    const Vec ex = xn * w.nx + stick * dx, ey = xn * w.ny + stick * dy, ez = xn * w.nz + stick * dz;
    const Vec vr = 2.0 * ((un * w.nx + stick * ux) * dx + (un * w.ny + stick * uy) * dy + (un * w.nz + stick * uz) * dz);
    const Vec Pi = viscosity(vr, r2, h, 2.0 * i.c, 2.0 * i.rho, near, sums);
    const Vec FV = F * w.V;
    const Vec viscous = Pi * i.rho;
    const Vec G = FV * (2.0 * i.p * i.inverse_rho + viscous);
    sums.ax -= G * ex;
    sums.ay -= G * ey;
    sums.az -= G * ez;
    sums.compression += FV * vr;
    sums.heat += FV * viscous * vr;
  }

  UNDEX_INLINE static void store(const Sums& sums, std::uint32_t begin, int count, const FluidRates& out) {
    for (int l = 0; l < count; ++l) {
      out.ax[begin + l] = sums.ax[l];
      out.ay[begin + l] = sums.ay[l];
      out.az[begin + l] = sums.az[l];
      out.compression[begin + l] = sums.compression[l];
      out.heat[begin + l] = 0.5 * sums.heat[l];
      out.closing[begin + l] = sums.closing[l];
    }
  }

  /// The force that fluid particle j puts on the wall particles in the lanes: minus what wall() gives j, by its mass.
  struct WallLanes {
    Vec x, y, z, vx, vy, vz, nx, ny, nz, V, slip;
  };
  struct WallSums {
    Vec fx{}, fy{}, fz{};
  };

  UNDEX_INLINE static WallLanes load(const PackedWall* first, int count) {
    WallLanes w;
    for (int l = 0; l < lanes; ++l) {
      const PackedWall& q = first[l < count ? l : 0];
      w.x[l] = l < count ? q.x : 1e30;
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

  /// dx = x_j - x_wall here, as seen from the fluid particle.
  UNDEX_INLINE void force(const WallLanes& w, const PackedParticle& j, Vec dx, Vec dy, Vec dz, Vec r2, Vec F,
                          Mask near, WallSums& sums) const {
    const Vec stick = 1.0 - w.slip;
    const Vec ux = j.vx - w.vx, uy = j.vy - w.vy, uz = j.vz - w.vz;
    const Vec un = w.slip * (ux * w.nx + uy * w.ny + uz * w.nz);
    const Vec xn = w.slip * (dx * w.nx + dy * w.ny + dz * w.nz);
    const Vec ex = xn * w.nx + stick * dx, ey = xn * w.ny + stick * dy, ez = xn * w.nz + stick * dz;
    const Vec vr = 2.0 * ((un * w.nx + stick * ux) * dx + (un * w.ny + stick * uy) * dy + (un * w.nz + stick * uz) * dz);
    Sums unused;
    const Vec Pi = viscosity(vr, r2, broadcast(j.h), broadcast(2.0 * j.c), broadcast(2.0 * j.rho), near, unused);
    const double mass = j.rho * j.V;
    const Vec G = F * w.V * (2.0 * j.p / j.rho + Pi * j.rho) * mass;
    sums.fx += G * ex;
    sums.fy += G * ey;
    sums.fz += G * ez;
  }

  UNDEX_INLINE static void store(const WallSums& sums, std::uint32_t begin, int count, const WallForces& out) {
    for (int l = 0; l < count; ++l) {
      out.fx[begin + l] = sums.fx[l];
      out.fy[begin + l] = sums.fy[l];
      out.fz[begin + l] = sums.fz[l];
    }
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
