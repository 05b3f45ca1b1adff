#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "coupling/participant.hpp"
#include "sph_solid/solid_faces.hpp"

namespace undex::coupling {
namespace {

/// A patch of surface over u and v, with the direction out of the body.
struct Patch {
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

Patch round_patch(int axis, const Vec3& center, double radius, double low, double high, double sign,
                  const std::array<bool, 3>& mirror) {
  Patch patch;
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

Patch flat_patch(int axis, double position, const Vec3& low, const Vec3& high, double sign, const std::array<bool, 3>& mirror) {
  Patch patch;
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

std::vector<Patch> wet_patches(const sph::SolidBody& body, const sph::Settings& settings) {
  const auto& mirror = settings.symmetry.axis;
  std::vector<std::string> names = body.wet.empty() ? sph::solid_faces(body.shape.base, settings.dimension) : body.wet;
  const auto refuse = [&](const std::string& name) {
    return std::invalid_argument(
        "solid '" + body.name + "': coupling.solids = \"surface\" cannot mesh the face '" + name +
        "'; name the sides of a tube, a cylinder or a box in wet, or use coupling.solids = \"particles\"");
  };
  std::vector<Patch> patches;
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

/// Adds a grid of quadrilaterals about a spacing wide. Where a round patch closes upon itself the last nodes are the first.
void mesh(const Patch& patch, double spacing, WetSurface& surface) {
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

ParticleParticipant::ParticleParticipant(sph::Solids& solids) : solids_(solids) {
  const sph::Settings& settings = solids.settings();
  for (const sph::SolidBody& body : settings.solids)
    for (const Patch& patch : wet_patches(body, settings)) mesh(patch, body.spacing.value_or(settings.lattice.spacing), surface_);
  points_.resize(surface_.nodes.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t n = 0; n < points_.size(); ++n) points_[n] = solids.locate(surface_.nodes[n]);
  for (auto* field : {&position_, &velocity_, &acceleration_}) field->resize(points_.size());
  share_mass();
  read_motion();
}

void ParticleParticipant::share_mass() {
  std::vector<double> seen(solids_.particle_count(), 0.0);
  const auto each = [](const sph::Solids::Point& point, auto use) {
    for (std::size_t k = 0; k < point.particles.size(); ++k) use(point.particles[k], std::abs(point.weights[k]));
  };
  for (const sph::Solids::Point& point : points_) each(point, [&](std::uint32_t i, double weight) { seen[i] += weight; });
  for (const sph::Solids::Point& point : points_) {
    double& mass = mass_.emplace_back(0.0);
    each(point, [&](std::uint32_t i, double weight) {
      if (weight > 0.0) mass += solids_.particle_mass(i) * weight / seen[i];
    });
  }
}

void ParticleParticipant::advance(double t_end, std::span<const Vec3> impulse) {
  particle_impulse_.assign(solids_.particle_count(), Vec3::Zero());
  for (std::size_t n = 0; n < impulse.size(); ++n) solids_.distribute(points_[n], impulse[n], particle_impulse_);
  solids_.advance(t_end, particle_impulse_);
  read_motion();
}

void ParticleParticipant::read_motion() {
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const sph::Solids::PointValues values = solids_.read(points_[n]);
    position_[n] = values.position;
    velocity_[n] = values.velocity;
    acceleration_[n] = values.acceleration;
  }
}

}  // namespace undex::coupling
