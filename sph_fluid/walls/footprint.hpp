// A particle presses on an area as wide as its kernel, not on a point: where a wall's mesh is finer than that, loads that went to
// the foot's face alone would crush single cells and leave others without any. Nodes therefore share what they receive with those
// within a smoothing length H, by a hat,
//   S_nm = A_m max(1 - |X_n - X_m|/H, 0) / sum over k,   force_m = sum_n S_nm force_n,   velocity shown at n = sum_m S_nm v_m,
// A being the nodes' areas: total force and power are kept, and a mesh wider than the particles is left as it is. Across a
// symmetry plane the mirrored nodes have their share.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vector.hpp"

namespace undex::sph {

class Footprint {
 public:
  /// Of a rigid mesh: S is the unit matrix, so that a load keeps its moment and a velocity is that of the foot.
  Footprint() = default;
  /// Of the faces' nodes at `position` [m]; `width` H [m]; `rings`: segments are those of a meridian.
  Footprint(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position, double width,
            const std::array<bool, 3>& symmetry, bool rings);
  /// Of nodes that share nothing.
  explicit Footprint(std::size_t nodes);

  /// S v.
  std::vector<Vec3> seen(std::span<const Vec3> nodal) const;
  /// Adds S^T f to `sum`.
  void spread(std::span<const Vec3> nodal, std::vector<Vec3>& sum) const;

 private:
  struct Share {
    int node;
    unsigned mirror;  // bit a of `mirror`: reflected across axis a
    double weight;
  };
  std::vector<std::size_t> begin_;  // empty: the unit matrix
  std::vector<Share> shares_;
};

}  // namespace undex::sph
