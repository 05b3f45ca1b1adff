// Solids of revolution, as settings give them: in the meridian (r, axial), x = r.
#pragma once

#include "sph_solid/settings.hpp"

namespace undex::solid {

/// The settings of an axisymmetric scene; those of any other are left as they are. A box that reaches the axis gets its other
/// half, so that the axis is none of its faces. Throws std::invalid_argument naming body or plane, key and reason where a solid
/// cannot be one of revolution.
Settings in_meridian(Settings settings, const sph::Settings& around);

}  // namespace undex::solid
