#include "sph_fluid/walls/mirror_feet.hpp"

#include <omp.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/surface.hpp"
#include "sph_fluid/walls/reflection.hpp"

namespace undex::sph {
namespace {

/// Feet on one face.
class FaceSearch {
 public:
  FaceSearch(const BilinearPatch& patch, double beyond, unsigned open) : patch_(patch), beyond_(beyond), open_(open) {
    uu_ = middle_.foot_u.squaredNorm(), uv_ = middle_.foot_u.dot(middle_.foot_v), vv_ = middle_.foot_v.squaredNorm();
    determinant_ = uu_ * vv_ - uv_ * uv_;
    for (const Vec3& n : patch_.normal) lean_ = std::max(lean_, (n - middle_.normal).norm());
  }

  /// Calls visit(particle, its foot).
  template <class Visit>
  void find(const Particles& particles, const ParticleRange& range, Visit visit) const {
    Bounds box;
    for (int c = 0; c < 4; ++c) {
      box.include(patch_.corner[c] + beyond_ * patch_.normal[c]);
      box.include(patch_.corner[c] - range.depth * patch_.normal[c]);
    }
    // What normals that lean apart make of the face's sides at the end of its reach, beside its own curvature.
    double margin = 0.1 + lean_ * range.depth / std::sqrt(std::min(uu_, vv_));
    if (open_ != 0) {
      margin += range.depth / std::sqrt(std::min(uu_, vv_));
      box.low -= Vec3::Constant(range.depth), box.high += Vec3::Constant(range.depth);
    }
    for_each_in_cells(range.cells->view(), box.low.data(), box.high.data(), [&](std::uint32_t i) {
      const Vec3 x(particles.x[i], particles.y[i], particles.z[i]);
      PatchPoint at = guess(x);
      if (std::abs(at.u - 0.5) > 0.5 + margin || std::abs(at.v - 0.5) > 0.5 + margin) return;
      if (patch_.project(x, range.depth, at, std::max(3.0, 1.0 + margin)) && is_on_face(at, range.depth)) visit(i, at);
    });
  }

 private:
  /// As if the face were the plane through its middle.
  PatchPoint guess(const Vec3& x) const {
    const Vec3 away = x - middle_.foot;
    const double bu = away.dot(middle_.foot_u), bv = away.dot(middle_.foot_v);
    return {.u = 0.5 + (vv_ * bu - uv_ * bv) / determinant_,
            .v = 0.5 + (uu_ * bv - uv_ * bu) / determinant_,
            .distance = -away.dot(middle_.normal)};
  }
  bool is_on_face(const PatchPoint& at, double depth) const {
    constexpr double edge = 1e-7;
    const double along_u = edge + depth / std::sqrt(uu_), along_v = edge + depth / std::sqrt(vv_);
    const auto past = [&](int e) { return open_ >> e & 1 ? (e % 2 == 0 ? along_v : along_u) : edge; };
    if (at.u < -past(3) || at.u > 1 + past(1) || at.v < -past(0) || at.v > 1 + past(2)) return false;
    return at.distance > -beyond_ && at.distance < depth;
  }

