#include "sph_fluid/walls/wall_images.hpp"

#include <omp.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/surface.hpp"
#include "sph_fluid/lattice.hpp"

namespace undex::sph {
namespace {

constexpr std::array<std::pair<int, int>, 6> packed = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// R S R of a symmetric matrix (xx, yy, zz, xy, yz, zx).
void mirror_symmetric(float* s, const Vec3& n) {
  Mat3 matrix;
  for (int k = 0; k < 6; ++k) matrix(packed[k].first, packed[k].second) = matrix(packed[k].second, packed[k].first) = s[k];
  const Vec3 sn = matrix * n;
  const double nsn = n.dot(sn);
  matrix += 4.0 * nsn * n * n.transpose() - 2.0 * (n * sn.transpose() + sn * n.transpose());
  for (int k = 0; k < 6; ++k) s[k] = float(matrix(packed[k].first, packed[k].second));
}

Vec3 mirrored(const Vec3& a, const Vec3& n) { return a - 2.0 * a.dot(n) * n; }

void mirror(FluidRow& row, const Vec3& n, const Vec3& wall_velocity, double stretch) {
  const Vec3 v = mirrored(Vec3(row.vx, row.vy, row.vz), n) + 2.0 * wall_velocity.dot(n) * n;
  row.vx = v[0], row.vy = v[1], row.vz = v[2];
  row.volume *= stretch;
}

void mirror(GradientRow& row, const Vec3& n) {
  mirror_symmetric(row.strain, n);
  const Vec3 p = mirrored(Vec3(row.pressure[0], row.pressure[1], row.pressure[2]), n);
  for (int a = 0; a < 3; ++a) row.pressure[a] = float(p[a]);
}

void mirror(CorrectedRow& row, const Vec3& n) {
  mirror(row.gradient, n);
  mirror_symmetric(row.correction, n);
}

/// An image's share of its particle's volume from the ratio of volume elements behind and in front of the wall, which is
/// 1 + 4 H s to first order at the distance s from a wall of mean curvature H. With a volume stretched by 1 + g H s the pairs
/// (i, images) and (image of i, particles) press on i with w (1 + H s) + (g - 4) H Q and w (1 + (g - 1) H s), where w(s) is the
/// kernel's integral over a plane and Q that of w from s on. Their mean must be w (1 + H s), what a fluid that goes on behind the
/// wall would do. The integrals over s of s w and Q are equal, so the layer as a whole is in balance with g = 3.
double image_volume(double ratio) {
  // Near the centre of the curvature, or beyond it, ratios say nothing.
  return std::pow(ratio > 0.1 ? std::min(ratio, 10.0) : ratio > 0.0 ? 0.1 : 10.0, 0.75);
}

/// A particle's mirror image in one wall.
struct Reflection {
  Vec3 place, normal;
  double stretch = 1.0;
};

/// The image in a round wall: false beyond reach.
bool reflect(const Cylinder& wall, const Vec3& x, double depth, int dimension, Reflection& image) {
  if (dimension == 3 && (x[wall.axis] < wall.low - depth || x[wall.axis] > wall.high + depth)) return false;
  Vec3 away = x - wall.center;
  away[wall.axis] = 0.0;
  const double r = away.norm();
  if (r <= wall.radius - depth || r > wall.radius) return false;
  image.normal = away / r;
  const double behind = 2.0 * wall.radius - r;
  image.place = x + (behind - r) * image.normal;
  image.stretch = image_volume(behind / r);
  return true;
}

/// Calls visit for all images between and behind the faces of a pair.
template <class Visit>
void reflect(const SlipFaces::Pair& faces, const Vec3& x, double depth, int dimension, Visit visit) {
  const double at = x[faces.axis];
  if (at - faces.low >= depth && faces.high - at >= depth) return;  // most
  if (at < faces.low || at > faces.high) return;
  for (int a = 0; a < dimension; ++a)
    if (a != faces.axis && (x[a] < faces.window.low[a] - depth || x[a] > faces.window.high[a] + depth)) return;
  const bool both = faces.low > -1e299 && faces.high < 1e299;
  const auto offer = [&](double place, bool odd) {
    if (place <= faces.low - depth || place >= faces.high + depth) return false;
    if (faces.symmetric && place < faces.low) return true;
    Reflection image{x, Vec3::Zero(), 1.0};
    image.place[faces.axis] = place;
    if (odd) image.normal[faces.axis] = 1.0;
    visit(image);
    return true;
  };
  if (!both) {
    offer(2.0 * (faces.low > -1e299 ? faces.low : faces.high) - at, true);
    return;
  }
  // A series on either side: each image of the last in the other face.
  for (int side = 0; side < 2; ++side) {
    double place = at;
    bool odd = true;
    for (int k = 0;; ++k, odd = !odd) {
      place = 2.0 * ((k + side) % 2 == 0 ? faces.low : faces.high) - place;
      if (!offer(place, odd)) break;
    }
  }
}

std::array<double, 4> shape(double u, double v) { return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v}; }

/// A face's surface and the space about it: x(u, v, s) = foot - s normal.
struct Patch {
  std::array<Vec3, 4> x, n;

