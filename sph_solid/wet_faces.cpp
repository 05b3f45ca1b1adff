// The wet faces of solids in particles as a mesh of material points, for a coupling by faces.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "sph_solid/solid_faces.hpp"
#include "sph_solid/solids_implementation.hpp"

namespace undex::solid {
namespace {

/// A patch of surface over u and v, with the direction out of the body.
struct FacePatch {
  std::function<Vec3(double u, double v)> place;
  double low[2], high[2];  ///< range of u and v
  double length[2];        ///< of the patch along each [m]
  std::function<Vec3(const Vec3&)> outward;
};

/// The angles about `axis` that the symmetry planes keep.
void kept_angles(int axis, const std::array<bool, 3>& mirror, double& low, double& high) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;  // x[u] = r cos, x[v] = r sin
  const double half = 0.5 * std::numbers::pi;
  low = mirror[v] ? 0.0 : mirror[u] ? -half : 0.0;
  high = mirror[u] ? half : mirror[v] ? 2.0 * half : 4.0 * half;
}

FacePatch round_patch(int axis, const Vec3& center, double radius, double low, double high, double sign,
                      const std::array<bool, 3>& mirror) {
  FacePatch patch;
  kept_angles(axis, mirror, patch.low[0], patch.high[0]);
  patch.low[1] = mirror[axis] ? std::max(low, 0.0) : low;
  patch.high[1] = high;
  patch.length[0] = radius * (patch.high[0] - patch.low[0]);
  patch.length[1] = patch.high[1] - patch.low[1];
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto exact = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };  // nodes on a symmetry plane lie on it
  patch.place = [=](double angle, double along) {
    Vec3 x = center;
    x[u] += radius * exact(std::cos(angle));
    x[v] += radius * exact(std::sin(angle));
    x[axis] = along;
    return x;
  };
  patch.outward = [=](const Vec3& x) {
    Vec3 r = x - center;
    r[axis] = 0.0;
    return Vec3(sign * r.normalized());
  };
  return patch;
}

FacePatch flat_patch(int axis, double position, const Vec3& low, const Vec3& high, double sign,
                     const std::array<bool, 3>& mirror) {
  FacePatch patch;
  const int a[2] = {(axis + 1) % 3, (axis + 2) % 3};
  for (int k = 0; k < 2; ++k) {
    patch.low[k] = mirror[a[k]] ? std::max(low[a[k]], 0.0) : low[a[k]];
    patch.high[k] = high[a[k]];
    patch.length[k] = patch.high[k] - patch.low[k];
  }
  patch.place = [=](double u, double v) {
    Vec3 x;
    x[axis] = position;
    x[a[0]] = u;
    x[a[1]] = v;
    return x;
  };
  patch.outward = [=](const Vec3&) { return Vec3(sign * Vec3::Unit(axis)); };
  return patch;
}

std::vector<FacePatch> wet_patches(const Body& body, const sph::Settings& around) {
  const auto& mirror = around.symmetry.axis;
  std::vector<std::string> names = body.wet.empty() ? solid_faces(body.shape.base, around.dimension) : body.wet;
  const auto refuse = [&](const std::string& name) {
    return std::invalid_argument(
        "solid '" + body.name + "': coupling.solids = \"surface\" cannot mesh the face '" + name +
        "'; name the sides of a tube, a cylinder or a box in wet, or use coupling.solids = \"particles\"");
  };
  std::vector<FacePatch> patches;
  for (const std::string& name : names) {
    if (const auto* tube = std::get_if<TubeShape>(&body.shape.base); tube && (name == "inner" || name == "outer")) {
      const bool inner = name == "inner";
      patches.push_back(round_patch(tube->axis, tube->center, inner ? tube->inner : tube->outer, tube->low, tube->high,
                                    inner ? -1.0 : 1.0, mirror));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&body.shape.base); cylinder && name == "side") {
      patches.push_back(
          round_patch(cylinder->axis, cylinder->center, cylinder->radius, cylinder->low, cylinder->high, 1.0, mirror));
    } else if (const auto* box = std::get_if<Box>(&body.shape.base)) {
      const int axis = name[0] - 'x';
      const bool high = name.ends_with("high");
      patches.push_back(
          flat_patch(axis, high ? box->high[axis] : box->low[axis], box->low, box->high, high ? 1.0 : -1.0, mirror));
    } else {
      throw refuse(name);
    }
  }
  return patches;
}

// ---- Of a body of revolution ----------------------------------------------------------------------------------------

