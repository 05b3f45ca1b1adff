// Solids on rigid planes: which particles touch which plane. While it touches, the plane is a mirror: the particle and those that
// lie upon it have images behind the plane, as at a symmetry plane. Momentum goes to the plane by the forces of the images, which
// do no work; contact is frictionless, loses no energy, and ends where the plane would have to pull.
#pragma once

#include <cstdint>
#include <vector>

#include "core/rigid_plane.hpp"
#include "sph_solid/settings.hpp"
#include "sph_solid/solid_particles.hpp"

namespace undex::solid {

/// A set of rigid planes, a bit each.
using PlaneSet = std::uint32_t;
inline constexpr std::size_t most_planes = 32;

/// The outer layer of a body as a rigid plane meets it.
struct OuterLayer {
  double half = 0;    ///< distance of its particles from the plane when they touch [m]
  bool flat = false;  ///< do they lie in one plane, parallel to the rigid one, at the start?
};
/// Of particles begin..end of a body, towards the plane, from their places at the start.
OuterLayer outer_layer(const RigidPlane& plane, const Body& body, const SolidParticles& particles, std::uint32_t begin,
                       std::uint32_t end, double spacing, int dimension);

/// +1 where bodies lie above the plane, else -1.
inline double side_of(const RigidPlane& plane) { return plane.body_above ? 1.0 : -1.0; }
inline double height(const RigidPlane& plane, const Vec3& x) { return side_of(plane) * (x[plane.axis] - plane.position); }

/// Particles begin..end that lie upon a touching one, nearer to the plane than `reach` [m] and within a spacing of it sideways,
/// touch as well, as far as images go: adds the plane's bit to theirs.
void add_upper_layers(const std::vector<RigidPlane>& planes, const std::vector<Vec3>& x, const std::vector<PlaneSet>& touching,
                      std::uint32_t begin, std::uint32_t end, double spacing, double reach, std::vector<PlaneSet>& backed);

}  // namespace undex::solid