  Patch(const MovingWall& wall, const std::vector<Vec3>& normals, int face) {
    for (int c = 0; c < 4; ++c) x[c] = wall.position[wall.mesh[face][c]], n[c] = normals[wall.mesh[face][c]];
  }
  static Vec3 at(const std::array<Vec3, 4>& a, double u, double v) {
    const auto w = shape(u, v);
    return w[0] * a[0] + w[1] * a[1] + w[2] * a[2] + w[3] * a[3];
  }
  static Vec3 along_u(const std::array<Vec3, 4>& a, double v) { return (1 - v) * (a[1] - a[0]) + v * (a[2] - a[3]); }
  static Vec3 along_v(const std::array<Vec3, 4>& a, double u) { return (1 - u) * (a[3] - a[0]) + u * (a[2] - a[1]); }

  /// Foot, normal and the derivatives of foot and normal.
  struct Frame {
    Vec3 foot, normal, foot_u, foot_v, normal_u, normal_v;

    /// Volume element a distance behind the surface (in front of it: negative).
    double element(double behind) const { return (foot_u + behind * normal_u).cross(foot_v + behind * normal_v).dot(normal); }
  };
  Frame frame(double u, double v) const {
    Frame f;
    f.foot = at(x, u, v), f.foot_u = along_u(x, v), f.foot_v = along_v(x, u);
    const Vec3 blend = at(n, u, v), blend_u = along_u(n, v), blend_v = along_v(n, u);
    const double length = blend.norm();
    f.normal = blend / length;
    f.normal_u = (blend_u - f.normal.dot(blend_u) * f.normal) / length;
    f.normal_v = (blend_v - f.normal.dot(blend_v) * f.normal) / length;
    return f;
  }

  /// Solves x(u, v, s) = place from the guess in `foot` by Newton's method. False where that does not end.
  bool project(const Vec3& place, double size, Foot& foot) const {
    for (int k = 0; k < 8; ++k) {
      const Frame f = frame(foot.u, foot.v);
      const Vec3 miss = place - (f.foot - foot.distance * f.normal);
      Mat3 jacobian;
      jacobian << f.foot_u - foot.distance * f.normal_u, f.foot_v - foot.distance * f.normal_v, -f.normal;
      const Vec3 step = jacobian.inverse() * miss;
      foot.u += step[0], foot.v += step[1], foot.distance += step[2];
      if (!(std::abs(foot.u - 0.5) < 3.0 && std::abs(foot.v - 0.5) < 3.0)) return false;
      if (std::abs(step[0]) + std::abs(step[1]) < 1e-10 && std::abs(step[2]) < 1e-10 * size) return true;
    }
    return false;
  }
};

/// What walls are at a particle's foot.
struct WallPoint {
  Vec3 foot, normal, velocity;
  double stretch;
};

WallPoint wall_point(const std::vector<MovingWall>& moving, const std::vector<std::vector<Vec3>>& normals,
                     const std::vector<std::vector<Vec3>>& velocities, const Foot& foot) {
  const MovingWall& wall = moving[foot.wall];
  const Patch::Frame frame = Patch(wall, normals[foot.wall], foot.face).frame(foot.u, foot.v);
  const auto w = shape(foot.u, foot.v);
  const auto& face = wall.mesh[foot.face];
  Vec3 velocity = Vec3::Zero();
  for (int c = 0; c < 4; ++c) velocity += w[c] * velocities[foot.wall][face[c]];
  const double here = frame.element(-foot.distance), there = frame.element(foot.distance);
  return {frame.foot, frame.normal, velocity, image_volume(here > 0.0 ? there / here : 0.0)};
}

}  // namespace

