// Material points of solids in particles: weights that are exact for linear fields, what they read, and what they hand on.
#include <Eigen/LU>

#include <cmath>
#include <optional>

#include "core/surface.hpp"
#include "sph_fluid/pairs/kernels.hpp"
#include "sph_solid/solids_implementation.hpp"

namespace undex::solid {

using namespace sph;  // pairs, cells and kernels
namespace {

using undex::mirrored;  // of vectors; of symmetric tensors:
Mat3 mirrored(Mat3 s, unsigned image) {
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if ((image >> a & 1) != (image >> b & 1)) s(a, b) = -s(a, b);
  return s;
}

/// Is the image across the planes (bit a: axis a) within reach of a place?
bool within_reach(unsigned image, const Vec3& place, const std::array<bool, 3>& symmetry, double reach) {
  for (int a = 0; a < 3; ++a)
    if (image >> a & 1 && !(symmetry[a] && place[a] < reach)) return false;
  return true;
}

/// The particle nearest to a place at the start, and how far it is [m].
std::pair<std::uint32_t, double> nearest_particle(const SolidParticles& particles, const Vec3& place) {
  std::uint32_t nearest = 0;
  double best = 1e300;
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    const double d = (particles.start[i] - place).squaredNorm();
    if (d < best) best = d, nearest = i;
  }
  return {nearest, std::sqrt(best)};
}

/// The point of the bodies' surfaces nearest to x at the start, if one lies within `reach` [m].
std::optional<Vec3> nearest_surface(const Settings& settings, int dimension, const Vec3& x, double reach) {
  std::optional<Vec3> nearest;
  double best = reach;
  for (const Body& solid : settings.bodies) {
    const auto distance = [&](const Vec3& at) { return signed_distance(solid.shape, at, dimension); };
    const double away = distance(x);
    if (std::abs(away) > best) continue;
    best = std::abs(away);
    Vec3 outward = Vec3::Zero();
    for (int a = 0; a < dimension; ++a) {
      const Vec3 step = 1e-3 * reach * Vec3::Unit(a);
      outward[a] = distance(x + step) - distance(x - step);
    }
    nearest = x - away * outward.stableNormalized();
  }
  return nearest;
}

}  // namespace

/// Weights W (1 + b.(X - place)) over the particles of one body, that of the nearest particle.
BodyPoint Solids::Implementation::locate(const Vec3& place) const {
  BodyPoint point;
  const auto [nearest, distance] = nearest_particle(particles, place);
  point.distance = distance;
  const SolidGroup& group = group_of(nearest);
  for (double h = group.h;; h *= 1.25) {
    const auto offset = [&](const BodyPoint::Share& share) -> Vec3 {
      return (mirrored(particles.start[share.carrier], share.image) - place) / h;
    };
    point.motion.clear();
    Eigen::Matrix4d moment = Eigen::Matrix4d::Zero();
    for (int a = around.dimension; a < 3; ++a) moment(a + 1, a + 1) = 1.0;
    for (unsigned image = 0; image < 8; ++image) {
      if (!within_reach(image, place, around.symmetry.axis, WendlandC2::support * h)) continue;
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        BodyPoint::Share share{i, 0.0, image};
        const Vec3 d = offset(share);
        share.weight = WendlandC2::shape(d.norm());
        if (share.weight <= 0.0) continue;
        point.motion.push_back(share);
        const Eigen::Vector4d basis(1.0, d[0], d[1], d[2]);
        moment += share.weight * basis * basis.transpose();
      }
    }
    if (!(moment.determinant() > 1e-6) && h < 20.0 * group.h) continue;
    const Eigen::Vector4d coefficient = moment.fullPivLu().solve(Eigen::Vector4d::Unit(0));
    for (BodyPoint::Share& share : point.motion) {
      const Vec3 d = offset(share);
      share.weight *= coefficient.dot(Eigen::Vector4d(1.0, d[0], d[1], d[2]));
    }
    return point;
  }
}

MaterialPoint Solids::Implementation::read(const BodyPoint& point) const {
  const SolidParticles& p = particles;
  MaterialPoint values;
  for (const auto& [i, w, image] : point.motion) {
    values.position += w * mirrored(p.x[i], image);
    values.displacement += w * mirrored(Vec3(p.x[i] - p.start[i]), image);
    values.velocity += w * mirrored(p.v[i], image);
    values.acceleration += w * mirrored(acceleration[i], image);
    values.stress += w * mirrored(p.stress(i), image);
    values.plastic_strain += w * p.plastic_strain[i];
    values.temperature += w * p.temperature[i];
  }
  return values;
}

BodyPoint Solids::locate(const Vec3& reference_position) const { return self_->locate(reference_position); }
MaterialPoint Solids::read(const BodyPoint& point) const { return self_->read(point); }

std::function<Vec3()> Solids::follow_surface(const Vec3& reference_position, double reach) const {
  if (auto on_wet_face = DeformableBody::follow_surface(reference_position, reach)) return on_wet_face;
  const std::optional<Vec3> foot = nearest_surface(self_->settings, self_->around.dimension, reference_position, reach);
  if (!foot) return {};
  return [this, point = locate(*foot)] { return read(point).position; };
}

}  // namespace undex::solid
