// What symmetry planes make of bodies that they do not halve: mirror images that the scene does not name.
#include "scene/validator.hpp"

namespace undex::scene {
namespace {

/// Is the shape round where the axis crosses it, so that a plane off its middle leaves a lens or a peanut?
bool is_round_across(const Primitive& shape, int axis) {
  if (std::holds_alternative<Sphere>(shape) || std::holds_alternative<Ellipsoid>(shape)) return true;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return cylinder->axis != axis;
  if (const auto* tube = std::get_if<TubeShape>(&shape)) return tube->axis != axis;
  if (const auto* cone = std::get_if<Cone>(&shape)) return cone->axis != axis;
  return false;
}

/// Has a spin a component about an axis that lies in the plane across `axis`? A mirror turns it round.
bool turns_within(const Vec3& spin, int axis) {
  Vec3 within = spin;
  within[axis] = 0;
  return within.norm() > 0;
}

std::string plane(int axis) { return std::string("the symmetry plane ") + "xyz"[axis] + " = 0"; }

}  // namespace

void Validator::mirrors() {
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (usable_[i]) mirrored(parts_[i], is_fluid(i), is_fluid(i) ? &fluid_.bodies[i] : nullptr);
  for (const Structure& each : structures_) mirrored(each);
}

void Validator::mirrored(const Part& one, bool fluid, const sph::Body* body) {
  const Primitive& shape = one.shape->base;
  const Bounds extent = bounds(shape, dimension_);
  int away = 1;
  std::string off;
  for (int a = 0; a < dimension_; ++a) {
    if (!fluid_.symmetry.axis[a]) continue;
    const double low = extent.low[a], high = extent.high[a], middle = 0.5 * (low + high);
    const bool crosses = low < -tolerance(), centred = is_mirrored(shape, a, 0.0, dimension_);
    if (crosses && body && body->velocity[a] != 0)
      complain(*one.node, "velocity",
               one.path() + ": its velocity across " + plane(a) +
                   ", which cuts it, is not its own mirror image; leave out that component or the plane");
    if (crosses && body && turns_within(body->spin, a))
      complain(*one.node, "spin",
               one.path() + ": its spin about an axis within " + plane(a) +
                   ", which cuts it, is not its own mirror image; leave out that component or the plane");
    if (fluid && crosses && !centred) {
      if (is_round_across(shape, a))
        complain(
            *one.node, "shape",
            one.path() + ": its middle lies at " + "xyz"[a] + " = " + rounded(middle) + " m, off " + plane(a) +
                ", which cuts it: mirrored it would be two that overlap; put its middle on the plane, or leave the plane out");
      else
        warn(*one.node, "shape",
             one.path() + ": what lies below " + plane(a) +
                 " is left out and replaced by the mirror image of the rest: it runs from " + rounded(-high) + " to " +
                 rounded(high) + " m, where " + rounded(low) + " to " + rounded(high) + " is written");
    }
    if (low > tolerance() && (!fluid || std::holds_alternative<Sphere>(shape) || is_round_across(shape, a) || body->variable_h)) {
      away *= 2;
      off += (off.empty() ? "" : ", ") + std::string(1, "xyz"[a]) + " = 0";
    }
  }
  if (away > 1)
    warn(*one.node, "shape",
         one.path() + " lies off the symmetry plane" + (away > 2 ? "s " : " ") + off + ": the whole scene has " +
             std::to_string(away) + " of it, mirror images of each other at the same time; leave the plane out if one is meant");
  if (body) mirrored_burn(*body, *one.node);
}

void Validator::mirrored_burn(const sph::Body& body, const Node& node) {
  if (!body.burn || body.burn->instantaneous) return;
  const Bounds extent = bounds(body.shape.base, dimension_);
  for (int a = 0; a < dimension_; ++a) {
    if (!fluid_.symmetry.axis[a] || extent.low[a] >= -tolerance()) continue;
    const double origin = body.burn->origin[a];
    if (std::abs(origin) <= 1e-6 * (extent.high[a] - extent.low[a])) continue;
    warn(node, "burn",
         "bodies." + body.name + ".burn: the initiation lies at " + "xyz"[a] + " = " + rounded(origin) + " m, off " + plane(a) +
             ", which cuts the charge: mirrored it is lit at two places; put the initiation on the plane or leave the plane out");
  }
}

/// A mesh is bonded to its mirror image: its nodes on the plane stay there.
void Validator::mirrored(const Structure& one) {
  if (!one.shape || dimension_ != 3) return;
  const Node& node = *one.node;
  const Bounds extent = one.shape->extent();
  const double size = (extent.high - extent.low).maxCoeff();
  int away = 1;
  for (int a = 0; a < 3; ++a) {
    if (!fluid_.symmetry.axis[a]) continue;
    if (extent.low[a] > 1e-6 * size) {
      away *= 2;
    } else if (one.settings->initial_velocity[a] != 0) {
      complain(
          node, "velocity",
          one.path + ".velocity has a component across " + plane(a) +
              ", which the structure touches: it is bonded to its mirror image there; leave out that component or the plane");
    } else if (turns_within(one.settings->spin, a)) {
      complain(
          node, "spin",
          one.path + ".spin has a component about an axis within " + plane(a) +
              ", which the structure touches: it is bonded to its mirror image there; leave out that component or the plane");
    }
  }
  if (away > 1)
    warn(node, "shape",
         one.path + ".shape lies off the symmetry planes: the whole scene has " + std::to_string(away) +
             " of it, mirror images of each other; leave the planes out if one is meant");
}

}  // namespace undex::scene
