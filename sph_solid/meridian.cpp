#include "sph_solid/meridian.hpp"

#include <stdexcept>

namespace undex::solid {

Settings in_meridian(Settings settings, const sph::Settings& around) {
  if (!around.axisymmetric) return settings;
  if (around.dimension != 2 || !around.symmetry.axis[0])
    throw std::invalid_argument("solids: an axisymmetric scene has two dimensions and a symmetry plane x = 0, its axis");
  if (around.gravity[0] != 0.0 || around.gravity[2] != 0.0)
    throw std::invalid_argument("gravity: in an axisymmetric scene it acts along the axis");
  for (Body& body : settings.bodies) {
    const auto refuse = [&](const char* why) { throw std::invalid_argument("solid '" + body.name + "': " + why); };
    if (!body.spin.isZero(0.0)) refuse("spin: rings of an axisymmetric scene do not turn; use three dimensions");
    if (body.residual_stress != 0.0)
      refuse("residual_stress: it is there for cylinders in two and three dimensions, not in the meridian");
    if (body.velocity[2] != 0.0) refuse("velocity: rings of an axisymmetric scene move along r and the axis only");
    auto* box = std::get_if<Box>(&body.shape.base);
    if (!box && !std::holds_alternative<Sphere>(body.shape.base) && !std::holds_alternative<Cone>(body.shape.base) &&
        !has_one_face(body.shape.base))
      refuse("shape: in the meridian a solid is a box (of a cylinder or a tube), a sphere, a cone or a shape with one face");
    if (box && box->low[0] <= 0.0) box->low[0] = -box->high[0];
  }
  for (const RigidPlane& plane : settings.planes)
    if (plane.axis != 1)
      throw std::invalid_argument(
          "planes: in an axisymmetric scene a rigid plane lies across the axis; one along it would be a cylinder");
  return settings;
}

}  // namespace undex::solid
