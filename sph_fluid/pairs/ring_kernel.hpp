// The kernel of rings: particles of a body of revolution, seen in the meridian (r, z). Between rings i and j
//   K_ij = (a_i + a_j)/2 [W(x_i - x_j) + W(x_i - x_j')],   j' the image of j across the axis,
// with the plane kernel W and weights a(r; h) that are 1/(2 pi r) far from the axis. Rates are derivatives of K, by
//   dK_ij/dx_i = (a_i + a_j)/2 grad W + 1/2 W slope_i e_r,
// so that momentum along the axis and energy are exchanged without loss pair by pair, for any three functions a, slope and lent.
// These are such that on a Cartesian lattice of any spacing, column by column,
//   a      the volumes of all neighbours times K add up to one,
//   slope  nothing is accelerated under uniform pressure,
//   lent   the volume of every ring changes as it must where v_r = r: of the work that i's hoop motion does in a pair, the part
//          lent/slope counts as a change of volume of j, the rest as one of i.
// They depend on r/h and on h over the spacing, which a ring knows by its area. Between the columns a and slope are those of a
// lattice without end in number, corrected through the columns.
#pragma once

#include <vector>

#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/pairs/rows.hpp"

namespace undex::sph {

/// Of one ring; see above.
struct Ring {
  double a;      ///< [1/m]
  double slope;  ///< of a along r [1/m^2]
  double lent;   ///< [1/m^2]
};

class RingKernel {
 public:
  /// For a kernel, of a scene with h = eta spacings.
  RingKernel(KernelName kernel, double eta);

  /// Of the ring of radius r > 0 [m], smoothing length h [m] and area [m^2] in the meridian.
  Ring at(double r, double h, double area) const;
  RingRow row(double r, double h, double area) const {
    const Ring ring = at(r, h, area);
    return {.a = ring.a, .slope = ring.slope, .lent = ring.lent, .share = 1.0};
  }
  /// The lattice's sum of W dx^2 at the scene's h over spacing, by which W is divided.
  double lattice_sum() const { return lattice_sum_; }

 private:
  /// The functions at equal steps of r/h up to where the axis is not felt, for one h over spacing; lent times r^2 beyond.
  struct Table {
    std::vector<Ring> value;
    double far_lent;
  };
  std::vector<Table> tables_;  ///< at equal steps of the logarithm of h over spacing
  double first_, lattice_sum_;
};

}  // namespace undex::sph
