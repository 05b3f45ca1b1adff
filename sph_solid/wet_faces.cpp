// The wet faces of solids in particles as a mesh of material points.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "core/closed_surface.hpp"
#include "sph_solid/solid_faces.hpp"
#include "sph_solid/solids_implementation.hpp"

namespace undex::solid {
namespace {

/// The faces of a body that are named wet, within the symmetry planes and clear of `dry` places and other bodies.
WetSurface wet_faces_of(const Body& body, const Settings& settings, const sph::Settings& around, const Places& dry) {
  const int dimension = around.dimension;
  const double spacing = body.spacing.value_or(around.lattice.spacing), near = 1e-6 * spacing;
  const auto refuse = [&](const char* why) {
    throw std::invalid_argument("solid '" + body.name + "': " + why +
                                ", so its wet faces cannot be meshed; change the shape, or name others");
  };
  std::optional<WetSurface> whole = closed_surface(body.shape.base, spacing, dimension);
  if (!whole) refuse("this shape has no closed surface of faces of a spacing in the scene's dimension");
  for (Vec3& x : whole->nodes)
    for (int a = 0; a < dimension; ++a)
      if (around.symmetry.axis[a] && std::abs(x[a]) < near) x[a] = 0.0;
  std::vector<bool> left_out;
  for (const std::array<int, 4>& face : whole->faces) {
    const auto count = [&](auto holds) {
      return std::count_if(face.begin(), face.end(), [&](int n) { return holds(whole->nodes[n]); });
    };
    const std::array<Vec3, 4> corner = corners_of(face, whole->nodes);
    const Vec3 middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    bool out = !is_wet(body, middle, dimension) || count(dry) == 4;
    for (const Body& other : settings.bodies)
      out = out || (&other != &body && signed_distance(other.shape, middle, dimension) < near);
    for (int a = 0; a < dimension; ++a)
      if (around.symmetry.axis[a]) out = out || count([&](const Vec3& x) { return x[a] <= 0.0; }) == 4;
    left_out.push_back(out);
    if (out) continue;
    for (int a = 0; a < dimension; ++a)
      if (around.symmetry.axis[a] && count([&](const Vec3& x) { return x[a] < 0.0; }) > 0)
        refuse("a symmetry plane cuts it, and not through its middle");
    for (const Primitive& removed : body.shape.removed)
      if (count([&](const Vec3& x) { return signed_distance(Shape{removed, {}}, x, dimension) < -near; }) > 0)
        refuse("a shape that is taken out of it opens one of them");
  }
  return without(*whole, left_out);
}

}  // namespace

void Solids::mesh_wet_faces(const Places& dry) {
  Implementation& s = *self_;
  for (const Body& body : s.settings.bodies) {
    const WetSurface wet = wet_faces_of(body, s.settings, s.around, dry);
    const int first = int(s.surface.nodes.size());
    s.surface.nodes.insert(s.surface.nodes.end(), wet.nodes.begin(), wet.nodes.end());
    for (std::array<int, 4> face : wet.faces) {
      for (int& node : face) node += first;
      s.surface.faces.push_back(face);
    }
  }
  s.surface_points.resize(s.surface.nodes.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t n = 0; n < s.surface_points.size(); ++n) s.surface_points[n] = s.locate(s.surface.nodes[n]);
  s.share_mass();
  s.find_skin_mass();
  s.surface_has_moved = true;
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

void Solids::Implementation::find_skin_mass() {
  const std::vector<double> area = nodal_areas(surface.faces, surface.nodes, around.axisymmetric);
  std::vector<double> speed(particles.size(), 0.0);
  for (std::size_t n = 0; n < area.size(); ++n)
    for (const BodyPoint::Share& share : surface_points[n].motion)
      speed[share.carrier] += share.weight * area[n] / particles.mass[share.carrier];
  for (std::size_t n = 0; n < area.size(); ++n) {
    double seen = 0.0;
    for (const BodyPoint::Share& share : surface_points[n].motion) seen += share.weight * speed[share.carrier];
    skin_mass.push_back(area[n] / seen);
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
  if (!surface_has_moved) return;
  const auto timer = timers.measure("solid surface");
  for (auto* field : {&surface_position, &surface_velocity, &surface_acceleration})
    field->assign(surface_points.size(), Vec3::Zero());
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < surface_points.size(); ++n)
    for (const auto& [i, weight, image] : surface_points[n].motion) {
      surface_position[n] += weight * mirrored(particles.x[i], image);
      surface_velocity[n] += weight * mirrored(particles.v[i], image);
      surface_acceleration[n] += weight * mirrored(acceleration[i], image);
    }
  surface_has_moved = false;
}

void Solids::kick_surface(std::span<const Vec3> impulse) {
  std::vector<Vec3> received(self_->particles.size(), Vec3::Zero());
  for (std::size_t n = 0; n < impulse.size(); ++n) scatter_to_carriers(self_->surface_points[n], impulse[n], received);
  kick(received);
}

const WetSurface& Solids::wet_surface() const { return self_->surface; }
std::span<const Vec3> Solids::wet_positions() const {
  self_->show_surface_motion();
  return self_->surface_position;
}
std::span<const Vec3> Solids::wet_velocities() const {
  self_->show_surface_motion();
  return self_->surface_velocity;
}
std::span<const Vec3> Solids::wet_accelerations() const {
  self_->show_surface_motion();
  return self_->surface_acceleration;
}
std::span<const double> Solids::wet_masses() const { return self_->surface_mass; }
std::span<const double> Solids::wet_skin_masses() const { return self_->skin_mass; }

}  // namespace undex::solid
