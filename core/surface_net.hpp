// Quadrangles (in two dimensions segments) on the surface of any body that a signed distance gives.
#pragma once

#include <functional>
#include <optional>

#include "core/surface.hpp"

namespace undex {

/// A dual mesh (T. Ju, F. Losasso, S. Schaefer, J. Warren, Dual contouring of Hermite data, ACM Trans. Graph. 21, 2002): a
/// node in each cell of a lattice of `spacing` [m] that the surface cuts, where the planes through its crossings with the
/// cell's edges meet best, so that edges and corners of the body are kept, and a face about each lattice edge that it cuts.
/// Nodes on smooth parts are evened out. `distance` [m] is negative inside, its sign exact; `box` holds the body. The planes
/// x = 0, y = 0, z = 0 lie midway between lattice planes: the mesh of a body that is its own image has nodes on them and no
/// face across. In two or three dimensions; none where a part is so thin, or two are so close, that it would not be closed.
std::optional<WetSurface> surface_net(const std::function<double(const Vec3&)>& distance, const Bounds& box, double spacing,
                                      int dimension);

}  // namespace undex
