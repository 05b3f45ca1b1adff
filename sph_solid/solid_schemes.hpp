// Passes over pairs of solid particles in the present configuration.
//   VelocityGradient  L_i = (sum_j V_j (v_j - v_i) grad W_ij^T) B_i,  B_i = (sum_j V_j (x_j - x_i) grad W_ij^T)^-1
//   SolidForces       f_i = sum_j V_i V_j (sigma_i B_i + sigma_j B_j) grad W_ij, the exact derivative of the power of the
//                     stresses with L (Bonet and Lok 1999, doi 10.1016/S0045-7825(99)00051-1), with a viscosity and an
//                     artificial stress, both along the pair: momentum and angular momentum are conserved
//   ContactOverlap    how far other bodies reach into a particle's surroundings: C_i = sum_j V_j W_ij
//   ContactForces     f_i = -sum_j V_i V_j (q_i + q_j) grad W_ij and a damping, q_i = K (C_i - C_ref) >= 0: the bodies touch
//                     through a layer as stiff as they are, and a spacing thick, that pushes and never pulls. The forces are
//                     the exact derivative of its energy, sum V q^2/(2 K). C_ref is the least overlap so far
// The viscosity is Monaghan's, but on the jump that is left of v_ij . e when the velocity gradients of both sides have
// carried it to the middle (as riemann.hpp does), approaching or not, and with the speed of shear waves: none in
// smooth motion, all of it where neighbours move against each other unseen by any gradient. (Shocks have their bulk viscosity.)
// The artificial stress (Gray, Monaghan, Swift 2001, doi 10.1016/S0045-7825(01)00254-7) acts here along the pair, on the
// tension e . sigma e, with (dx/r)^4 - 1 >= 0 in place of (W(r)/W(dx))^4.
#pragma once

#include "sph_fluid/pairs/fluid_state.hpp"

namespace undex::solid::UNDEX_LEVEL {

using namespace sph;
using namespace sph::UNDEX_LEVEL;

/// Solids meet no rigid wall's particles.
template <class V>
struct NoWall {
  template <class Read>
  UNDEX_INLINE void read(Read) {}
};

template <class T>
struct VelocityGradient {
  using V = Vec<T>;
  using State = FluidState<V>;
  using Wall = NoWall<V>;
  struct Sums {
    V m[6] = {};  // xx, yy, zz, xy, yz, zx of sum V_j d d^T F, negative
    V v[9] = {};  // sum V_j (v_j - v_i)_a (d)_b F at 3a + b
    static constexpr int count = 15;
    static constexpr bool is_maximum(int) { return false; }

    template <class Visit>
    UNDEX_INLINE void each(Visit visit) {
      for (int k = 0; k < 6; ++k) visit(m[k], k);
      for (int k = 0; k < 9; ++k) visit(v[k], 6 + k);
    }
  };
  static constexpr bool symmetric = false;
  static constexpr Partners partners = Partners::own_body;
  int dimension;
  double least = 0.015;  ///< det B^-1, below which B is not trusted; a corner of a lattice in space has 0.02

  explicit VelocityGradient(const PairInput& in) : dimension(in.dimension) {}

  UNDEX_INLINE void pair(const State& i, const State& j, const Pair<V>& pair, Sums& s, Sums&) const {
    const V FV = pair.F * j.volume;
    const V wx = FV * pair.dx, wy = FV * pair.dy, wz = FV * pair.dz;
    s.m[0] -= pair.dx * wx;
    s.m[1] -= pair.dy * wy;
    s.m[2] -= pair.dz * wz;
    s.m[3] -= pair.dx * wy;
    s.m[4] -= pair.dy * wz;
    s.m[5] -= pair.dz * wx;
    const V ux = j.vx - i.vx, uy = j.vy - i.vy, uz = j.vz - i.vz;
    s.v[0] += ux * wx;
    s.v[1] += ux * wy;
    s.v[2] += ux * wz;
    s.v[3] += uy * wx;
    s.v[4] += uy * wy;
    s.v[5] += uy * wz;
    s.v[6] += uz * wx;
    s.v[7] += uz * wy;
    s.v[8] += uz * wz;
  }
  UNDEX_INLINE void wall(const State&, const Wall&, const Pair<V>&, Sums&, WallSums<V>&) const {}

