#include "sph_fluid/lattice_rings.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/descent.hpp"
#include "sph_fluid/lattice_grid.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/pairs/kernels.hpp"

namespace undex::sph {
namespace {

constexpr double goal = 1e-4;  // of |g| h
constexpr int most_steps = 300;

Eigen::Vector2d on_circle(long ring, long q, double width) {
  const double r = (ring + 0.5) * width, angle = 2.0 * std::numbers::pi * (q + 0.5) / ring_count(r, width);
  return r * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// The points of a quadrant, and what pairs with all others do to them.
class Quadrant {
 public:
  Quadrant(const Settings& settings, double radius, double width, double layer) : radius_(radius), layer_(layer) {
    const Numerics& numerics = settings.numerics;
    h_ = numerics.eta * width;
    with_kernel(numerics.kernel, [&](auto kernel) {
      using K = decltype(kernel);
      reach_ = K::support * h_;
      layers_ = settings.dimension == 3 ? int(reach_ / layer) : 0;
      const double norm = K::norm(settings.dimension) / std::pow(h_, settings.dimension + 2);
      slope_ = [norm, h = h_](double r) { return norm * slope_of<K>(r / h); };
    });
    const long rings = std::lround(radius / width);
    for (long ring = 0; ring < rings; ++ring) {
      const double r = (ring + 0.5) * width;
      const long around = ring_count(r, width);
      for (long q = 0; q < around / 4; ++q) {
        const Eigen::Vector2d x = on_circle(ring, q, width);
        place.emplace_back(x[0], x[1], 0.0);
        volume_.push_back(2.0 * std::numbers::pi * r * width * (settings.dimension == 3 ? layer : 1.0) / around);
      }
    }
  }

  std::vector<Vec3> place;

  /// -g h^2 of each [m].
  std::vector<Vec3> forces() {
    const std::size_t n = place.size();
    std::vector<double> x(n), y(n), z(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) x[i] = place[i][0], y[i] = place[i][1];
    cells_.build(x.data(), y.data(), z.data(), 0, std::uint32_t(n), 0.5 * reach_);
    std::vector<Vec3> force(n);
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) force[i] = -h_ * h_ * (from_points(place[i]) + from_wall(i));
    return force;
  }
  double h() const { return h_; }

 private:
  template <class K>
  static double slope_of(double q) {
    if (q >= K::support) return 0.0;
    if constexpr (K::needs_root) return K::template gradient_of_root<double>(q);
    else return K::template gradient<double>(q * q);
  }

  /// grad W of all layers together.
  Vec3 gradient(const Vec3& away) const {
    const double r2 = away.squaredNorm();
    double sum = 0;
    for (int k = -layers_; k <= layers_; ++k) sum += slope_(std::sqrt(r2 + k * k * layer_ * layer_));
    return sum * away;
  }
  /// Calls visit(j, place) for all points of all quadrants within reach of x.
  template <class Visit>
  void around(const Vec3& x, Visit visit) const {
    for (int image = 0; image < 4; ++image) {
      const Vec3 sign(image & 1 ? -1.0 : 1.0, image & 2 ? -1.0 : 1.0, 1.0), at = x.cwiseProduct(sign);
      const Vec3 low = at - Vec3::Constant(reach_), high = at + Vec3::Constant(reach_);
      for_each_in_cells(cells_.view(), low.data(), high.data(), [&](std::uint32_t s) {
        const std::uint32_t j = cells_.order()[s];
        visit(j, Vec3(place[j].cwiseProduct(sign)));
      });
    }
  }
  Vec3 from_points(const Vec3& x) const {
    Vec3 sum = Vec3::Zero();
    around(x, [&](std::uint32_t j, const Vec3& other) { sum += volume_[j] * gradient(x - other); });
    return sum;
  }

  Vec3 image_of(const Vec3& x, double& stretch) const {
    const double r = x.norm(), there = 2.0 * radius_ - r;
    stretch = std::pow(there / r, 0.75);  // image_volume (walls/reflection.hpp)
    return there / r * x;
  }
  /// Half of each pair (i, image of j), and half of (image of i, j) mirrored back (walls/wall_images.hpp).
  Vec3 from_wall(std::size_t i) const {
    const Vec3& x = place[i];
    if (radius_ - x.norm() > reach_) return Vec3::Zero();
    double own;
    const Vec3 image = image_of(x, own), normal = x.normalized();
    Vec3 seen = Vec3::Zero(), felt = Vec3::Zero();
    around(x, [&](std::uint32_t j, const Vec3& other) {
      if (radius_ - other.norm() > reach_) return;
      double stretch;
      const Vec3 mirrored = image_of(other, stretch);
      seen += stretch * volume_[j] * gradient(x - mirrored);
      felt += volume_[j] * gradient(image - other);
    });
    return 0.5 * (seen + own * (felt - 2.0 * felt.dot(normal) * normal));
  }

  double radius_, layer_, h_ = 0, reach_ = 0;
  int layers_ = 0;
  std::function<double(double)> slope_;
  std::vector<double> volume_;
  CellList cells_;
};

double largest(const std::vector<Vec3>& vectors) {
  double most = 0;
  for (const Vec3& one : vectors) most = std::max(most, one.norm());
  return most;
}

}  // namespace

RingSection::RingSection(const Settings& settings, double radius, double width, double layer) : width_(width) {
  Quadrant quadrant(settings, radius, width, layer);
  Descent descent;
  std::vector<Vec3> best = quadrant.place;
  double least = 1e300;
  for (int step = 0; step < most_steps; ++step) {
    const std::vector<Vec3> forces = quadrant.forces();
    if (const double now = largest(forces) / quadrant.h(); now < least) {
      least = now;
      best = quadrant.place;
      if (least < goal) break;
    }
    const std::vector<Vec3> steps = descent.step(quadrant.place, forces);
    const double shorten = std::min(1.0, 0.15 * width / largest(steps));
    for (std::size_t i = 0; i < steps.size(); ++i) quadrant.place[i] += shorten * steps[i];
  }
  std::size_t next = 0;
  for (long ring = 0; next < best.size(); ++ring) {
    auto& points = quadrant_.emplace_back();
    for (long q = 0; q < ring_count((ring + 0.5) * width, width) / 4; ++q, ++next) points.push_back(best[next].head<2>());
  }
}

Eigen::Vector2d RingSection::point(long ring, long q) const {
  if (std::size_t(ring) >= quadrant_.size()) return on_circle(ring, q, width_);
  const long quarter = long(quadrant_[ring].size()), around = 4 * quarter;
  Eigen::Vector2d sign(1.0, 1.0);
  if (q >= around / 2) q = around - 1 - q, sign[1] = -1.0;
  if (q >= quarter) q = around / 2 - 1 - q, sign[0] = -1.0;
  return quadrant_[ring][q].cwiseProduct(sign);
}

}  // namespace undex::sph