SlipFaces slip_faces(const Settings& settings) {
  SlipFaces result;
  if (!mirrors_fluid(settings.numerics.scheme)) return result;
  for (const Wall& wall : settings.walls) {
    const auto slips = [&](const std::string& face) {
      const auto found = wall.faces.find(face);
      return found == wall.faces.end() || found->second == FaceCondition::free_slip;
    };
    const Bounds window = bounds(wall.container, settings.dimension);
    const auto add = [&](int axis, const std::string& low, const std::string& high) {
      // A symmetry plane stands in for what it cuts off.
      const bool cut = settings.symmetry.axis[axis] && window.low[axis] <= 0.0;
      const bool with_low = slips(low) && !cut, with_high = slips(high);
      if (with_low || with_high)
        result.plane.push_back({axis,
                                cut        ? 0.0
                                : with_low ? window.low[axis]
                                           : -1e300,
                                with_high ? window.high[axis] : 1e300, cut, window});
    };
    if (const auto* cylinder = std::get_if<Cylinder>(&wall.container)) {
      if (slips("side")) result.round.push_back(*cylinder);
      if (settings.dimension == 3) add(cylinder->axis, "low", "high");
    } else {
      for (int a = 0; a < settings.dimension; ++a) {
        const std::string name(1, "xyz"[a]);
        add(a, name + "_low", name + "_high");
      }
    }
  }
  return result;
}

double clearance(const SlipFaces& faces, const std::vector<MovingWall>& moving, const Bounds& box) {
  double least = 1e300;
  for (const SlipFaces::Pair& pair : faces.plane)
    least = std::min({least, pair.symmetric ? 1e300 : box.low[pair.axis] - pair.low, pair.high - box.high[pair.axis]});
  for (const Cylinder& wall : faces.round) {
    Vec3 away = (box.low - wall.center).cwiseAbs().cwiseMax((box.high - wall.center).cwiseAbs());
    away[wall.axis] = 0.0;
    least = std::min(least, wall.radius - away.norm());
  }
  for (const MovingWall& wall : moving) {
    double longest = 0.0;
    for (const auto& face : wall.mesh)
      longest = std::max({longest, (wall.position[face[0]] - wall.position[face[2]]).norm(),
                          (wall.position[face[1]] - wall.position[face[3]]).norm()});
    if (wall.mesh.empty()) continue;
    for (const Vec3& x : wall.position)
      least = std::min(least, (box.low - x).cwiseMax(x - box.high).cwiseMax(0.0).norm() - 0.5 * longest);
  }
  return std::max(least, 0.0);
}