  /// Where neighbours are fewer than a lattice's corner has, the correction fades out, before the inverse of next to nothing can
  /// do harm.
  UNDEX_INLINE double trust_in(double determinant) const {
    const double part = determinant / least;
    return part < 1.0 ? part > 0.0 ? part * part : 0.0 : 1.0;
  }
  /// Fragments of too few particles have no inverse: they get the uncorrected sums. (Written out, not by adjugate() of
  /// moment_inverse.hpp: the compiler would fuse other products, and results differ by round-off.)
  void store(const Vec<double>* s, bool, const PairInput& in, std::uint32_t first, int count) const {
    DeformationRow* out = in.deformation + first;
    for (int l = 0; l < count; ++l) {
      const double xx = s[0][l], yy = dimension < 2 ? 1.0 : s[1][l], zz = dimension < 3 ? 1.0 : s[2][l], xy = s[3][l],
                   yz = s[4][l], zx = s[5][l];
      const double a = yy * zz - yz * yz, b = zx * yz - xy * zz, c = xy * yz - zx * yy;
      const double d = xx * zz - zx * zx, e = xy * zx - xx * yz, f = xx * yy - xy * xy;
      const double determinant = xx * a + xy * b + zx * c;
      const double trust = trust_in(determinant);
      const double inverse = determinant > 0.0 ? trust / determinant : 0.0, rest = 1.0 - trust;
      double* B = out[l].correction;
      B[0] = a * inverse + rest, B[1] = d * inverse + rest, B[2] = f * inverse + rest;
      B[3] = b * inverse, B[4] = e * inverse, B[5] = c * inverse;
      for (int r = 0; r < 3; ++r) {
        const double gx = s[6 + 3 * r][l], gy = s[7 + 3 * r][l], gz = s[8 + 3 * r][l];
        out[l].gradient[3 * r] = gx * B[0] + gy * B[3] + gz * B[5];
        out[l].gradient[3 * r + 1] = gx * B[3] + gy * B[1] + gz * B[4];
        out[l].gradient[3 * r + 2] = gx * B[5] + gy * B[4] + gz * B[2];
      }
    }
  }
};

/// A particle with its stress; `read_second` gives entry k of SolidRow.
template <class V>
struct SolidState : FluidState<V> {
  V corrected[9], stress[6], strain[6], shear_sound;
  using Second = SolidRow;

  template <class Read>
  UNDEX_INLINE void read_second(Read entry) {
    for (int k = 0; k < 9; ++k) corrected[k] = entry(k);
    for (int k = 0; k < 6; ++k) stress[k] = entry(9 + k);
    for (int k = 0; k < 6; ++k) strain[k] = entry(15 + k);
    shear_sound = entry(21);
  }
};

/// d . t d
template <class V>
UNDEX_INLINE V along(const V (&t)[6], const Pair<V>& pair) {
  const V x = pair.dx, y = pair.dy, z = pair.dz;
  return t[0] * x * x + t[1] * y * y + t[2] * z * z + 2 * (t[3] * y * z + t[4] * z * x + t[5] * x * y);
}

template <class T>
struct SolidForces {
  using V = Vec<T>;
  using State = SolidState<V>;
  using Wall = NoWall<V>;
  using Sums = FluidSums<V>;
  static constexpr bool symmetric = true;
  static constexpr Partners partners = Partners::own_body;
  T alpha, beta, repulsion, spacing2;

  explicit SolidForces(const PairInput& in)
      : alpha(T(in.alpha)), beta(T(in.beta)), repulsion(T(in.artificial_stress)), spacing2(T(in.spacing * in.spacing)) {}

  /// van Leer's mean of two slopes, zero where they disagree in sign, never beyond the first.
  UNDEX_INLINE static V limited(V a, V b) {
    const V product = a * b;
    const Mask<T> agree = product > 0;
    const V share = keep(agree, 2 * b * reciprocal(agree ? a + b : broadcast(T(1))));
    return a * minimum(share, broadcast(T(1)));
  }

