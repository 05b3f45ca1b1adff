// Gradients of velocity and pressure for schemes that reconstruct: first-order exact for any arrangement of neighbours,
// by the inverse of the moment matrix M = - sum_j V_j x_ij x_ij^T F.
#pragma once

#include "sph_fluid/fluid_lanes.hpp"
#include "sph_fluid/wall_mirror.hpp"

namespace undex::sph::UNDEX_LEVEL {

struct Reconstruction {
  using Lanes = FluidLanes;
  struct Sums {
    Vec xx{}, yy{}, zz{}, xy{}, yz{}, zx{};  // moment matrix
    Vec v[3][3] = {};                        // sum V_j (v_j - v_i)_a (x_ij)_b F
    Vec p[3] = {};                           // sum V_j (p_j - p_i) (x_ij)_b F
  };
  int dimension;

  UNDEX_INLINE static Lanes load(const PackedParticle* first, const PackedGradient*, int count) {
    return load_fluid(first, count);
  }

  UNDEX_INLINE static void add(Vec ux, Vec uy, Vec uz, Vec dp, Vec dx, Vec dy, Vec dz, Vec FV, Sums& s) {
    const Vec wx = FV * dx, wy = FV * dy, wz = FV * dz;
    s.xx -= dx * wx;
    s.yy -= dy * wy;
    s.zz -= dz * wz;
    s.xy -= dx * wy;
    s.yz -= dy * wz;
    s.zx -= dz * wx;
    s.v[0][0] += ux * wx;
    s.v[0][1] += ux * wy;
    s.v[0][2] += ux * wz;
    s.v[1][0] += uy * wx;
    s.v[1][1] += uy * wy;
    s.v[1][2] += uy * wz;
    s.v[2][0] += uz * wx;
    s.v[2][1] += uz * wy;
    s.v[2][2] += uz * wz;
    s.p[0] += dp * wx;
    s.p[1] += dp * wy;
    s.p[2] += dp * wz;
  }

  UNDEX_INLINE void pair(const Lanes& i, const PackedParticle& j, const PackedGradient*, Vec dx, Vec dy, Vec dz, Vec, Vec,
                         Vec F, Mask, Sums& sums) const {
    add(j.vx - i.vx, j.vy - i.vy, j.vz - i.vz, j.p - i.p, dx, dy, dz, F * j.V, sums);
  }

  /// The mirrored state: the same pressure, velocity mirrored about the wall's.
  UNDEX_INLINE void wall(const Lanes& i, const PackedWall& w, Vec dx, Vec dy, Vec dz, Vec, Vec, Vec F, Mask,
                         Sums& sums) const {
    const double stick = stick_of(w.slip);
    const Vec ux = i.vx - w.vx, uy = i.vy - w.vy, uz = i.vz - w.vz;
    const Vec un = w.slip * (ux * w.nx + uy * w.ny + uz * w.nz);
    add(-2.0 * (un * w.nx + stick * ux), -2.0 * (un * w.ny + stick * uy), -2.0 * (un * w.nz + stick * uz), Vec{}, dx, dy,
        dz, F * w.V, sums);
  }

  UNDEX_INLINE void store(const Sums& s, PackedGradient* out, int count) const {
    Vec xx = s.xx, yy = s.yy, zz = s.zz;
    if (dimension < 2) yy = broadcast(1.0);
    if (dimension < 3) zz = broadcast(1.0);
    // Adjugate of the symmetric matrix; where neighbours are too few or in a plane, the uncorrected sum stands.
    const Vec a = yy * zz - s.yz * s.yz, b = s.zx * s.yz - s.xy * zz, c = s.xy * s.yz - s.zx * yy;
    const Vec d = xx * zz - s.zx * s.zx, e = s.xy * s.zx - xx * s.yz, f = xx * yy - s.xy * s.xy;
    const Vec determinant = xx * a + s.xy * b + s.zx * c;
    const Mask good = determinant > 0.05;
    const Vec one = broadcast(1.0);
    const Vec inverse = 1.0 / (good ? determinant : one);
    const Vec B[3][3] = {{good ? a * inverse : one, keep(good, b * inverse), keep(good, c * inverse)},
                         {keep(good, b * inverse), good ? d * inverse : one, keep(good, e * inverse)},
                         {keep(good, c * inverse), keep(good, e * inverse), good ? f * inverse : one}};
    Vec g[3][3], p[3];
    for (int r = 0; r < 3; ++r) {
      for (int q = 0; q < 3; ++q) g[r][q] = s.v[r][0] * B[0][q] + s.v[r][1] * B[1][q] + s.v[r][2] * B[2][q];
      p[r] = s.p[0] * B[0][r] + s.p[1] * B[1][r] + s.p[2] * B[2][r];
    }
    for (int l = 0; l < count; ++l) {
      PackedGradient& q = out[l];
      for (int r = 0; r < 3; ++r) {
        q.strain[r] = float(g[r][r][l]);
        q.strain[3 + r] = float(0.5 * (g[r][(r + 1) % 3][l] + g[(r + 1) % 3][r][l]));
        q.pressure[r] = float(p[r][l]);
      }
    }
  }
};

}  // namespace undex::sph::UNDEX_LEVEL
