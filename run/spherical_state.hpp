// Spherical flows laid over the bodies of a scene in space.
#pragma once

#include <memory>
#include <vector>

#include "exact/lagrangian_1d.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// A spherical flow at one moment, about a place of a scene.
struct SphericalState {
  std::shared_ptr<const exact::Lagrangian1D> flow;
  Vec3 center = Vec3::Zero();       ///< [m]
  double front = 0;                 ///< radius up to which anything has happened [m]
  std::vector<std::size_t> bodies;  ///< index in the scene of each layer's body
  double share = 1;                 ///< of the ball that the scene's symmetry planes keep
};

/// The share of a ball about a place [m] that the scene's symmetry planes keep: half for each plane through it. Nothing where the
/// place is cut off. A plane that does not go through it cuts nothing as long as the ball does not reach it.
std::optional<double> kept_share(const scene::Scene& scene, const Vec3& center);

/// Gives the bodies of the scene the states as their starts: mass and energy of a body are those of its layers and of its rest,
/// `exact` as a StartField is. Contacts between layers grow, in the shapes of all bodies, to where they are now; charges have
/// burned. A body that a wave has left through a radiating face takes means of the states as they are: what it still has of the
/// sums is not known. The balls up to the fronts must not meet: each place takes the state of the ball that it lies deepest in.
/// The flows are those of a uniform medium; a liquid with a `level` gets its column's pressure beyond that on top.
void lay(const std::vector<SphericalState>& states, bool exact, scene::Scene& scene);

}  // namespace undex::run