void WallImages::find_feet(const Settings& settings, const std::vector<MovingWall>& moving, const Particles& particles,
                           std::span<const Range> ranges) {
  normals_.resize(moving.size());
  velocities_.resize(moving.size());
  while (footprints_.size() < moving.size()) {
    const MovingWall& wall = moving[footprints_.size()];
    footprints_.emplace_back(wall.mesh, wall.position, smoothing_length(settings, settings.lattice.spacing),
                             settings.symmetry.axis);
  }
  feet_.clear();
  const double beyond = 0.5 * settings.lattice.spacing;
  for (std::size_t w = 0; w < moving.size(); ++w) {
    const MovingWall& wall = moving[w];
    normals_[w].clear();
    if (wall.mesh.empty()) continue;
    normals_[w] = node_normals(wall.mesh, wall.position, settings.symmetry.axis);
    velocities_[w] = footprints_[w].seen(wall.velocity);
    std::vector<std::vector<Foot>> found(omp_get_max_threads());
#pragma omp parallel
    {
      std::vector<Foot>& mine = found[omp_get_thread_num()];
#pragma omp for schedule(static)
      for (int f = 0; f < int(wall.mesh.size()); ++f) {
        const Patch patch(wall, normals_[w], f);
        const Patch::Frame middle = patch.frame(0.5, 0.5);
        const double uu = middle.foot_u.squaredNorm(), uv = middle.foot_u.dot(middle.foot_v), vv = middle.foot_v.squaredNorm();
        const double determinant = uu * vv - uv * uv;
        double lean = 0.0;
        for (const Vec3& n : patch.n) lean = std::max(lean, (n - middle.normal).norm());
        for (const Range& range : ranges) {
          if (range.first == range.last || range.depth <= 0.0) continue;
          Bounds box;
          for (int c = 0; c < 4; ++c) {
            box.include(patch.x[c] + beyond * patch.n[c]);
            box.include(patch.x[c] - range.depth * patch.n[c]);
          }
          // What normals that lean apart make of the face's sides at the end of its reach, beside its own curvature.
          const double margin = 0.1 + lean * range.depth / std::sqrt(std::min(uu, vv));
          const CellGrid grid = range.cells->view();
          int first[3], last[3];
          bool apart = false;
          for (int a = 0; a < 3; ++a) {
            apart = apart || box.low[a] > grid.bound_high[a] || box.high[a] < grid.bound_low[a];
            first[a] = int(std::clamp((box.low[a] - grid.low[a]) / grid.size[a], 0.0, grid.count[a] - 1.0));
            last[a] = int(std::clamp((box.high[a] - grid.low[a]) / grid.size[a], 0.0, grid.count[a] - 1.0));
          }
          if (apart) continue;
          for (int iz = first[2]; iz <= last[2]; ++iz)
            for (int iy = first[1]; iy <= last[1]; ++iy) {
              const std::uint32_t* row = grid.start + (std::size_t(iz) * grid.count[1] + iy) * grid.count[0];
              for (std::uint32_t i = row[first[0]]; i < row[last[0] + 1]; ++i) {
                const Vec3 x(particles.x[i], particles.y[i], particles.z[i]), away = x - middle.foot;
                const double bu = away.dot(middle.foot_u), bv = away.dot(middle.foot_v);
                Foot foot{i,
                          int(w),
                          f,
                          0.5 + (vv * bu - uv * bv) / determinant,
                          0.5 + (uu * bv - uv * bu) / determinant,
                          -away.dot(middle.normal)};
                if (std::abs(foot.u - 0.5) > 0.5 + margin || std::abs(foot.v - 0.5) > 0.5 + margin) continue;
                if (!patch.project(x, range.depth, foot)) continue;
                constexpr double edge = 1e-7;
                if (foot.u < -edge || foot.u > 1 + edge || foot.v < -edge || foot.v > 1 + edge) continue;
                if (foot.distance <= -beyond || foot.distance >= range.depth) continue;
                mine.push_back(foot);
              }
            }
        }
      }
    }
    for (const auto& part : found) feet_.insert(feet_.end(), part.begin(), part.end());
  }
  std::sort(feet_.begin(), feet_.end(), [](const Foot& a, const Foot& b) {
    return std::tie(a.particle, a.wall, a.face) < std::tie(b.particle, b.wall, b.face);
  });
  // On an edge of two faces both have found it.
  const auto same = [&](const Foot& a, const Foot& b) {
    const auto place = [&](const Foot& f) { return wall_point(moving, normals_, velocities_, f).foot; };
    return a.particle == b.particle && a.wall == b.wall && (place(a) - place(b)).norm() < beyond;
  };
  feet_.erase(std::unique(feet_.begin(), feet_.end(), same), feet_.end());
}

