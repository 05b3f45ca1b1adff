// A Riemann problem per pair instead of an artificial viscosity. Along the unit vector e from i to j, u = v . e and p are
// carried to the middle from both sides with limited gradients (reconstruction.hpp, van Leer's limiter); an acoustic
// solver with impedances Z = rho c gives
//   p* = (pL + pR)/2 + b ZL ZR (uL - uR)/(ZL + ZR),      b = min(3 max(uL - uR, 0)/c, 1)
//   u* = (ZL uL + ZR uR + (pL - pR)/2)/(ZL + ZR)
// (the switch b is that of Zhang, Hu, Adams 2017, J. Comput. Phys. 335, doi 10.1016/j.jcp.2017.01.027: full dissipation
// at shocks, little in smooth flow), and the rates are
//   (d rho/dt)_i = 2 rho_i sum_j V_j (v_i . e - u*)(-F r)
//   (d v/dt)_i   = -2 sum_j m_j p*/(rho_i rho_j) grad W_ij
//   heat_i       = 2 sum_j m_j (p* - p_i)/(rho_i rho_j) (v_i . e - u*)(-F r)
// The pair force and the pair work have one p* and one u*, so mass, momentum and total energy are conserved to round-off
// by the space discretisation. In a pair with gas (or detonation products) the central parts are plain averages and only the
// dissipative parts are reconstructed: the jump of density at a contact is not a gradient to be followed. p* >= 0.
#pragma once

#include "sph_fluid/fluid_lanes.hpp"
#include "sph_fluid/wall_lanes.hpp"
#include "sph_fluid/wall_mirror.hpp"

namespace undex::sph::UNDEX_LEVEL {

struct Riemann {
  struct Lanes : FluidLanes {
    Vec strain[6], gradient[3];
    Vec impedance;
  };
  using Sums = FluidSums;
  static constexpr bool needs_gradients = true;

  explicit Riemann(const PairInput&) {}

  UNDEX_INLINE static Lanes load(const PackedParticle* first, const PackedGradient* gradients, int count) {
    Lanes i;
    static_cast<FluidLanes&>(i) = load_fluid(first, count);
    for (int l = 0; l < lanes; ++l) {
      const PackedGradient& g = gradients[l < count ? l : 0];
      for (int k = 0; k < 6; ++k) i.strain[k][l] = g.strain[k];
      for (int k = 0; k < 3; ++k) i.gradient[k][l] = g.pressure[k];
    }
    i.impedance = i.rho * i.c;
    return i;
  }

  /// van Leer's harmonic mean of two slopes, zero where they disagree in sign.
  UNDEX_INLINE static Vec limited(Vec a, Vec b) {
    const Vec product = a * b;
    const Mask agree = product > 0.0;
    return keep(agree, 2.0 * product * reciprocal(agree ? a + b : broadcast(1.0)));
  }

  UNDEX_INLINE static Vec switched(Vec closing, Vec sound) { return minimum(3.0 * closing, sound) * reciprocal(sound); }

