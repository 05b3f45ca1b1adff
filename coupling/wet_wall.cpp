#include "coupling/wet_wall.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/bilinear_patch.hpp"
#include "sph_fluid/lattice.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::coupling {

WetWall::WetWall(const WetSurface& surface, double spacing, double depth, const std::array<bool, 3>& symmetry)
    : surface_(surface), symmetry_(symmetry) {
  layers_ = std::size_t(std::max(3.0, std::ceil(depth / spacing - 1e-9)));
  const std::vector<Vec3> normal = node_normals(surface.faces, surface.nodes, symmetry);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const std::array<int, 4>& face = surface.faces[f];
    const std::array<Vec3, 4> flat = corners_of(face, surface.nodes);
    const auto edge = [&](int a, int b) { return (surface.nodes[face[a]] - surface.nodes[face[b]]).norm(); };
    const int along_u = std::max(1, int(std::lround(0.5 * (edge(0, 1) + edge(3, 2)) / spacing)));
    const int along_v = std::max(1, int(std::lround(0.5 * (edge(0, 3) + edge(1, 2)) / spacing)));
    for (std::size_t layer = 0; layer < layers_; ++layer) {
      const double d = (layer + 0.5) * spacing;
      std::array<Vec3, 4> corner;
      for (int c = 0; c < 4; ++c) corner[c] = flat[c] + d * normal[face[c]];
      for (int j = 0; j < along_v; ++j)
        for (int i = 0; i < along_u; ++i) {
          const double u = (i + 0.5) / along_u, v = (j + 0.5) / along_v;
          points_.push_back({int(f), d, bilinear_weights(u, v)});
          volume_.push_back(slope_along_u(corner, v).cross(slope_along_v(corner, u)).norm() / (along_u * along_v) * spacing);
        }
    }
  }
}

WetWall::WetWall(const WetSurface& surface, const sph::Settings& fluid)
    : WetWall(surface, fluid.lattice.spacing,
              sph::kernel_support(fluid.numerics.kernel) * sph::smoothing_length(fluid, fluid.lattice.spacing),
              fluid.symmetry.axis) {}

WallIndex WetWall::add_to(sph::Fluid& fluid, bool free_slip) const {
  if (free_slip && sph::mirrors_fluid(fluid.settings().numerics.scheme)) return fluid.add_wall(mesh());
  if (fluid.settings().axisymmetric)
    throw std::invalid_argument("coupling.slip: water slips along bodies of revolution; take true");
  return fluid.add_wall(particles(free_slip));
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

void WetWall::hand_on(const sph::MirrorWall&, std::span<const Vec3> on_points, std::vector<Vec3>& on_nodes) const {
  for (std::size_t n = 0; n < on_nodes.size(); ++n) on_nodes[n] += on_points[n];
}

void WetWall::hand_on(const sph::LinedWall&, std::span<const Vec3> on_points, std::vector<Vec3>& on_nodes) const {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    for (int c = 0; c < 4; ++c) on_nodes[surface_.faces[point.face][c]] += point.weight[c] * on_points[k];
  }
}

}  // namespace undex::coupling
