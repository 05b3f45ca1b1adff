#include "core/deformable_body.hpp"

#include "core/bilinear_patch.hpp"

namespace undex {

void scatter_to_carriers(const BodyPoint& point, const Vec3& given, std::vector<Vec3>& to) {
  for (const auto& [carrier, weight, image] : point.motion) to[carrier] += weight * mirrored(given, image);
}

BodyLedger& BodyLedger::operator+=(const BodyLedger& other) {
  kinetic += other.kinetic;
  elastic += other.elastic;
  plastic += other.plastic;
  viscous += other.viscous;
  impact += other.impact;
  received += other.received;
  external += other.external;
  gravity += other.gravity;
  integrator += other.integrator;
  mass += other.mass;
  momentum += other.momentum;
  impulse += other.impulse;
  angular_momentum += other.angular_momentum;
  return *this;
}

std::function<Vec3()> DeformableBody::follow_surface(const Vec3& reference_position, double reach) const {
  const WetSurface& surface = wet_surface();
  if (surface.faces.empty()) return {};
  const SurfaceFoot foot = nearest_foot(surface, reference_position);
  if (foot.distance > reach) return {};
  return [this, foot, face = surface.faces[foot.face]] { return blended(foot.weight, face, wet_positions()); };
}

}  // namespace undex