void WallImages::build(const Settings& settings, const SlipFaces& faces, const std::vector<MovingWall>& moving,
                       const Particles& particles, std::span<const Range> ranges) {
  find_feet(settings, moving, particles, ranges);
  images_.clear();
  begin_.assign(1, 0);
  cells_.resize(ranges.size());
  std::vector<double> place[3];
  const bool any = !feet_.empty() || !faces.round.empty() || !faces.plane.empty();
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    const std::uint32_t start = std::uint32_t(images_.size());
    const double depth = ranges[r].depth;
    if (any && depth > 0.0) {
      std::vector<std::vector<Image>> found(omp_get_max_threads());
#pragma omp parallel
      {
        std::vector<Image>& mine = found[omp_get_thread_num()];
#pragma omp for schedule(static)
        for (std::uint32_t i = ranges[r].first; i < ranges[r].last; ++i) {
          const Vec3 x(particles.x[i], particles.y[i], particles.z[i]);
          const std::size_t mark = mine.size();
          const auto each = [&](auto visit) {  // the particle and the images that it has so far
            const std::size_t count = mine.size();
            visit(x, -1);
            for (std::size_t k = mark; k < count; ++k) visit(Vec3(mine[k].place), int(k - mark));
          };
          const auto add = [&](const Reflection& image, int parent) {
            mine.push_back({i, parent, -1, image.stretch, image.place, image.normal, Vec3::Zero()});
          };
          auto foot =
              std::lower_bound(feet_.begin(), feet_.end(), i, [](const Foot& a, std::uint32_t k) { return a.particle < k; });
          for (; foot != feet_.end() && foot->particle == i; ++foot) {
            if (foot->distance <= 0.0) continue;
            const WallPoint wall = wall_point(moving, normals_, velocities_, *foot);
            mine.push_back({i, -1, int(foot - feet_.begin()), wall.stretch, wall.foot + foot->distance * wall.normal, wall.normal,
                            wall.velocity});
          }
          for (const Cylinder& wall : faces.round)
            each([&](const Vec3& at, int parent) {
              if (Reflection image; reflect(wall, at, depth, settings.dimension, image)) add(image, parent);
            });
          for (const SlipFaces::Pair& pair : faces.plane)
            each([&](const Vec3& at, int parent) {
              reflect(pair, at, depth, settings.dimension, [&](const Reflection& image) { add(image, parent); });
            });
          // Parents are counted from the range's first image once all threads are done.
          for (std::size_t k = mark; k < mine.size(); ++k)
            if (mine[k].parent >= 0) mine[k].parent += int(mark);
        }
      }
      for (const auto& part : found) {
        const int before = int(images_.size());
        for (Image image : part) {
          if (image.parent >= 0) image.parent += before;
          images_.push_back(image);
        }
      }
    }
    const std::uint32_t end = std::uint32_t(images_.size());
    for (int a = 0; a < 3; ++a) {
      place[a].resize(end);
      for (std::uint32_t k = start; k < end; ++k) place[a][k] = images_[k].place[a];
    }
    cells_[r].build(place[0].data(), place[1].data(), place[2].data(), start, end, ranges[r].width);
    begin_.push_back(end);
    slot_.resize(end);
    for (auto* a : {&x_, &y_, &z_}) a->resize(end);
    const auto& order = cells_[r].order();
    for (std::uint32_t s = start; s < end; ++s) {
      const std::uint32_t c = order[s - start];
      slot_[c] = s;
      x_[s] = place[0][c], y_[s] = place[1][c], z_[s] = place[2][c];
    }
  }
}

