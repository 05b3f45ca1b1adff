// The kernel of rings: particles of a body of revolution, seen in the meridian (r, z). Between rings i and j
//   K_ij = (a_i + a_j)/2 [W(x_i - x_j) + W(x_i - x_j')],   j' the image of j across the axis,
// with the plane kernel W and weights a(r; h) that are 1/(2 pi r) far from the axis. Rates are derivatives of K, by
//   dK_ij/dx_i = (a_i + a_j)/2 grad W + 1/2 W slope_i e_r,
// so that momentum along the axis and energy are exchanged without loss pair by pair, for any functions a and slope. These are
// such that on the Cartesian lattice of the scene's h over spacing, column by column,
//   a      the volumes of all neighbours times K add up to one,
//   slope  nothing is accelerated under uniform pressure.
// Between the columns they are those of a lattice without end in number, corrected through the columns. They are functions of
// r/h alone: functions of a ring's own area, too, would be exact on compressed lattices, but then a ring that strays towards the
// axis, whose area grows as 1/r, is drawn on, and water at rest under pressure does not stay so.
#pragma once

#include <vector>

#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/pairs/rows.hpp"

namespace undex::sph {

/// Of one ring; see above.
struct Ring {
  double a;      ///< [1/m]
  double slope;  ///< of a along r [1/m^2]
};

/// The area in the meridian [m^2] of a ring of that volume [m^3] and radius [m], a square. One that would reach across the axis
/// is a disc, as high as its radius.
double ring_area(double volume, double r);

class RingKernel {
 public:
  /// For a kernel, of a scene with h = eta spacings.
  RingKernel(KernelName kernel, double eta);

  /// Of the ring of radius r [m] and smoothing length h [m]. Below zero, where images beyond the axis lie, `a` is that of -r and
  /// `slope` its negative.
  Ring at(double r, double h) const;
  RingRow row(double r, double h) const {
    const Ring ring = at(r, h);
    return {.a = ring.a, .slope = ring.slope, .share = 1.0};
  }
  /// The lattice's sum of W dx^2 at the scene's h over spacing, by which W is divided.
  double lattice_sum() const { return lattice_sum_; }

 private:
  std::vector<Ring> table_;  ///< at equal steps of r/h, up to where the axis is not felt
  double lattice_sum_;
};

}  // namespace undex::sph