  UNDEX_INLINE void pair(const Lanes& i, const PackedParticle& j, const PackedGradient* g, Vec dx, Vec dy, Vec dz, Vec r2,
                         Vec, Vec F, Mask near, Sums& sums) const {
    const Vec inverse_r = reciprocal_sqrt(r2 + 1e-30);
    // Velocities relative to v_i . e: the left one is zero, the right one is u.
    const Vec u = ((i.vx - j.vx) * dx + (i.vy - j.vy) * dy + (i.vz - j.vz) * dz) * inverse_r;
    const Vec dp = j.p - i.p;
    const Vec xx = dx * dx, yy = dy * dy, zz = dz * dz, xy = 2.0 * dx * dy, yz = 2.0 * dy * dz, zx = 2.0 * dz * dx;
    const Vec rise_i = (i.strain[0] * xx + i.strain[1] * yy + i.strain[2] * zz + i.strain[3] * xy + i.strain[4] * yz +
                        i.strain[5] * zx) * inverse_r;
    const Vec rise_j = (double(g->strain[0]) * xx + double(g->strain[1]) * yy + double(g->strain[2]) * zz +
                        double(g->strain[3]) * xy + double(g->strain[4]) * yz + double(g->strain[5]) * zx) * inverse_r;
    const Vec climb_i = -(i.gradient[0] * dx + i.gradient[1] * dy + i.gradient[2] * dz);
    const Vec climb_j = -(double(g->pressure[0]) * dx + double(g->pressure[1]) * dy + double(g->pressure[2]) * dz);
    const Vec uL = 0.5 * limited(u, 2.0 * rise_i - u), uR = u - 0.5 * limited(u, 2.0 * rise_j - u);
    const Vec pL = i.p + 0.5 * limited(dp, 2.0 * climb_i - dp), pR = j.p - 0.5 * limited(dp, 2.0 * climb_j - dp);

    const double Zj = j.rho * j.c;
    const Vec Z = i.impedance + Zj;
    const Vec inverse_Z = reciprocal(Z);
    const Vec jump = uL - uR;
    const Vec closing = maximum(jump, Vec{});
    const Vec sound = Z * reciprocal(i.rho + j.rho);
    const Mask gas = (i.gas + j.gas) > 0.5;
    const Vec central_p = gas ? 0.5 * (i.p + j.p) : 0.5 * (pL + pR);
    const Vec central_u = gas ? 0.5 * u : (i.impedance * uL + Zj * uR) * inverse_Z;
    const Vec p_star =
        maximum(central_p + switched(closing, sound) * (i.impedance * Zj * inverse_Z) * jump, Vec{});
    const Vec u_star = central_u + 0.5 * (pL - pR) * inverse_Z;

    const Vec FV = 2.0 * j.V * F;
    const Vec G = FV * p_star * i.inverse_rho;
    const Vec rate = FV * (r2 * inverse_r) * u_star;  // 2 V_j (v_i . e - u*)(-F r), u* relative to v_i . e
    sums.ax -= G * dx;
    sums.ay -= G * dy;
    sums.az -= G * dz;
    sums.compression += rate;
    sums.heat += rate * (p_star - i.p) * i.inverse_rho;
    sums.closing = maximum(sums.closing, keep(near, -u));
  }

  /// p* against the mirrored state: p + b Z (closing speed)/2, and u* the wall's own.
  UNDEX_INLINE static Vec wall_pressure(Vec p, Vec rho, Vec c, Vec approach, Vec r2) {
    const Vec jump = -approach * reciprocal_sqrt(r2 + 1e-30);
    return maximum(p + 0.5 * switched(maximum(jump, Vec{}), c) * rho * c * jump, Vec{});
  }

  UNDEX_INLINE void wall(const Lanes& i, const PackedWall& w, Vec dx, Vec dy, Vec dz, Vec r2, Vec, Vec F, Mask near,
                         Sums& sums) const {
    const Mirrored m = mirrored(i.vx - w.vx, i.vy - w.vy, i.vz - w.vz, dx, dy, dz, w.nx, w.ny, w.nz, w.slip);
    const Vec p_star = wall_pressure(i.p, i.rho, i.c, m.approach, r2);
    const Vec FV = F * w.V;
    const Vec G = 2.0 * FV * p_star * i.inverse_rho;
    const Vec rate = FV * m.approach;
    sums.ax -= G * m.ex;
    sums.ay -= G * m.ey;
    sums.az -= G * m.ez;
    sums.compression += rate;
    sums.heat += rate * (p_star - i.p) * i.inverse_rho;
    sums.closing = maximum(sums.closing, keep(near, -m.approach * reciprocal_sqrt(r2 + 1e-30)));
  }

  /// As Monaghan::force.
  UNDEX_INLINE void force(const WallLanes& w, const PackedParticle& j, Vec dx, Vec dy, Vec dz, Vec r2, Vec F, Mask,
                          WallSums& sums) const {
    const Mirrored m = mirrored(j.vx - w.vx, j.vy - w.vy, j.vz - w.vz, dx, dy, dz, w.nx, w.ny, w.nz, w.slip);
    const Vec p_star = wall_pressure(broadcast(j.p), broadcast(j.rho), broadcast(j.c), m.approach, r2);
    const Vec G = 2.0 * F * w.V * p_star * j.V;
    sums.fx += G * m.ex;
    sums.fy += G * m.ey;
    sums.fz += G * m.ez;
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
