#include "coupling/face_impulses.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace undex::coupling {

FaceImpulses::FaceImpulses(const WetSurface& surface, std::vector<NamedFaces> faces)
    : faces_(std::move(faces)), owner_(surface.nodes.size(), -1), impulse_(faces_.size(), Vec3::Zero()) {
  std::vector<std::vector<Corner>> corners(surface.nodes.size());
  for (std::size_t k = 0; k < faces_.size(); ++k)
    for (std::size_t f = faces_[k].first; f < faces_[k].last; ++f)
      for (int node : surface.faces[f]) corners[std::size_t(node)].push_back({surface.faces[f], int(k)});
  for (std::size_t n = 0; n < corners.size(); ++n) {
    if (corners[n].empty()) continue;
    const int first = corners[n].front().named;
    const bool shared = std::any_of(corners[n].begin(), corners[n].end(), [&](const Corner& c) { return c.named != first; });
    if (shared) edges_.push_back({n, std::move(corners[n])});
    else owner_[n] = first;
  }
}

void FaceImpulses::book(std::span<const Vec3> impulse, std::span<const Vec3> position) {
  for (std::size_t n = 0; n < owner_.size(); ++n)
    if (owner_[n] >= 0) impulse_[std::size_t(owner_[n])] += impulse[n];
  for (const Edge& edge : edges_) {
    const auto area_of = [&](const Corner& corner) -> Vec3 {
      const std::array<Vec3, 4> x = corners_of(corner.face, position);
      return 0.125 * (x[2] - x[0]).cross(x[3] - x[1]);
    };
    Vec3 area = Vec3::Zero();
    double sum = 0;
    for (const Corner& corner : edge.corners) {
      area += area_of(corner);
      sum += area_of(corner).norm();
    }
    const Vec3& given = impulse[edge.node];
    const double pressure = area.norm() > 1e-6 * sum ? given.dot(area) / area.squaredNorm() : 0.0;  // times duration
    const Vec3 rest = given - pressure * area;
    for (const Corner& corner : edge.corners) {
      const Vec3 own = area_of(corner);
      impulse_[std::size_t(corner.named)] += pressure * own + own.norm() / sum * rest;
    }
  }
}

}  // namespace undex::coupling
