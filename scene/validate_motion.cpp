// Motions towards or away from a point or an axis: their own mirror images, and finite.
#include "scene/validator.hpp"

namespace undex::scene {

void Validator::motions() {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto& motion_of = is_fluid(i) ? fluid_.bodies[i].radial : scene_.solids.bodies[i - fluid_.bodies.size()].radial;
    if (!motion_of || !usable_[i]) continue;
    const Part& one = parts_[i];
    motion(
        *motion_of, one.path(), *one.node, [&](const Vec3& x) { return -signed_distance(*one.shape, x, dimension_); },
        bounds(one.shape->base, dimension_));
  }
  for (const Structure& each : structures_)
    if (each.settings->radial && each.shape)
      motion(*each.settings->radial, each.path, *each.node, each.depth(), each.shape->extent());
}

void Validator::motion(const RadialMotion& motion, const std::string& path, const Node& node, const Depth& solid,
                       const Bounds& extent) {
  using About = RadialMotion::About;
  if (scene_.geometry == Geometry::plane || scene_.geometry == Geometry::spherical) {
    complain(node, "radial", path + ".radial does not go with one dimension; take velocity, or radial_velocity of a body");
    return;
  }
  for (int a = 0; a < dimension_; ++a)
    if (fluid_.symmetry.axis[a] && int(motion.about) != a && motion.center[a] != 0)
      complain(node, "radial",
               path + ".radial.center lies off the symmetry plane " + "xyz"[a] +
                   " = 0: the motion is not its own mirror image; put it on the plane, or leave the plane out");
  if (dimension_ == 2 && (motion.about == About::x || motion.about == About::y))
    complain(node, "radial", path + ".radial.about: in two dimensions a motion is about \"z\" or \"point\", which are the same");
  if (motion.power >= 0) return;
  // Where the centre lies in what moves, speeds have no bound.
  constexpr int samples = 200;
  for (int k = 0; k <= samples; ++k) {
    Vec3 x = motion.center;
    if (motion.about != About::point && int(motion.about) < dimension_) {
      const int a = int(motion.about);
      x[a] = extent.low[a] + (extent.high[a] - extent.low[a]) * k / samples;
    }
    if (!x.allFinite() || !(solid(x) > 0)) continue;
    complain(node, "radial",
             path + ".radial.power is negative and " + (motion.about == About::point ? "its centre" : "its axis") +
                 " lies in what moves, where the speed has no bound; hollow it, or take power = 0 or more");
    return;
  }
}

}  // namespace undex::scene
