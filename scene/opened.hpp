// Shapes without some of their faces: what stands open, and what waves leave through.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sph_fluid/settings.hpp"

namespace undex::scene {

/// How far away a face is that is not there [m].
inline constexpr double endless = 1e6;

/// A container without end where `open` says so of a face by its name; a cone ends at its tip at the latest.
Primitive opened(const Primitive& container, const std::function<bool(const std::string& face)>& open);

/// A body's shape without end at those of its faces that lie on radiating faces of the walls. A wave that has passed them is in
/// the body what it would be in water without end. Nor does it end at a symmetry plane, where it is drawn on the kept side only.
Primitive without_radiating_faces(const Primitive& shape, const sph::Settings& fluid);

/// The same shape with these faces only. Inside, the distance to its surface is that to where waves leave.
Primitive with_radiating_faces_only(const Primitive& shape, const sph::Settings& fluid);

}  // namespace undex::scene
