// What uniform stress does to the column of a body of revolution beside the axis, where pairs are those of half-way rings.
#pragma once

namespace undex::solid {

/// On a square lattice whose columns lie at R = 1/2, 3/2 ... spacings, and their images at -1/2 ..., under uniform pressure:
/// what pushes the first column inward, over what its hoop's pressure pushes outward. The two would balance at 1.
struct FirstColumn {
  double inward;  ///< by the stresses of all
  double own;     ///< the part of its own stress in it
};

/// For Wendland's kernel, h being eta spacings.
FirstColumn first_column(double eta);

}  // namespace undex::solid
