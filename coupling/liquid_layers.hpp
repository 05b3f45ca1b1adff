// How stiff the first layer of the water's particles is to a wall that it lies before: what a light wall may not be moved against
// in too long a step (docs/theory/equations.md, section 14).
#pragma once

#include <vector>

#include "sph_fluid/water/fluid.hpp"

namespace undex::coupling {

/// The share of 1/omega that a step may be, omega being the frequency of a wall on its layer.
inline constexpr double added_mass_share = 0.3;

/// The liquids of a scene, as they are at the start: gases and products are soft by the time they fill the place before a wall.
class LiquidLayers {
 public:
  /// `fluid` must outlive it.
  explicit LiquidLayers(const sph::Settings& fluid);

  struct Layer {
    const sph::Body* body;
    double stiffness;  ///< rho c^2/dx [Pa/m]
    double impedance;  ///< rho c [Pa s/m]
  };
  bool empty() const { return layers_.empty(); }
  /// Of the liquid nearest to x [m].
  const Layer& nearest(const Vec3& x) const;

 private:
  int dimension_;
  std::vector<Layer> layers_;
};

}  // namespace undex::coupling