/// A line of the meridian that water touches, from its low end to its high one, and the direction out of the body.
struct WetLine {
  std::function<Vec3(double share)> place;
  double length;  ///< [m]
  std::function<Vec3(const Vec3&)> outward;
};

WetLine straight_line(const Vec3& from, const Vec3& to, const Vec3& outward) {
  return {[=](double share) { return Vec3(from + share * (to - from)); }, (to - from).norm(),
          [=](const Vec3&) { return outward; }};
}

/// A sphere's meridian, or where it does not reach the axis the section of a torus.
WetLine round_line(const Vec3& center, double radius) {
  const double half = center[0] < radius ? std::acos(std::max(-1.0, -center[0] / radius)) : std::numbers::pi;
  const auto exact = [=](double r) { return std::abs(r) < 1e-12 * radius ? 0.0 : r; };  // poles lie on the axis
  return {[=](double share) {
            const double angle = half * (2.0 * share - 1.0);
            return Vec3(exact(center[0] + radius * std::cos(angle)), center[1] + radius * std::sin(angle), 0.0);
          },
          2.0 * half * radius, [=](const Vec3& x) { return Vec3((x - center).normalized()); }};
}

/// Those of a cone, its side from the low end to the high one.
std::vector<WetLine> wet_lines(const Cone& cone, const std::vector<std::string>& names) {
  const Vec3 low(cone.low_radius, cone.low, 0.0), high(cone.high_radius, cone.high, 0.0), along = (high - low).normalized();
  std::vector<WetLine> lines;
  for (const std::string& name : names) {
    if (name == "side") lines.push_back(straight_line(low, high, {along[1], -along[0], 0.0}));
    if (name == "low") lines.push_back(straight_line({0.0, cone.low, 0.0}, low, -Vec3::UnitY()));
    if (name == "high") lines.push_back(straight_line({0.0, cone.high, 0.0}, high, Vec3::UnitY()));
  }
  std::erase_if(lines, [](const WetLine& line) { return !(line.length > 0.0); });  // a tip
  return lines;
}

/// Those of a box, a sphere or a cone (in_meridian allows no other).
std::vector<WetLine> wet_lines(const Body& body, const sph::Settings& around) {
  if (const auto* ball = std::get_if<Sphere>(&body.shape.base)) return {round_line(ball->center, ball->radius)};
  if (const auto* cone = std::get_if<Cone>(&body.shape.base))
    return wet_lines(*cone, body.wet.empty() ? solid_faces(*cone, 2) : body.wet);
  const Box& box = std::get<Box>(body.shape.base);
  const bool whole = box.low[0] < 0.0, halved = around.symmetry.axis[1] && box.low[1] <= 0.0;  // about the axis, along it
  const double inner = whole ? 0.0 : box.low[0], outer = box.high[0], low = halved ? 0.0 : box.low[1], high = box.high[1];
  std::vector<WetLine> lines;
  for (const std::string& name : body.wet.empty() ? solid_faces(box, 2) : body.wet) {
    if (name == "x_high") lines.push_back(straight_line({outer, low, 0.0}, {outer, high, 0.0}, Vec3::UnitX()));
    if (name == "x_low" && !whole) lines.push_back(straight_line({inner, low, 0.0}, {inner, high, 0.0}, -Vec3::UnitX()));
    if (name == "y_high") lines.push_back(straight_line({inner, high, 0.0}, {outer, high, 0.0}, Vec3::UnitY()));
    if (name == "y_low" && !halved) lines.push_back(straight_line({inner, low, 0.0}, {outer, low, 0.0}, -Vec3::UnitY()));
  }
  return lines;
}

/// Adds segments about a spacing wide. Lines that meet share no node: each moves as the body's edge does.
void mesh(const WetLine& line, double spacing, WetSurface& surface) {
  const int count = std::max(1, int(std::lround(line.length / spacing)));
  const int first = int(surface.nodes.size());
  const bool closed = (line.place(0.0) - line.place(1.0)).norm() < 1e-6 * spacing;
  for (int k = 0; k < (closed ? count : count + 1); ++k) surface.nodes.push_back(line.place(double(k) / count));
  for (int k = 0; k < count; ++k) {
    int a = first + k, b = first + (closed ? (k + 1) % count : k + 1);
    const Vec3 middle = 0.5 * (surface.nodes[a] + surface.nodes[b]), along = surface.nodes[b] - surface.nodes[a];
    if (along.cross(Vec3::UnitZ()).dot(line.outward(middle)) > 0.0) std::swap(a, b);
    surface.faces.push_back({a, b, b, a});
  }
}

