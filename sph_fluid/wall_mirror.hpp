// What a wall's dummy particle does to a pair: the mirrored velocity difference, and the direction of the force.
#pragma once

#include "sph_fluid/simd.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// How much of the motion along all axes a wall particle takes part in, beside `slip` times that along its normal.
UNDEX_INLINE double stick_of(double slip) { return slip > 0.0 ? 0.0 : 1.0; }
UNDEX_INLINE Vec stick_of(Vec slip) { return slip > 0.0 ? Vec{} : broadcast(1.0); }

/// v_ij . x_ij with the fluid particle's velocity mirrored about the wall's (wholly for no slip, its normal part for free
/// slip), and the part of x_ij along which the pair force acts (all of it, or the normal part only: then the work done on
/// the wall is exactly the energy that the fluid gives). Behind an edge of two free-slip faces both see what is across the
/// edge, behind a corner of three all of it.
struct Mirrored {
  Vec approach;    ///< v_ij . x_ij [m^2/s]
  Vec ex, ey, ez;  ///< [m]
};

/// u: velocity of the fluid particle relative to the wall's; d: its position relative to the wall particle; n: normal.
template <class Scalar>
UNDEX_INLINE Mirrored mirrored(Vec ux, Vec uy, Vec uz, Vec dx, Vec dy, Vec dz, Scalar nx, Scalar ny, Scalar nz, Scalar slip) {
  const Scalar stick = stick_of(slip);
  const Vec un = slip * (ux * nx + uy * ny + uz * nz);
  const Vec xn = slip * (dx * nx + dy * ny + dz * nz);
  Mirrored m;
  m.approach = 2.0 * ((un * nx + stick * ux) * dx + (un * ny + stick * uy) * dy + (un * nz + stick * uz) * dz);
  m.ex = xn * nx + stick * dx;
  m.ey = xn * ny + stick * dy;
  m.ez = xn * nz + stick * dz;
  return m;
}

}  // namespace undex::sph::UNDEX_LEVEL