double WallImages::put_back(const Settings& settings, const SlipFaces& faces, const std::vector<MovingWall>& moving,
                            Particles& particles, std::vector<std::vector<Vec3>>& received) const {
  const auto turn = [&](std::size_t i, const Vec3& place, const Vec3& normal, const Vec3& foot, const Vec3& wall_velocity) {
    const double speed = wall_velocity.dot(normal);
    for_each_vector(particles, i, [&](Vector kind, auto& a, auto& b, auto& c) {
      const double offset = kind == Vector::place ? foot.dot(normal) : kind == Vector::velocity ? speed : 0.0;
      const Vec3 image = mirrored(Vec3(a, b, c), normal) + 2.0 * offset * normal;
      using Number = std::remove_reference_t<decltype(a)>;
      a = Number(image[0]), b = Number(image[1]), c = Number(image[2]);
    });
    particles.x[i] = place[0], particles.y[i] = place[1], particles.z[i] = place[2];
  };
  double work = 0;
  std::vector<std::vector<Vec3>> normals(moving.size()), velocities(moving.size()), given(moving.size());
  for (std::size_t w = 0; w < moving.size() && !feet_.empty(); ++w) {  // walls may have moved since
    if (moving[w].mesh.empty()) continue;
    normals[w] = node_normals(moving[w].mesh, moving[w].position, settings.symmetry.axis);
    velocities[w] = footprints_[w].seen(moving[w].velocity);
    given[w].assign(moving[w].position.size(), Vec3::Zero());
  }
  for (const Foot& last : feet_) {
    const std::uint32_t i = last.particle;
    Foot foot = last;
    const Vec3 x(particles.x[i], particles.y[i], particles.z[i]);
    if (foot.distance > settings.lattice.spacing) continue;  // farther than a step can take it
    if (!Patch(moving[foot.wall], normals[foot.wall], foot.face).project(x, settings.lattice.spacing, foot)) continue;
    if (foot.distance >= 0.0) continue;
    const WallPoint wall = wall_point(moving, normals, velocities, foot);
    const Vec3 before(particles.vx[i], particles.vy[i], particles.vz[i]);
    turn(i, wall.foot + foot.distance * wall.normal, wall.normal, wall.foot, wall.velocity);
    const Vec3 lost = particles.mass[i] * (before - Vec3(particles.vx[i], particles.vy[i], particles.vz[i]));
    work += lost.dot(wall.velocity);
    const auto weight = shape(foot.u, foot.v);
    for (int c = 0; c < 4; ++c) given[foot.wall][moving[foot.wall].mesh[foot.face][c]] += weight[c] * lost;
  }
  for (std::size_t w = 0; w < moving.size(); ++w)
    if (!given[w].empty()) footprints_[w].hand_on(given[w], received[w]);
  if (faces.round.empty() && faces.plane.empty()) return work;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double far = 3.0 * settings.lattice.spacing;  // beyond that it is not this wall's
    const auto place = [&] { return Vec3(particles.x[i], particles.y[i], particles.z[i]); };
    for (const Cylinder& wall : faces.round) {
      const Vec3 x = place();
      if (settings.dimension == 3 && (x[wall.axis] < wall.low - far || x[wall.axis] > wall.high + far)) continue;
      Vec3 away = x - wall.center;
      away[wall.axis] = 0.0;
      const double r = away.norm();
      if (r <= wall.radius || r > wall.radius + far) continue;
      const Vec3 normal = away / r, foot = x - (r - wall.radius) * normal;
      turn(i, foot - (r - wall.radius) * normal, normal, foot, Vec3::Zero());
    }
    for (const SlipFaces::Pair& pair : faces.plane) {
      Vec3 x = place();
      if ((x[pair.axis] >= pair.low || pair.symmetric) && x[pair.axis] <= pair.high) continue;  // nearly all
      bool beside = false;
      for (int a = 0; a < settings.dimension; ++a)
        beside = beside || (a != pair.axis && (x[a] < pair.window.low[a] - far || x[a] > pair.window.high[a] + far));
      const double at = x[pair.axis], face = at < pair.low ? pair.low : pair.high;
      if (beside || std::abs(at - face) > far) continue;
      Vec3 normal = Vec3::Zero(), foot = x;
      normal[pair.axis] = 1.0;
      foot[pair.axis] = face;
      x[pair.axis] = 2.0 * face - at;
      turn(i, x, normal, foot, Vec3::Zero());
    }
  }
  return work;
}

void WallImages::forget() {
  feet_.clear();
  images_.clear();
  begin_.clear();
}

void WallImages::mirror_rows(const Particles& particles) {
  rows_.resize(images_.size());
  viscosity_.resize(particles.viscosity.empty() ? 0 : images_.size());
  gradients_.resize(particles.gradient.empty() ? 0 : images_.size());
  corrected_.resize(particles.corrected.empty() ? 0 : images_.size());
  sums_.assign(images_.size(), SumRow{});
#pragma omp parallel for schedule(static)
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    // The chain of mirrors, from the particle to this image.
    int chain[8], length = 0;
    for (int k = int(c); k >= 0 && length < 8; k = images_[k].parent) chain[length++] = k;
    FluidRow row = particles.predicted[images_[c].owner];
    while (length-- > 0) {
      const Image& image = images_[chain[length]];
      mirror(row, image.normal, image.wall_velocity, image.stretch);
    }
    rows_[slot_[c]] = row;
    if (!viscosity_.empty()) viscosity_[slot_[c]] = particles.viscosity[images_[c].owner];
  }
}

