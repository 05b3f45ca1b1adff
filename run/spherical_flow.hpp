// The one-dimensional flow of a scene's spherical charge in its medium: the spherical start begins from it, and comparisons are
// made with it. Cells are as fine as the wave asks for: a charge's radius over `charge_cells` at the charge, and wider with the
// radius of the wave's front, w(r) = w(a) (a + r)/(2 a), for the wave grows longer as it runs. What lies ahead of the front is
// laid out so; what the front has left behind is merged as it goes on. The cost of a run out to r grows with log(r/a), not with
// its square.
#pragma once

#include "exact/lagrangian_1d.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// The scene's spherical charges: that which start.body names, or all of gas or products (indices).
std::vector<std::size_t> charges_of(const scene::Scene& scene);
/// The only one, and the body round a charge (indices). Throws SceneError where there is none.
std::size_t charge_of(const scene::Scene& scene);
std::size_t medium_of(const scene::Scene& scene, std::size_t charge);

/// The charge as it is at time zero. Throws SceneError where there is none.
Sphere spherical_charge(const scene::Scene& scene);

class SphericalFlow {
 public:
  /// Medium out to the radius `outer` [m], where the wave passes. Throws SceneError where the scene has no spherical charge.
  SphericalFlow(const scene::Scene& scene, double outer, int charge_cells);
  /// The same of one of several charges (index).
  SphericalFlow(const scene::Scene& scene, std::size_t charge, double outer, int charge_cells);

  /// To exactly t [s]; cells are merged on the way.
  void advance(double t);
  void visit_state(StateVisitor& state);
  const exact::Lagrangian1D& mesh() const { return mesh_; }
  double time() const { return mesh_.time(); }
  double front() const;                    ///< radius of the wave's front [m]
  double cell_width(double radius) const;  ///< of the mesh when the front is there [m]

 private:
  double charge_radius_, charge_cell_;  // [m]
  exact::Lagrangian1D mesh_;
  double threshold_ = 0;  // of pressure above that at rest, by which the front is known [Pa]
  double merged_at_ = 0;  // front's radius when cells were merged last [m]
};

}  // namespace undex::run