// ---- In space -------------------------------------------------------------------------------------------------------

/// Adds a grid of quadrilaterals about a spacing wide. Where a round patch closes upon itself the last nodes are the first.
void mesh(const FacePatch& patch, double spacing, WetSurface& surface) {
  const int count[2] = {std::max(1, int(std::lround(patch.length[0] / spacing))),
                        std::max(1, int(std::lround(patch.length[1] / spacing)))};
  const int first = int(surface.nodes.size());
  const bool closed =
      (patch.place(patch.low[0], patch.low[1]) - patch.place(patch.high[0], patch.low[1])).norm() < 1e-6 * spacing;
  const int columns = closed ? count[0] : count[0] + 1;
  for (int j = 0; j <= count[1]; ++j)
    for (int i = 0; i < columns; ++i)
      surface.nodes.push_back(patch.place(patch.low[0] + (patch.high[0] - patch.low[0]) * i / count[0],
                                          patch.low[1] + (patch.high[1] - patch.low[1]) * j / count[1]));
  const auto node = [&](int i, int j) { return first + j * columns + i % columns; };
  for (int j = 0; j < count[1]; ++j)
    for (int i = 0; i < count[0]; ++i) {
      std::array<int, 4> face{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      const Vec3 x0 = surface.nodes[face[0]];
      const Vec3 area = (surface.nodes[face[1]] - x0).cross(surface.nodes[face[3]] - x0);
      // Into the body, as WetSurface wants it.
      if (area.dot(patch.outward(x0)) > 0) std::swap(face[1], face[3]);
      surface.faces.push_back(face);
    }
}

}  // namespace

void Solids::mesh_wet_faces() {
  Implementation& s = *self_;
  for (const Body& body : s.settings.bodies) {
    const double spacing = body.spacing.value_or(s.around.lattice.spacing);
    if (s.around.axisymmetric)
      for (const WetLine& line : wet_lines(body, s.around)) mesh(line, spacing, s.surface);
    else
      for (const FacePatch& patch : wet_patches(body, s.around)) mesh(patch, spacing, s.surface);
  }
  s.surface_points.resize(s.surface.nodes.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t n = 0; n < s.surface_points.size(); ++n) s.surface_points[n] = s.locate(s.surface.nodes[n]);
  for (auto* field : {&s.surface_position, &s.surface_velocity, &s.surface_acceleration}) field->resize(s.surface_points.size());
  s.share_mass();
  s.show_surface_motion();
}

void Solids::Implementation::share_mass() {
  std::vector<double> seen(particles.size(), 0.0);
  for (const BodyPoint& point : surface_points)
    for (const BodyPoint::Share& share : point.motion) seen[share.carrier] += std::abs(share.weight);
  for (const BodyPoint& point : surface_points) {
    double& mass = surface_mass.emplace_back(0.0);
    for (const BodyPoint::Share& share : point.motion) {
      const double weight = std::abs(share.weight);
      if (weight > 0.0) mass += particles.mass[share.carrier] * weight / seen[share.carrier];
    }
  }
}

/// The nodes' impulses [N s] as steady forces on the particles over an interval [s].
void Solids::Implementation::spread_impulse(std::span<const Vec3> wet_impulse, double interval) {
  std::fill(impulse_force.begin(), impulse_force.end(), Vec3::Zero());
  for (std::size_t n = 0; n < wet_impulse.size(); ++n) scatter_to_carriers(surface_points[n], wet_impulse[n], impulse_force);
  if (!wet_impulse.empty())
    for (Vec3& force : impulse_force) force /= interval;
}

void Solids::Implementation::show_surface_motion() {
  if (surface_points.empty()) return;
  const auto timer = timers.measure("solid surface");
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < surface_points.size(); ++n) {
    const MaterialPoint values = read(surface_points[n]);
    surface_position[n] = values.position;
    surface_velocity[n] = values.velocity;
    surface_acceleration[n] = values.acceleration;
  }
}

const WetSurface& Solids::wet_surface() const { return self_->surface; }
std::span<const Vec3> Solids::wet_positions() const { return self_->surface_position; }
std::span<const Vec3> Solids::wet_velocities() const { return self_->surface_velocity; }
std::span<const Vec3> Solids::wet_accelerations() const { return self_->surface_acceleration; }
std::span<const double> Solids::wet_masses() const { return self_->surface_mass; }

}  // namespace undex::solid
