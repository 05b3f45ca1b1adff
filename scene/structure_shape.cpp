#include "scene/structure_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace undex::scene {
namespace {

constexpr int turns = 64, lines = 33;

/// Points at the radii round an axis, at heights between low and high.
std::vector<Vec3> round_points(int axis, const Vec3& center, const std::vector<double>& radii,
                               const std::vector<double>& heights) {
  std::vector<Vec3> points;
  for (const double height : heights)
    for (const double radius : radii)
      for (int i = 0; i < turns; ++i) {
        const double angle = 2 * std::numbers::pi * i / turns;
        Vec3 x = center;
        x[axis] = height;
        x[(axis + 1) % 3] += radius * std::cos(angle);
        x[(axis + 2) % 3] += radius * std::sin(angle);
        points.push_back(x);
      }
  return points;
}

std::vector<double> between(double low, double high) {
  std::vector<double> values;
  for (int i = 0; i < lines; ++i) values.push_back(low + (high - low) * i / (lines - 1));
  return values;
}

}  // namespace

std::optional<Primitive> structure_shape(const fem::Mesh& mesh) {
  const auto shape = [](const auto& each) -> std::optional<Primitive> {
    if constexpr (requires { shape_of(each); }) return shape_of(each);
    else return std::nullopt;
  };
  return std::visit(shape, mesh);
}

std::vector<Vec3> face_points(const Primitive& shape, const std::string& face) {
  if (const auto* t = std::get_if<TubeShape>(&shape)) {
    if (face == "inner") return round_points(t->axis, t->center, {t->inner}, between(t->low, t->high));
    if (face == "outer") return round_points(t->axis, t->center, {t->outer}, between(t->low, t->high));
    if (face == "low") return round_points(t->axis, t->center, between(t->inner, t->outer), {t->low});
    if (face == "high") return round_points(t->axis, t->center, between(t->inner, t->outer), {t->high});
  }
  if (const auto* c = std::get_if<Cylinder>(&shape)) {
    if (face == "side") return round_points(c->axis, c->center, {c->radius}, between(c->low, c->high));
    if (face == "low") return round_points(c->axis, c->center, between(0, c->radius), {c->low});
    if (face == "high") return round_points(c->axis, c->center, between(0, c->radius), {c->high});
  }
  std::vector<Vec3> points;
  if (const auto* s = std::get_if<Sphere>(&shape); s && face == "side")
    for (const double height : between(-1, 1)) {
      const double radius = s->radius * std::sqrt(1 - height * height);
      const std::vector<Vec3> circle = round_points(2, s->center, {radius}, {s->center[2] + s->radius * height});
      points.insert(points.end(), circle.begin(), circle.end());
    }
  if (const auto* p = std::get_if<Box>(&shape))
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        if (face != std::string(1, "xyz"[axis]) + (high ? "_high" : "_low")) continue;
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        for (const double along : between(p->low[b], p->high[b]))
          for (const double across : between(p->low[c], p->high[c])) {
            Vec3 x;
            x[axis] = high ? p->high[axis] : p->low[axis];
            x[b] = along;
            x[c] = across;
            points.push_back(x);
          }
      }
  return points;
}

double thickness(const Primitive& shape, int dimension) {
  const Bounds extent = bounds(shape, dimension);
  double least = 1e300;
  for (int a = 0; a < dimension; ++a) least = std::min(least, extent.high[a] - extent.low[a]);
  if (const auto* tube = std::get_if<TubeShape>(&shape); tube && (dimension > 1 || tube->axis != 0))
    least = std::min(least, tube->outer - tube->inner);
  return least;
}

}  // namespace undex::scene
