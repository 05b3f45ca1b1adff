#include "sph_fluid/walls/wall_lining.hpp"

#include <algorithm>
#include <stdexcept>

#include "sph_fluid/lattice.hpp"
#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/walls/line_walls.hpp"

namespace undex::sph {

bool WallLining::waits(const Settings& settings, const std::vector<LinedWall>& moving) const {
  if (packed_ && moving.empty()) return false;
  return !settings.walls.empty() || !moving.empty();
}

void WallLining::mirror(const SlipFaces& faces, double depth, int dimension, std::size_t first, std::vector<Origin>& origins) {
  const auto add = [&](std::size_t k, const Reflection& image) {
    Origin copy = origins[k];
    const Mat3 before = copy.mirrored < 0 ? Mat3(Mat3::Identity()) : mirrors_[copy.mirrored];
    const Mat3 across = Mat3::Identity() - 2.0 * image.normal * image.normal.transpose();
    copy.mirrored = int(mirrors_.size());
    mirrors_.push_back(across * before);
    copy.place = image.place;
    origins.push_back(copy);
  };
  for (const SlipFaces::Round& wall : faces.round)
    for (std::size_t k = first, count = origins.size(); k < count; ++k)
      if (const auto image = image_in(wall, origins[k].place, depth, dimension)) add(k, *image);
  for (const SlipFaces::Pair& pair : faces.plane)
    for (std::size_t k = first, count = origins.size(); k < count; ++k) {
      const Vec3 place = origins[k].place;
      images_in(pair, place, depth, dimension, [&](const Reflection& image) { add(k, image); });
    }
}

void WallLining::pack(const Settings& settings, const std::vector<LinedWall>& moving, const SlipFaces& faces) {
  if (rigid_.empty()) rigid_ = line_walls(settings);
  std::vector<Origin> origin;
  const auto add = [&](const LinedWall& wall, int number) {
    for (std::size_t k = 0; k < wall.position.size(); ++k) origin.push_back({number, std::uint32_t(k), wall.position[k]});
  };
  mirrors_.clear();
  const double depth = kernel_support(settings.numerics.kernel) * smoothing_length(settings, settings.lattice.spacing);
  for (std::size_t w = 0; w < moving.size(); ++w) {
    const std::size_t first = origin.size();
    add(moving[w], int(w));
    mirror(faces, depth, settings.dimension, first, origin);
  }
  for (std::size_t w = 0; w < rigid_.size(); ++w) add(rigid_[w], -1 - int(w));
  const std::uint32_t n = std::uint32_t(origin.size());
  if (settings.axisymmetric && n > 0)
    throw std::invalid_argument("the fluid slips along walls of revolution: take free_slip for every face");
  std::vector<double> place[3];
  for (int a = 0; a < 3; ++a)
    for (const Origin& o : origin) place[a].push_back(o.place[a]);
  cells_.build(place[0].data(), place[1].data(), place[2].data(), 0, n, 2.0 * settings.lattice.spacing);
  origin_.resize(n);
  for (auto& axis : place_) axis.resize(n);
  rows_.resize(n);
  behind_surface_.resize(n);
  force_.resize(moving.empty() ? 0 : n);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Origin& o = origin_[k] = origin[cells_.order()[k]];
    const LinedWall& wall = o.wall >= 0 ? moving[o.wall] : rigid_[-1 - o.wall];
    const Vec3& x = o.place;
    Vec3 v = wall.velocity[o.point], normal = wall.normal[o.point];
    if (o.mirrored >= 0) v = mirrors_[o.mirrored] * v, normal = mirrors_[o.mirrored] * normal;
    for (int a = 0; a < 3; ++a) place_[a][k] = x[a];
    behind_surface_[k] = !wall.faces.empty();
    rows_[k] = {.vx = v[0],
                .vy = v[1],
                .vz = v[2],
                .nx = normal[0],
                .ny = normal[1],
                .nz = normal[2],
                .volume = wall.volume[o.point],
                .slip = wall.slip(o.point)};
  }
  if (moving.empty()) rigid_ = {};
  packed_ = true;
}

void WallLining::describe(PairInput& in) const {
  in.wall_x = place_[0].data();
  in.wall_y = place_[1].data();
  in.wall_z = place_[2].data();
  in.wall = rows_.data();
  in.wall_count = std::uint32_t(origin_.size());
  if (in.wall_count > 0) in.wall_grid = cells_.view();
}

void WallLining::clear_forces() { std::fill(force_.begin(), force_.end(), ForceRow{}); }

double WallLining::scatter(PointLoads& force) const {
  double power = 0;
  for (std::size_t k = 0; k < origin_.size(); ++k) {
    const Origin& o = origin_[k];
    if (o.wall < 0) continue;
    const ForceRow& f = force_[k];
    const WallRow& w = rows_[k];
    const Vec3 given(f.fx, f.fy, f.fz);
    force[o.wall][o.point] += o.mirrored < 0 ? given : Vec3(mirrors_[o.mirrored].transpose() * given);
    power += f.fx * w.vx + f.fy * w.vy + f.fz * w.vz;
  }
  return power;
}

bool WallLining::reaches(const Vec3& low, const Vec3& high, double reach) const {
  for (std::size_t k = 0; k < origin_.size(); ++k) {
    const Vec3 x(place_[0][k], place_[1][k], place_[2][k]);
    if ((low - x).cwiseMax(x - high).cwiseMax(0.0).norm() < reach) return true;
  }
  return false;
}

std::size_t WallLining::memory_bytes() const {
  return behind_surface_.capacity() + origin_.capacity() * (sizeof(Origin) + 3 * sizeof(double)) +
         rows_.capacity() * sizeof(WallRow) + force_.capacity() * sizeof(ForceRow) + cells_.memory_bytes();
}

}  // namespace undex::sph
