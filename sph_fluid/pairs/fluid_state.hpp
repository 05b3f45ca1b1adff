// A fluid particle in SIMD lanes, the geometry of a pair, and the sums that the schemes share.
#pragma once

#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_fluid/pairs/simd.hpp"

namespace undex::sph::UNDEX_LEVEL {

/// How the entries of a row change from a particle to its mirror image: bit a is set where the sign changes with axis a.
inline constexpr int parity_of(const FluidRow*, int k) { return k < 3 ? 1 << k : 0; }
inline constexpr int parity_of(const WallRow*, int k) { return k < 3 ? 1 << k : k < 6 ? 1 << (k - 3) : 0; }
inline constexpr int parity_of(const GradientRow*, int k) {
  return k < 3 ? 0 : k < 6 ? (k == 5 ? 5 : 3 << (k - 3)) : 1 << (k - 6);
}
inline constexpr int parity_of(const ViscosityRow*, int) { return 0; }
inline constexpr int parity_of(const CorrectedRow*, int k) {
  return k < 10 ? parity_of((const GradientRow*)nullptr, k < 9 ? k : 0) : parity_of((const GradientRow*)nullptr, k - 10);
}
inline constexpr int parity_of(const SolidRow*, int k) {
  constexpr int shear[3] = {6, 5, 3};
  return k < 9 ? (1 << k / 3) ^ (1 << k % 3) : (k - 9) % 6 < 3 ? 0 : shear[(k - 9) % 6 - 3];  // shear_sound is k = 21
}

/// A row as an array of its numbers.
inline const double* numbers(const FluidRow* row) { return &row->vx; }
inline const double* numbers(const WallRow* row) { return &row->vx; }
inline const float* numbers(const GradientRow* row) { return row->strain; }
inline const float* numbers(const CorrectedRow* row) { return row->gradient.strain; }
inline const double* numbers(const ViscosityRow* row) { return &row->alpha; }
inline const double* numbers(const SolidRow* row) { return row->corrected; }

/// The rows that a scheme reads beside FluidRow.
struct NoRow {};
inline const NoRow* second_rows(const PairInput&, bool, const NoRow*) { return nullptr; }
inline const GradientRow* second_rows(const PairInput& in, bool images, const GradientRow*) {
  return images ? in.images.gradient : in.gradient;
}
inline const CorrectedRow* second_rows(const PairInput& in, bool images, const CorrectedRow*) {
  return images ? in.images.corrected : in.corrected;
}
inline const ViscosityRow* second_rows(const PairInput& in, bool images, const ViscosityRow*) {
  return images ? in.images.viscosity : in.viscosity;
}
inline const SolidRow* second_rows(const PairInput& in, bool, const SolidRow*) { return in.solid; }
inline constexpr int length_of(const NoRow*) { return 0; }
inline constexpr int length_of(const GradientRow*) { return sizeof(GradientRow) / sizeof(float); }
inline constexpr int length_of(const CorrectedRow*) { return sizeof(CorrectedRow) / sizeof(float); }
inline constexpr int length_of(const ViscosityRow*) { return sizeof(ViscosityRow) / sizeof(double); }
inline constexpr int length_of(const SolidRow*) { return sizeof(SolidRow) / sizeof(double); }

/// Whom a pass pairs a particle with.
enum class Partners { all, own_body, other_bodies };

/// Two particles i and j (or i and a wall's particle): d = x_i - x_j, and F = (dW/dr)/r.
template <class V>
struct Pair {
  V dx, dy, dz, r2, h, F;
  Mask<Element<V>> near;  ///< within the kernel's support; F is zero elsewhere
  bool gas;               ///< is one of them gas?
  bool alike;             ///< are they of one material?
};

/// A fluid particle; `read(k)` gives entry k of its row.
template <class V>
struct FluidState {
  V vx, vy, vz, p, volume, rho, c;
  using Second = NoRow;

  template <class Read>
  UNDEX_INLINE void read(Read entry) {
    vx = entry(0), vy = entry(1), vz = entry(2), p = entry(3), volume = entry(4), rho = entry(5), c = entry(6);
  }
};

template <class V>
struct WallState {
  V vx, vy, vz, nx, ny, nz, volume, slip;

  template <class Read>
  UNDEX_INLINE void read(Read entry) {
    vx = entry(0), vy = entry(1), vz = entry(2), nx = entry(3), ny = entry(4), nz = entry(5), volume = entry(6), slip = entry(7);
  }
};

/// See SumRow. A pair adds to i's and to j's.
template <class V>
struct FluidSums {
  V fx{}, fy{}, fz{}, compression{}, heat{}, closing{};
  static constexpr int count = sizeof(SumRow) / sizeof(double);
  static constexpr bool is_maximum(int k) { return k == 5; }

  template <class Visit>
  UNDEX_INLINE void each(Visit visit) {
    visit(fx, 0), visit(fy, 1), visit(fz, 2), visit(compression, 3), visit(heat, 4), visit(closing, 5);
  }
};

/// See ForceRow.
template <class V>
struct WallSums {
  V fx{}, fy{}, fz{};
  static constexpr int count = 3;
  static constexpr bool is_maximum(int) { return false; }

  template <class Visit>
  UNDEX_INLINE void each(Visit visit) {
    visit(fx, 0), visit(fy, 1), visit(fz, 2);
  }
};

/// Adds the force V_i V_j t d of a pair, seen from i's side, to the sums of both.
template <class V>
UNDEX_INLINE void add_force(V t, const Pair<V>& pair, V volume_i, V volume_j, FluidSums<V>& si, FluidSums<V>& sj) {
  const V ti = t * volume_j, tj = t * volume_i;
  si.fx -= ti * pair.dx;
  si.fy -= ti * pair.dy;
  si.fz -= ti * pair.dz;
  sj.fx += tj * pair.dx;
  sj.fy += tj * pair.dy;
  sj.fz += tj * pair.dz;
}

/// The same against a wall's particle, along e instead of d.
template <class V>
UNDEX_INLINE void add_wall_force(V t, V ex, V ey, V ez, V volume_i, V volume_w, FluidSums<V>& si, WallSums<V>& sw) {
  const V ti = t * volume_w, tw = ti * volume_i;
  si.fx -= ti * ex;
  si.fy -= ti * ey;
  si.fz -= ti * ez;
  sw.fx += tw * ex;
  sw.fy += tw * ey;
  sw.fz += tw * ez;
}

}  // namespace undex::sph::UNDEX_LEVEL
