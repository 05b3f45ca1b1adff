// The section of a lattice of rings. Rings of about square cells are not in equilibrium under uniform pressure, |g| h being 0.09
// at the axis and 0.006 further out (water/settle.hpp): their points are moved until it vanishes, as settled starts do it, once
// for all layers. At the radius that the rings are fitted to the section is mirrored, as in a slip wall; quadrants are alike.
#pragma once

#include <vector>

#include "sph_fluid/settings.hpp"

namespace undex::sph {

class RingSection {
 public:
  /// Of rings of that width within `radius` [m], in layers that are `layer` [m] apart (in two dimensions there is one).
  RingSection(const Settings& settings, double radius, double width, double layer);

  /// Point q of a ring, from the axis [m]. Rings beyond the radius have their points where circles have them.
  Eigen::Vector2d point(long ring, long q) const;

 private:
  double width_;
  std::vector<std::vector<Eigen::Vector2d>> quadrant_;  // by ring
};

}  // namespace undex::sph