  BilinearPatch patch_;
  double beyond_;
  unsigned open_;  // edges beyond which the face is drawn out
  BilinearPatch::Frame middle_ = patch_.frame(0.5, 0.5);
  double uu_, uv_, vv_, determinant_, lean_ = 0.0;
};

/// Of the face's nodes; beyond an open edge those on the edge.
std::array<double, 4> weights_of(const WallFoot& foot) {
  const auto kept = [](double a) { return a < -1e-6 ? 0.0 : a > 1.0 + 1e-6 ? 1.0 : a; };
  return bilinear_weights(kept(foot.at.u), kept(foot.at.v));
}

/// Feet on all faces of one wall, in no order.
std::vector<WallFoot> feet_on(int wall, int faces, const SeenMirrors& seen, const Particles& particles,
                              std::span<const ParticleRange> ranges, double beyond,
                              const std::function<unsigned(int, int)>& open) {
  std::vector<std::vector<WallFoot>> found(omp_get_max_threads());
#pragma omp parallel
  {
    std::vector<WallFoot>& mine = found[omp_get_thread_num()];
#pragma omp for schedule(static)
    for (int f = 0; f < faces; ++f) {
      const FaceSearch search(seen.patch(wall, f), beyond, open ? open(wall, f) : 0u);
      for (const ParticleRange& range : ranges)
        if (range.first < range.last && range.depth > 0.0)
          search.find(particles, range, [&](std::uint32_t i, const PatchPoint& at) {
            mine.push_back({.particle = i, .wall = wall, .face = f, .at = at});
          });
    }
  }
  std::vector<WallFoot> feet;
  for (const auto& part : found) feet.insert(feet.end(), part.begin(), part.end());
  return feet;
}

}  // namespace

SeenMirrors::SeenMirrors(const std::vector<MirrorWall>& walls, const std::vector<Footprint>& footprints,
                         const std::vector<Sheets>& sheets, const std::array<bool, 3>& symmetry, double spacing)
    : walls_(walls), sheets_(sheets), spacing_(spacing) {
  for (const MirrorWall& wall : walls) normal_.push_back(node_normals(wall.faces, wall.position, symmetry));
  see_velocities(footprints);
}

void SeenMirrors::see_velocities(const std::vector<Footprint>& footprints) {
  velocity_.clear();
  for (std::size_t w = 0; w < walls_.size(); ++w) velocity_.push_back(footprints[w].seen(walls_[w].velocity));
}

BilinearPatch SeenMirrors::patch(int wall, int face) const {
  BilinearPatch patch;
  const auto& nodes = walls_[wall].faces[face];
  patch.corner = corners_of(nodes, walls_[wall].position);
  for (int c = 0; c < 4; ++c) patch.normal[c] = normal_[wall][nodes[c]];
  sheets_[wall].part_normals(face, walls_[wall].faces, walls_[wall].position, patch.normal);
  return patch;
}

WallPoint SeenMirrors::point(const WallFoot& foot) const {
  const BilinearPatch::Frame frame = patch(foot.wall, foot.face).frame(foot.at.u, foot.at.v);
  const auto weight = weights_of(foot);
  const auto& nodes = walls_[foot.wall].faces[foot.face];
  Vec3 velocity = Vec3::Zero();
  for (int c = 0; c < 4; ++c) velocity += weight[c] * velocity_[foot.wall][nodes[c]];
  const std::vector<double>& lead = walls_[foot.wall].pressure;
  const int depths = int(lead.size() / walls_[foot.wall].position.size());
  double ahead = 0.0;
  for (int c = 0; c < 4 && depths > 0; ++c) {
    const auto [layer, share] = layer_of(foot.at.distance, spacing_, depths);
    const double* at = lead.data() + std::size_t(nodes[c]) * depths + layer;
    ahead += weight[c] * ((1.0 - share) * at[0] + share * at[1]);
  }
  const double here = frame.element(-foot.at.distance), there = frame.element(foot.at.distance);
  // Beyond the centre of curvature in front images are as large as they may be, beyond that behind as small.
  const double ratio = here > 0.0 ? std::max(there / here, 1e-6) : 0.0;
  return {.foot = frame.foot, .normal = frame.normal, .velocity = velocity, .stretch = image_volume(ratio), .lead = ahead};
}

bool SeenMirrors::face_each_other(const WallFoot& a, const WallFoot& b) const {
  const auto middle = [&](const WallFoot& foot) -> Vec3 {
    const auto x = corners_of(walls_[foot.wall].faces[foot.face], walls_[foot.wall].position);
    return 0.25 * (x[0] + x[1] + x[2] + x[3]);
  };
  const auto normal = [&](const WallFoot& foot) -> Vec3 {
    const auto x = corners_of(walls_[foot.wall].faces[foot.face], walls_[foot.wall].position);
    return (x[2] - x[0]).cross(x[3] - x[1]);
  };
  const Vec3 way = middle(b) - middle(a);
  return way.dot(normal(a)) < 0.0 && way.dot(normal(b)) > 0.0;
}

std::pair<int, double> layer_of(double distance, double spacing, int count) {
  const double at = std::clamp(distance / spacing - 0.5, 0.0, count - 1.0);
  const int layer = std::min(int(at), count - 2);
  return {layer, at - layer};
}

double clearance(const std::vector<MirrorWall>& walls, const Bounds& box) {
  double least = 1e300;
  for (const MirrorWall& wall : walls) {
    double longest = 0.0;
    for (const auto& face : wall.faces)  // of a segment both diagonals are its length
      longest = std::max({longest, (wall.position[face[0]] - wall.position[face[2]]).norm(),
                          (wall.position[face[1]] - wall.position[face[3]]).norm()});
    for (const Vec3& x : wall.position)
      least = std::min(least, (box.low - x).cwiseMax(x - box.high).cwiseMax(0.0).norm() - 0.5 * longest);
  }
  return std::max(least, 0.0);
}

std::vector<WallFoot> find_feet(const std::vector<MirrorWall>& walls, const SeenMirrors& seen, const Particles& particles,
                                std::span<const ParticleRange> ranges, double beyond,
                                const std::function<unsigned(int, int)>& open) {
  std::vector<WallFoot> feet;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const std::vector<WallFoot> more = feet_on(int(w), int(walls[w].faces.size()), seen, particles, ranges, beyond, open);
    feet.insert(feet.end(), more.begin(), more.end());
  }
  std::sort(feet.begin(), feet.end(), [](const WallFoot& a, const WallFoot& b) {
    return std::tie(a.particle, a.wall, a.face) < std::tie(b.particle, b.wall, b.face);
  });
  // On an edge of two faces both have found it.
  const auto same = [&](const WallFoot& a, const WallFoot& b) {
    if (a.particle != b.particle || a.wall != b.wall) return false;
    const WallPoint p = seen.point(a), q = seen.point(b);
    return (p.foot - q.foot).norm() < beyond && p.normal.dot(q.normal) > 0.0;  // a thin wall has its other face there
  };
  feet.erase(std::unique(feet.begin(), feet.end(), same), feet.end());
  return feet;
}

void add_at(const WallFoot& foot, const std::vector<MirrorWall>& walls, const Vec3& load, PointLoads& loads) {
  const auto weight = weights_of(foot);
  for (int c = 0; c < 4; ++c) loads[foot.wall][walls[foot.wall].faces[foot.face][c]] += weight[c] * load;
}

}  // namespace undex::sph