void WallImages::mirror_gradients(const Particles& particles) {
  if (gradients_.empty() && corrected_.empty()) return;
#pragma omp parallel for schedule(static)
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    int chain[8], length = 0;
    for (int k = int(c); k >= 0 && length < 8; k = images_[k].parent) chain[length++] = k;
    const auto through = [&](auto row) {
      for (int k = length; k-- > 0;) mirror(row, images_[chain[k]].normal);
      return row;
    };
    if (!gradients_.empty()) gradients_[slot_[c]] = through(particles.gradient[images_[c].owner]);
    if (!corrected_.empty()) corrected_[slot_[c]] = through(particles.corrected[images_[c].owner]);
  }
}

double WallImages::hand_back(Particles& particles, const std::vector<MovingWall>& moving, std::vector<std::vector<Vec3>>& force) {
  std::vector<Vec3> on_wall(images_.size());
#pragma omp parallel for schedule(static)
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    const std::uint32_t owner = images_[c].owner;
    if (c > 0 && images_[c - 1].owner == owner) continue;
    std::uint32_t end = c + 1;
    while (end < images_.size() && images_[end].owner == owner) ++end;
    for (std::uint32_t k = end; k-- > c;) {
      const Image& image = images_[k];
      const SumRow& given = sums_[slot_[k]];
      const Vec3 f(given.fx, given.fy, given.fz), back = image.stretch * mirrored(f, image.normal);
      on_wall[k] = rows_[slot_[k]].volume * 2.0 * f.dot(image.normal) * image.normal;
      SumRow& to = image.parent < 0 ? particles.rate[owner] : sums_[slot_[image.parent]];
      to.fx += back[0], to.fy += back[1], to.fz += back[2];
      to.compression += image.stretch * given.compression;
      to.heat += image.stretch * given.heat;
      to.closing = std::max(to.closing, given.closing);
    }
  }
  double power = 0;
  std::vector<std::vector<Vec3>> given(moving.size());
  for (std::size_t w = 0; w < moving.size(); ++w)
    if (!moving[w].mesh.empty()) given[w].assign(moving[w].position.size(), Vec3::Zero());
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    if (images_[c].foot < 0) continue;
    const Foot& foot = feet_[images_[c].foot];
    const auto weight = shape(foot.u, foot.v);
    for (int k = 0; k < 4; ++k) given[foot.wall][moving[foot.wall].mesh[foot.face][k]] += weight[k] * on_wall[c];
    power += on_wall[c].dot(images_[c].wall_velocity);
  }
  for (std::size_t w = 0; w < moving.size(); ++w)
    if (!given[w].empty()) footprints_[w].hand_on(given[w], force[w]);
  return power;
}

void WallImages::describe(PairInput& in) const {
  const void* second = !gradients_.empty()   ? static_cast<const void*>(gradients_.data())
                       : !corrected_.empty() ? static_cast<const void*>(corrected_.data())
                                             : viscosity_.data();
  in.images = {.x = x_.data(), .y = y_.data(), .z = z_.data(), .fluid = rows_.data(), .second = second};
}

std::size_t WallImages::memory_bytes() const {
  std::size_t bytes = feet_.capacity() * sizeof(Foot) + images_.capacity() * sizeof(Image) + slot_.capacity() * sizeof(slot_[0]) +
                      (x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(double) + rows_.capacity() * sizeof(FluidRow) +
                      gradients_.capacity() * sizeof(GradientRow) + corrected_.capacity() * sizeof(CorrectedRow) +
                      viscosity_.capacity() * sizeof(ViscosityRow) + sums_.capacity() * sizeof(SumRow);
  for (const CellList& cells : cells_) bytes += cells.memory_bytes();
  return bytes;
}

}  // namespace undex::sph