  UNDEX_INLINE void pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums& sj) const {
    push(i, j, pair, broadcast(spacing2), maximum(along(i.stress, pair), V{}) + maximum(along(j.stress, pair), V{}), si, sj);
  }
  /// `near2`: the square of the distance below which a tension repels [m^2]; `pulled`: both tensions times r^2 [N].
  UNDEX_INLINE void push(const State& i, const State& j, const Pair<V>& pair, V near2, V pulled, Sums& si, Sums& sj) const {
    const V x = pair.dx, y = pair.dy, z = pair.dz, F = pair.F;
    const V *a = i.corrected, *b = j.corrected;
    const V tx = (a[0] + b[0]) * x + (a[1] + b[1]) * y + (a[2] + b[2]) * z;
    const V ty = (a[3] + b[3]) * x + (a[4] + b[4]) * y + (a[5] + b[5]) * z;
    const V tz = (a[6] + b[6]) * x + (a[7] + b[7]) * y + (a[8] + b[8]) * z;
    si.fx += (F * j.volume) * tx;
    si.fy += (F * j.volume) * ty;
    si.fz += (F * j.volume) * tz;
    sj.fx -= (F * i.volume) * tx;
    sj.fy -= (F * i.volume) * ty;
    sj.fz -= (F * i.volume) * tz;

    const V vr = (i.vx - j.vx) * x + (i.vy - j.vy) * y + (i.vz - j.vz) * z;
    const V inverse_r2 = reciprocal(pair.r2 + T(1e-30));
    const V left = limited(vr, 2 * along(i.strain, pair) - vr), right = limited(vr, 2 * along(j.strain, pair) - vr);
    const V jump = vr - T(0.5) * (left + right);
    const V mu = pair.h * jump * reciprocal(pair.r2 + T(0.01) * (pair.h * pair.h));
    const V density = i.rho + j.rho;
    const V viscous =
        i.rho * j.rho * mu * (2 * beta * minimum(mu, V{}) - alpha * (i.shear_sound + j.shear_sound)) * reciprocal(density);
    // A share of the tension along the pair, for particles nearer than a spacing alone: undisturbed elasticity stays as it is.
    const V tension = pulled * inverse_r2;
    const V nearness = minimum(near2 * inverse_r2, broadcast(T(4)));
    const V repulsive = keep(pair.in_reach, repulsion * tension * maximum(nearness * nearness - 1, V{}));
    const V central = F * (viscous + repulsive);
    add_force(central, pair, i.volume, j.volume, si, sj);
    const V power = T(0.5) * central * vr;
    si.heat += j.volume * power;
    sj.heat += i.volume * power;
    const V closing = keep(pair.in_reach, -mu);
    si.closing = maximum(si.closing, closing);
    sj.closing = maximum(sj.closing, closing);
  }
  UNDEX_INLINE void wall(const State&, const Wall&, const Pair<V>&, Sums&, WallSums<V>&) const {}
};

/// `compression` is the overlap C.
template <class T>
struct ContactOverlap {
  using V = Vec<T>;
  using State = FluidState<V>;
  using Wall = NoWall<V>;
  using Sums = FluidSums<V>;
  static constexpr bool symmetric = true;
  static constexpr Partners partners = Partners::other_bodies;

  explicit ContactOverlap(const PairInput&) {}

  UNDEX_INLINE void pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums& sj) const {
    // Wendland's W from his F: both are powers of s = 1 - r/(2h).
    const V r2 = pair.r2 + T(1e-30), q = r2 * reciprocal_sqrt(r2) * reciprocal(pair.h);
    const V W = T(-0.2) * pair.F * (pair.h * pair.h) * (T(1) - T(0.5) * q) * (2 * q + T(1));
    si.compression += j.volume * W;
    sj.compression += i.volume * W;
  }
  UNDEX_INLINE void wall(const State&, const Wall&, const Pair<V>&, Sums&, WallSums<V>&) const {}
};

/// FluidRow's pressure is the contact pressure q.
template <class T>
struct ContactForces {
  using V = Vec<T>;
  using State = FluidState<V>;
  using Wall = NoWall<V>;
  using Sums = FluidSums<V>;
  static constexpr bool symmetric = true;
  static constexpr Partners partners = Partners::other_bodies;
  T damping;

  explicit ContactForces(const PairInput& in) : damping(T(in.contact_damping)) {}

  UNDEX_INLINE void pair(const State& i, const State& j, const Pair<V>& pair, Sums& si, Sums& sj) const {
    const V vr = (i.vx - j.vx) * pair.dx + (i.vy - j.vy) * pair.dy + (i.vz - j.vz) * pair.dz;
    const V closing = -vr * reciprocal_sqrt(pair.r2 + T(1e-30));
    const V Zi = i.rho * i.c, Zj = j.rho * j.c;
    // Never more than the springs hold back: the layer does not pull.
    const V damped = maximum(damping * (Zi * Zj * reciprocal(Zi + Zj)) * closing, -(i.p + j.p));
    add_force(pair.F * (i.p + j.p + damped), pair, i.volume, j.volume, si, sj);
    const V power = T(0.5) * pair.F * damped * vr;
    si.heat += j.volume * power;
    sj.heat += i.volume * power;
    const V speed = keep(pair.in_reach, closing);
    si.closing = maximum(si.closing, speed);
    sj.closing = maximum(sj.closing, speed);
  }
  UNDEX_INLINE void wall(const State&, const Wall&, const Pair<V>&, Sums&, WallSums<V>&) const {}
};

}  // namespace undex::solid::UNDEX_LEVEL
