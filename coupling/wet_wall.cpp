#include "coupling/wet_wall.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bilinear_patch.hpp"

namespace undex::coupling {

WetWall::WetWall(const WetSurface& surface, double spacing, double depth, const std::array<bool, 3>& symmetry)
    : surface_(surface), symmetry_(symmetry) {
  layers_ = std::size_t(std::max(3.0, std::ceil(depth / spacing - 1e-9)));
  const std::vector<Vec3> normal = node_normals(surface.faces, surface.nodes, symmetry);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const std::array<int, 4>& face = surface.faces[f];
    const auto edge = [&](int a, int b) { return (surface.nodes[face[a]] - surface.nodes[face[b]]).norm(); };
    const int along_u = std::max(1, int(std::lround(0.5 * (edge(0, 1) + edge(3, 2)) / spacing)));
    const int along_v = std::max(1, int(std::lround(0.5 * (edge(0, 3) + edge(1, 2)) / spacing)));
    for (std::size_t layer = 0; layer < layers_; ++layer) {
      const double d = (layer + 0.5) * spacing;
      std::array<Vec3, 4> corner;
      for (int c = 0; c < 4; ++c) corner[c] = surface.nodes[face[c]] + d * normal[face[c]];
      for (int j = 0; j < along_v; ++j)
        for (int i = 0; i < along_u; ++i) {
          const double u = (i + 0.5) / along_u, v = (j + 0.5) / along_v;
          points_.push_back({int(f), d, bilinear_weights(u, v)});
          volume_.push_back(slope_along_u(corner, v).cross(slope_along_v(corner, u)).norm() / (along_u * along_v) * spacing);
        }
    }
  }
}

sph::MirrorWall WetWall::mesh() const {
  sph::MirrorWall wall;
  wall.faces = surface_.faces;
  wall.position = surface_.nodes;
  wall.velocity.assign(surface_.nodes.size(), Vec3::Zero());
  return wall;
}

sph::LinedWall WetWall::particles(bool free_slip) const {
  sph::LinedWall wall;
  wall.free_slip = free_slip;
  wall.volume = volume_;
  wall.faces = surface_.faces;
  for (auto* field : {&wall.position, &wall.velocity, &wall.normal, &wall.impulse}) field->assign(points_.size(), Vec3::Zero());
  const std::vector<Vec3> rest(surface_.nodes.size(), Vec3::Zero());
  move(surface_.nodes, rest, wall);
  return wall;
}

void WetWall::move(std::span<const Vec3> position, std::span<const Vec3> velocity, sph::MirrorWall& wall) const {
  wall.position.assign(position.begin(), position.end());
  wall.velocity.assign(velocity.begin(), velocity.end());
}

void WetWall::move(std::span<const Vec3> position, std::span<const Vec3> velocity, sph::LinedWall& wall) const {
  wall.node.assign(position.begin(), position.end());
  const std::vector<Vec3> normal = node_normals(surface_.faces, position, symmetry_);
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    const std::array<int, 4>& face = surface_.faces[point.face];
    const Vec3 n = blended(point.weight, face, normal);
    wall.position[k] = blended(point.weight, face, position) + point.depth * n;
    wall.velocity[k] = blended(point.weight, face, velocity);
    wall.normal[k] = n.normalized();
  }
}

void WetWall::collect_impulse(sph::MirrorWall& wall, std::vector<Vec3>& nodal_impulse) const {
  for (std::size_t n = 0; n < nodal_impulse.size(); ++n) nodal_impulse[n] += std::exchange(wall.impulse[n], Vec3::Zero());
}

void WetWall::collect_impulse(sph::LinedWall& wall, std::vector<Vec3>& nodal_impulse) const {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    for (int c = 0; c < 4; ++c) nodal_impulse[surface_.faces[point.face][c]] += point.weight[c] * wall.impulse[k];
    wall.impulse[k].setZero();
  }
}

}  // namespace undex::coupling
