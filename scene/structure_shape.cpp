#include "scene/structure_shape.hpp"

#include <algorithm>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

#include "core/closed_surface.hpp"
#include "core/surface.hpp"
#include "scene/faces.hpp"

namespace undex::scene {
namespace {

constexpr int turns = 64, lines = 33;

/// Points about an axis, at (radius, height).
std::vector<Vec3> turned_points(int axis, const Vec3& center, const std::vector<std::pair<double, double>>& places) {
  std::vector<Vec3> points;
  for (const auto& [radius, height] : places)
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

/// Points at the radii round an axis, at heights between low and high.
std::vector<Vec3> round_points(int axis, const Vec3& center, const std::vector<double>& radii,
                               const std::vector<double>& heights) {
  std::vector<std::pair<double, double>> places;
  for (const double height : heights)
    for (const double radius : radii) places.emplace_back(radius, height);
  return turned_points(axis, center, places);
}

std::vector<double> between(double low, double high) {
  std::vector<double> values;
  for (int i = 0; i < lines; ++i) values.push_back(low + (high - low) * i / (lines - 1));
  return values;
}

}  // namespace

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
  if (const auto* c = std::get_if<Cone>(&shape)) {
    std::vector<std::pair<double, double>> side;
    for (const double height : between(c->low, c->high)) side.emplace_back(c->radius_at(height), height);
    if (face == "side") return turned_points(c->axis, c->center, side);
    if (face == "low") return round_points(c->axis, c->center, between(0, c->low_radius), {c->low});
    if (face == "high") return round_points(c->axis, c->center, between(0, c->high_radius), {c->high});
  }
  std::vector<Vec3> points;
  if (const auto* s = std::get_if<Sphere>(&shape); s && face == "side")
    for (const double height : between(-1, 1)) {
      const double radius = s->radius * std::sqrt(1 - height * height);
      const std::vector<Vec3> circle = round_points(2, s->center, {radius}, {s->center[2] + s->radius * height});
      points.insert(points.end(), circle.begin(), circle.end());
    }
  if (has_one_face(shape)) {
    const Bounds extent = bounds(shape, 3);
    const auto surface = closed_surface(shape, (extent.high - extent.low).maxCoeff() / (lines - 1), 3);
    if (surface) points = surface->nodes;
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

StructureShape::StructureShape(const fem::Mesh& mesh, const std::optional<Meridian>& meridian) {
  std::visit(
      [&](const auto& each) {
        if constexpr (requires { shape_of(each); }) primitive_ = shape_of(each);
        else mesh_ = each.read;
      },
      mesh);
  if (!mesh_) return;
  distance_ = std::make_shared<const MeshDistance>(mesh_);
  if (!mesh_->cells.empty() && is_quadrangle(mesh_->cells[0])) meridian_ = meridian.value_or(Meridian{});
}

double StructureShape::signed_distance(const Vec3& x) const {
  if (primitive_) return undex::signed_distance(*primitive_, x, 3);
  return distance_->signed_distance(meridian_ ? meridian_->place(x) : x);
}

Bounds StructureShape::extent() const {
  if (primitive_) return bounds(*primitive_, 3);
  const Bounds section = bounds(*mesh_);
  if (!meridian_) return section;
  Bounds whole{meridian_->center - Vec3::Constant(section.high[0]), meridian_->center + Vec3::Constant(section.high[0])};
  whole.low[meridian_->axis] = section.low[1];
  whole.high[meridian_->axis] = section.high[1];
  return whole;
}

double StructureShape::thickness() const {
  if (primitive_) return scene::thickness(*primitive_, 3);
  double volume = 0, area = 0;
  for (const auto& cell : mesh_->cells)
    for (const double corner : corner_volumes(mesh_->nodes, cell)) volume += std::abs(corner) / 8;
  for (const auto& face : mesh_->faces) {
    const std::array<Vec3, 4> corner = corners_of(face.nodes, mesh_->nodes);
    area += 0.5 * (corner[2] - corner[0]).cross(corner[3] - corner[1]).norm();
  }
  return 2 * volume / area;
}

std::vector<std::string> StructureShape::faces(const std::array<bool, 3>& symmetric) const {
  if (primitive_) return shape_faces(*primitive_, 3, symmetric);
  std::set<int> ids;
  for (const auto& face : mesh_->faces) ids.insert(face.id);
  std::vector<std::string> names;
  for (const int id : ids) names.push_back(mesh_->face_names.of(id));
  return names;
}

std::vector<Vec3> StructureShape::face_points(const std::string& face) const {
  if (primitive_) return scene::face_points(*primitive_, face);
  std::vector<Vec3> points;
  std::vector<std::pair<double, double>> places;  // in the meridian
  for (const auto& each : mesh_->faces) {
    if (mesh_->face_names.of(each.id) != face) continue;
    if (meridian_) {
      const Vec3 &a = mesh_->nodes[each.nodes[0]], &b = mesh_->nodes[each.nodes[1]];
      for (const Vec3& x : {a, Vec3(0.5 * (a + b)), b}) places.emplace_back(x[0], x[1]);
      continue;
    }
    Vec3 middle = Vec3::Zero();
    for (const int node : each.nodes) {
      points.push_back(mesh_->nodes[node]);
      middle += 0.25 * mesh_->nodes[node];
    }
    points.push_back(middle);
  }
  return meridian_ ? turned_points(meridian_->axis, meridian_->center, places) : points;
}

std::optional<StructureShape> structure_shape(const fem::Mesh& mesh, const std::optional<Meridian>& meridian) {
  if (const auto* gmsh = std::get_if<fem::GmshMesh>(&mesh); gmsh && !gmsh->read) return std::nullopt;
  return StructureShape(mesh, meridian);
}

}  // namespace undex::scene
