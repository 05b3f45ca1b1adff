// The pair scheme of Chen et al. 2019, eqs 5 and 6, in its energy-consistent form.
//   (d rho/dt)_i = rho_i sum_j V_j v_ij . grad W_ij
//   (d v/dt)_i   = - sum_j m_j ((p_i + p_j)/(rho_i rho_j) + Pi_ij) grad W_ij
//   heat_i       = 1/2 sum_j m_j Pi_ij v_ij . grad W_ij
// with grad W_ij = F x_ij, x_ij = x_i - x_j, and Monaghan's viscosity Pi on approach. With V_j = m_j/rho_j in the
// continuity equation, p/rho^2 d rho/dt is exactly the counterpart of the pressure force, pair by pair: kinetic plus
// internal energy is conserved to round-off by the space discretisation, whatever the density ratio (the paper's own
// continuity equation, sum m_j v_ij . grad W, is that only where all densities are equal).
// A wall's dummy particle shows i its own state, mirrored (wall_mirror.hpp).
#pragma once

#include "sph_fluid/fluid_lanes.hpp"
#include "sph_fluid/wall_lanes.hpp"
#include "sph_fluid/wall_mirror.hpp"

namespace undex::sph::UNDEX_LEVEL {

struct Monaghan {
  using Lanes = FluidLanes;
  using Sums = FluidSums;
  static constexpr bool needs_gradients = false;
  double alpha, beta;

  explicit Monaghan(const PairInput& in) : alpha(in.alpha), beta(in.beta) {}

  UNDEX_INLINE static Lanes load(const PackedParticle* first, const PackedGradient*, int count) {
    return load_fluid(first, count);
  }

  /// Pi of eq. 6, and books the closing speed. `sound` and `density` are the SUMS over i and j; vr = v_ij . x_ij < 0 on
  /// approach.
  UNDEX_INLINE Vec viscosity(Vec vr, Vec r2, Vec h, Vec sound, Vec density, Mask near, Vec& closing) const {
    const Vec reach = r2 + 0.01 * (h * h);
    const Vec inverse = reciprocal(reach * density);
    const Vec mu = h * minimum(vr, Vec{}) * (inverse * density);
    closing = maximum(closing, keep(near, -mu));
    return mu * (2.0 * beta * mu - alpha * sound) * (inverse * reach);
  }

  UNDEX_INLINE void pair(const Lanes& i, const PackedParticle& j, const PackedGradient*, Vec dx, Vec dy, Vec dz, Vec r2,
                         Vec h, Vec F, Mask near, Sums& sums) const {
    const Vec vr = (i.vx - j.vx) * dx + (i.vy - j.vy) * dy + (i.vz - j.vz) * dz;
    const Vec Pi = viscosity(vr, r2, h, i.c + j.c, i.rho + j.rho, near, sums.closing);
    const Vec FV = F * j.V;
    const Vec viscous = Pi * j.rho;
    const Vec G = FV * ((i.p + j.p) * i.inverse_rho + viscous);
    sums.ax -= G * dx;
    sums.ay -= G * dy;
    sums.az -= G * dz;
    sums.compression += FV * vr;
    sums.heat += 0.5 * FV * viscous * vr;
  }

  UNDEX_INLINE void wall(const Lanes& i, const PackedWall& w, Vec dx, Vec dy, Vec dz, Vec r2, Vec h, Vec F, Mask near,
                         Sums& sums) const {
    const Mirrored m = mirrored(i.vx - w.vx, i.vy - w.vy, i.vz - w.vz, dx, dy, dz, w.nx, w.ny, w.nz, w.slip);
    const Vec Pi = viscosity(m.approach, r2, h, 2.0 * i.c, 2.0 * i.rho, near, sums.closing);
    const Vec FV = F * w.V;
    const Vec viscous = Pi * i.rho;
    const Vec G = FV * (2.0 * i.p * i.inverse_rho + viscous);
    sums.ax -= G * m.ex;
    sums.ay -= G * m.ey;
    sums.az -= G * m.ez;
    sums.compression += FV * m.approach;
    sums.heat += 0.5 * FV * viscous * m.approach;
  }

  /// The force of fluid particle j on the wall particles in the lanes: minus what wall() gives j, times its mass.
  /// d = x_j - x_wall, as seen from the fluid particle.
  UNDEX_INLINE void force(const WallLanes& w, const PackedParticle& j, Vec dx, Vec dy, Vec dz, Vec r2, Vec F, Mask near,
                          WallSums& sums) const {
    const Mirrored m = mirrored(j.vx - w.vx, j.vy - w.vy, j.vz - w.vz, dx, dy, dz, w.nx, w.ny, w.nz, w.slip);
    Vec unused{};
    const Vec Pi =
        viscosity(m.approach, r2, broadcast(j.h), broadcast(2.0 * j.c), broadcast(2.0 * j.rho), near, unused);
    const Vec G = F * w.V * (2.0 * j.p / j.rho + Pi * j.rho) * (j.rho * j.V);
    sums.fx += G * m.ex;
    sums.fy += G * m.ey;
    sums.fz += G * m.ez;
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
