#include "scene/opened.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace undex::scene {
namespace {

/// The plane of a flat face: across which axis, at which side, and where [m].
struct Plane {
  int axis;
  bool high;
  double at;
};

std::optional<Plane> plane_of(const Primitive& shape, const std::string& face) {
  if (const auto* box = std::get_if<Box>(&shape)) {
    const int axis = face[0] - 'x';
    const bool high = face.ends_with("_high");
    return Plane{axis, high, high ? box->high[axis] : box->low[axis]};
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&shape); cylinder && face != "side")
    return Plane{cylinder->axis, face == "high", face == "high" ? cylinder->high : cylinder->low};
  return std::nullopt;
}

/// Do both lie on one surface, of the same side?
bool same_face(const Primitive& one, const std::string& face, const Primitive& other, const std::string& other_face) {
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * (std::abs(a) + std::abs(b)); };
  const auto plane = plane_of(one, face), other_plane = plane_of(other, other_face);
  if (plane && other_plane)
    return plane->axis == other_plane->axis && plane->high == other_plane->high && same(plane->at, other_plane->at);
  if (plane || other_plane) return false;
  const auto same_middle = [](const Vec3& a, const Vec3& b, double size) { return (a - b).norm() <= 1e-9 * size; };
  if (const auto* a = std::get_if<Sphere>(&one), *b = std::get_if<Sphere>(&other); a && b)
    return same(a->radius, b->radius) && same_middle(a->center, b->center, a->radius);
  const auto *a = std::get_if<Cylinder>(&one), *b = std::get_if<Cylinder>(&other);
  if (!a || !b || a->axis != b->axis) return false;
  Vec3 apart = a->center - b->center;
  apart[a->axis] = 0.0;
  return same(a->radius, b->radius) && same_middle(apart, Vec3::Zero(), a->radius);
}

std::vector<std::string> faces_of(const Primitive& shape) {
  if (std::holds_alternative<Box>(shape)) return {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"};
  if (std::holds_alternative<Cylinder>(shape)) return {"side", "low", "high"};
  if (std::holds_alternative<Sphere>(shape)) return {"side"};
  return {};
}

/// Does a face lie on a symmetry plane?
bool is_cut(const Primitive& shape, const std::string& face, const std::array<bool, 3>& symmetric) {
  const auto plane = plane_of(shape, face);
  return plane && symmetric[std::size_t(plane->axis)] && plane->at == 0.0;
}

Primitive opened_where(const Primitive& shape, const sph::Settings& fluid, bool radiating) {
  if (faces_of(shape).empty()) return radiating ? shape : Primitive(Sphere{Vec3::Zero(), endless});
  const auto radiates = [&](const std::string& face) {
    return std::any_of(fluid.walls.begin(), fluid.walls.end(), [&](const sph::Wall& wall) {
      return std::any_of(wall.faces.begin(), wall.faces.end(), [&](const auto& of_wall) {
        return of_wall.second == sph::FaceCondition::radiating && same_face(shape, face, wall.container, of_wall.first);
      });
    });
  };
  return opened(shape,
                [&](const std::string& face) { return is_cut(shape, face, fluid.symmetry.axis) || radiates(face) == radiating; });
}

}  // namespace

Primitive opened(const Primitive& container, const std::function<bool(const std::string& face)>& open) {
  if (const auto* box = std::get_if<Box>(&container)) {
    Box larger = *box;
    for (int a = 0; a < 3; ++a) {
      if (open(std::string(1, "xyz"[a]) + "_low")) larger.low[a] = -endless;
      if (open(std::string(1, "xyz"[a]) + "_high")) larger.high[a] = endless;
    }
    return larger;
  }
  if (const auto* sphere = std::get_if<Sphere>(&container))
    return Sphere{sphere->center, open("side") ? endless : sphere->radius};
  if (const auto* cone = std::get_if<Cone>(&container)) {
    // As long again, but not beyond its tip.
    const double length = cone->high - cone->low, wider = cone->high_radius - cone->low_radius;
    const auto further = [&](double radius, double by) { return by < 0 ? std::min(length, -radius / by * length) : length; };
    Cone larger = *cone;
    if (open("low")) larger.low -= further(cone->low_radius, -wider);
    if (open("high")) larger.high += further(cone->high_radius, wider);
    larger.low_radius = std::max(0.0, cone->radius_at(larger.low));
    larger.high_radius = std::max(0.0, cone->radius_at(larger.high));
    if (open("side")) larger.low_radius = larger.high_radius = endless;
    return larger;
  }
  Cylinder larger = std::get<Cylinder>(container);
  if (open("side")) larger.radius = endless;
  if (open("low")) larger.low = -endless;
  if (open("high")) larger.high = endless;
  return larger;
}

Primitive without_radiating_faces(const Primitive& shape, const sph::Settings& fluid) { return opened_where(shape, fluid, true); }

Primitive with_radiating_faces_only(const Primitive& shape, const sph::Settings& fluid) {
  return opened_where(shape, fluid, false);
}

}  // namespace undex::scene
