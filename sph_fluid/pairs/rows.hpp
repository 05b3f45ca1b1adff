// Rows: what a pair reads and what it gives, one a particle; a list of candidates is made of them by transposing. Beside each
// stands what the loops must know of it: the type of its numbers, and how they change from a particle to its mirror image
// (`parity`: bit a is set where the sign of number k changes with axis a).
// Nothing here may instantiate library templates: the loops are compiled several times, for several instruction sets, and share
// this header, pair_data.hpp and kernels.hpp with the rest.
#pragma once

#define UNDEX_ROW_INLINE __attribute__((always_inline)) static constexpr

namespace undex::sph {

/// The rows that a scheme reads beside FluidRow.
enum class SecondRow { none, gradient, corrected, viscosity, solid };

/// Sign changes of the six numbers (xx, yy, zz, xy, yz, zx) of a symmetric matrix.
__attribute__((always_inline)) constexpr int parity_of_symmetric(int k) { return k < 3 ? 0 : k == 5 ? 5 : 3 << (k - 3); }

/// What a pair reads of a fluid particle beside its place. Of a ring, whose place is (r, z, 0), vz is its area in the
/// meridian [m^2].
struct alignas(64) FluidRow {
  double vx, vy, vz;  ///< velocity predicted for this evaluation [m/s]
  double p;           ///< pressure beyond that of the surroundings [Pa]
  double volume;      ///< m/rho [m^3]
  double rho, c;      ///< density [kg/m^3], sound speed [m/s]
  double h;           ///< smoothing length [m]

  using Number = double;
  UNDEX_ROW_INLINE int parity(int k) { return k < 3 ? 1 << k : 0; }
};

/// What a pair reads of a wall's dummy particle.
struct alignas(64) WallRow {
  double vx, vy, vz;  ///< [m/s]
  double nx, ny, nz;  ///< unit normal, away from the fluid; behind an edge, the edge's direction
  double volume;      ///< [m^3]
  double slip;        ///< 1: free slip; 0: no slip, or a free-slip corner (nothing slips there); -1: a free-slip edge

  using Number = double;
  UNDEX_ROW_INLINE int parity(int k) { return k < 3 ? 1 << k : k < 6 ? 1 << (k - 3) : 0; }
};

/// For schemes that read nothing else.
struct NoRow {
  using Number = double;
  static constexpr SecondRow which = SecondRow::none;
  UNDEX_ROW_INLINE int parity(int) { return 0; }
};

/// Limited reconstruction's raw material: gradients of velocity (its symmetric part, all that the component along a pair
/// needs: xx, yy, zz, xy, yz, zx) [1/s] and of pressure [Pa/m]. Single precision: they only shape a correction.
struct GradientRow {
  float strain[6], pressure[3];
  float filling;  ///< by which the pair rates of gas are divided (riemann.hpp); 1 in liquids

  using Number = float;
  static constexpr SecondRow which = SecondRow::gradient;
  UNDEX_ROW_INLINE int parity(int k) { return k < 6 ? parity_of_symmetric(k) : k < 9 ? 1 << (k - 6) : 0; }
};

/// Lower bound of GradientRow::filling. Half is what a plane free surface has.
inline constexpr float least_filling = 0.5f;

/// The same with the moments N (xx, yy, zz, xy, yz, zx) [-] that correct kernel gradients; see riemann_corrected.hpp.
struct CorrectedRow {
  GradientRow gradient;
  float moment[6];

  using Number = float;
  static constexpr SecondRow which = SecondRow::corrected;
  UNDEX_ROW_INLINE int parity(int k) { return k < 10 ? GradientRow::parity(k) : parity_of_symmetric(k - 10); }
};

/// A particle's own coefficient of viscosity; see monaghan_switch.hpp.
struct ViscosityRow {
  double alpha;

  using Number = double;
  static constexpr SecondRow which = SecondRow::viscosity;
  UNDEX_ROW_INLINE int parity(int) { return 0; }
};

/// What pairs of solid particles read beside FluidRow [Pa]: sigma B, row by row, B being the correction of kernel gradients
/// (solid_schemes.hpp); sigma itself: xx, yy, zz, yz, zx, xy; the rate of strain, in the same order [1/s]; and
/// the speed of shear waves [m/s].
struct SolidRow {
  double corrected[9], stress[6], strain[6], shear_sound;

  using Number = double;
  static constexpr SecondRow which = SecondRow::solid;
  UNDEX_ROW_INLINE int parity(int k) {
    if (k < 9) return (1 << k / 3) ^ (1 << k % 3);
    const int within = (k - 9) % 6;  // 21 is shear_sound
    return within < 3 ? 0 : within == 3 ? 6 : within == 4 ? 5 : 3;
  }
};

/// What a solid particle learns from its body's others: velocity gradient d v_a/d x_b at 3a + b [1/s], and the correction B
/// (xx, yy, zz, xy, yz, zx) [-].
struct DeformationRow {
  double gradient[9], correction[6];
};

/// What pairs of rings read beside (pairs/ring_kernel.hpp).
struct RingRow {
  double a;      ///< [1/m]
  double slope;  ///< [1/m^2]
  double share;  ///< of an image: how much of the hoop it has, 0 in a wall along the axis to 1 in one across; of others 1

  using Number = double;
  UNDEX_ROW_INLINE int parity(int k) { return k == 1 ? 1 : 0; }
};

/// What the pairs add up for a fluid particle.
struct SumRow {
  double fx, fy, fz;   ///< acceleration times density [N/m^3]
  double compression;  ///< (d rho/dt)/rho [1/s]
  double heat;         ///< viscous heating times density [W/m^3]
  double closing;      ///< a maximum: closing speed to a neighbour, as the scheme's step limit wants it [m/s]
};

/// What they add up for a wall's particle.
struct ForceRow {
  double fx, fy, fz;  ///< [N]
};

/// A row as an array of its numbers, and how many it has.
template <class Row>
__attribute__((always_inline)) inline const typename Row::Number* numbers(const Row* row) {
  return reinterpret_cast<const typename Row::Number*>(row);
}
template <class Row>
inline constexpr int length_of = sizeof(Row) / sizeof(typename Row::Number);
template <>
inline constexpr int length_of<NoRow> = 0;

}  // namespace undex::sph
