#include "core/surface_net.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace undex {
namespace {

using Index = std::array<int, 3>;

class Net {
 public:
  Net(const std::function<double(const Vec3&)>& distance, const Bounds& box, double spacing, int dimension)
      : distance_(distance), h_(spacing), dimension_(dimension) {
    for (int a = 0; a < dimension; ++a) {
      first_[a] = int(std::floor(box.low[a] / h_ - 0.5)) - 1;
      count_[a] = int(std::ceil(box.high[a] / h_ - 0.5)) + 1 - first_[a] + 1;
    }
  }

  std::optional<WetSurface> mesh() {
    sample();
    make_faces();
    for (int round = 0; round < 8; ++round) even_out();
    if (!is_closed()) return std::nullopt;
    return std::move(surface_);
  }

 private:
  struct Cut {
    Vec3 place, normal;
  };

  std::size_t at(const Index& c) const {
    return (std::size_t(c[2]) * std::size_t(count_[1]) + std::size_t(c[1])) * std::size_t(count_[0]) + std::size_t(c[0]);
  }
  Vec3 corner(const Index& c) const {
    Vec3 x = Vec3::Zero();
    for (int a = 0; a < dimension_; ++a) x[a] = (first_[a] + c[a] + 0.5) * h_;
    return x;
  }
  Vec3 gradient(const Vec3& x) const {
    Vec3 g = Vec3::Zero();
    const double step = 1e-4 * h_;
    for (int a = 0; a < dimension_; ++a) {
      Vec3 above = x, below = x;
      above[a] += step;
      below[a] -= step;
      g[a] = (distance_(above) - distance_(below)) / (2 * step);
    }
    return g;
  }

  void sample() {
    inside_.resize(std::size_t(count_[0]) * std::size_t(count_[1]) * std::size_t(count_[2]));
#pragma omp parallel for schedule(static)
    for (int k = 0; k < count_[2]; ++k)
      for (int j = 0; j < count_[1]; ++j)
        for (int i = 0; i < count_[0]; ++i) inside_[at({i, j, k})] = distance_(corner({i, j, k})) < 0;
  }

  /// Where the surface crosses the lattice edge from a corner along an axis.
  const Cut& cut(const Index& c, int axis) {
    const auto [found, fresh] = cuts_.try_emplace({at(c), axis});
    if (!fresh) return found->second;
    const bool low_inside = inside_[at(c)];
    double low = 0, high = h_;
    const Vec3 from = corner(c);
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      ((distance_(from + middle * Vec3::Unit(axis)) < 0) == low_inside ? low : high) = middle;
    }
    const Vec3 x = from + 0.5 * (low + high) * Vec3::Unit(axis);
    const Vec3 g = gradient(x);
    return found->second = {x, g.norm() > 0 ? Vec3(g.normalized()) : Vec3((low_inside ? 1.0 : -1.0) * Vec3::Unit(axis))};
  }

  int node(const Index& cell) {
    const auto [found, fresh] = nodes_.try_emplace(at(cell), int(surface_.nodes.size()));
    if (!fresh) return found->second;
    std::vector<Cut> cuts;
    for (int axis = 0; axis < dimension_; ++axis) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      for (int p = 0; p < (b < dimension_ ? 2 : 1); ++p)
        for (int q = 0; q < (c < dimension_ ? 2 : 1); ++q) {
          Index from = cell;
          from[b] += p;
          from[c] += q;
          Index to = from;
          ++to[axis];
          if (inside_[at(from)] != inside_[at(to)]) cuts.push_back(cut(from, axis));
        }
    }
    Vec3 mean = Vec3::Zero();
    for (const Cut& each : cuts) mean += each.place / double(cuts.size());
    Mat3 square = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (const Cut& each : cuts) {
      square += each.normal * each.normal.transpose();
      right += each.normal * each.normal.dot(each.place - mean);
    }
    // Directions in which the normals hardly vary are left as the mean has them.
    const Eigen::SelfAdjointEigenSolver<Mat3> parts(square);
    constexpr double sharp = 0.05;
    Vec3 x = mean;
    int rank = 0;
    for (int k = 0; k < 3; ++k) {
      const double value = parts.eigenvalues()[k];
      if (value < sharp * parts.eigenvalues()[2]) continue;
      ++rank;
      const Vec3 way = parts.eigenvectors().col(k);
      x += way * (way.dot(right) / value);
    }
    // An edge or a tip may reach beyond the cell where the lattice misses it; elsewhere planes that meet far away do not count.
    const Vec3 low = corner(cell), high = corner({cell[0] + 1, cell[1] + 1, cell[2] + 1});
    const auto is_near = [&](double beyond) {
      for (int a = 0; a < dimension_; ++a)
        if (x[a] < low[a] - beyond * h_ || x[a] > high[a] + beyond * h_) return false;
      return true;
    };
    if (!is_near(0.1) && !(is_near(0.7) && std::abs(distance_(x)) < 0.02 * h_)) {
      x = mean;
      rank = 0;
    }
    smooth_.push_back(rank <= 1);
    surface_.nodes.push_back(on_surface(x));
    return found->second;
  }

  /// The place moved onto the surface along the gradient; the place itself where that leads away.
  Vec3 on_surface(const Vec3& x) const {
    Vec3 moved = x;
    for (int k = 0; k < 4; ++k) {
      const double d = distance_(moved);
      if (std::abs(d) < 1e-10 * h_) break;
      const Vec3 g = gradient(moved);
      if (g.squaredNorm() < 0.25) break;
      moved -= d / g.squaredNorm() * g;
    }
    return (moved - x).norm() < 0.5 * h_ && std::abs(distance_(moved)) < std::abs(distance_(x)) ? moved : x;
  }

  void make_faces() {
    for (int axis = 0; axis < dimension_; ++axis) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      Index end = count_;
      end[axis] -= 1;
      for (int k = 0; k < end[2]; ++k)
        for (int j = 0; j < end[1]; ++j)
          for (int i = 0; i < end[0]; ++i) {
            const Index from{i, j, k};
            Index to = from;
            ++to[axis];
            const bool low_inside = inside_[at(from)];
            if (low_inside == inside_[at(to)]) continue;
            const auto cell = [&](int p, int q) {
              Index of = from;
              if (b < dimension_) of[b] -= p;
              if (c < dimension_) of[c] -= q;
              return node(of);
            };
            if (dimension_ == 2) {
              // The normal of a segment from a to b is that of its drawn out face, (b - a) x z.
              const int other = 1 - axis;
              Index below = from;
              below[other] -= 1;
              int one = node(below), two = node(from);
              // From `one` to `two` is the way of the other axis; (other x z) is +x for y and -y for x.
              const bool along = other == 1;  // does that normal point along +axis?
              if (along == low_inside) std::swap(one, two);
              surface_.faces.push_back({one, two, two, one});
              continue;
            }
            // In the order b, c the normal is along +axis.
            std::array<int, 4> face{cell(1, 1), cell(0, 1), cell(0, 0), cell(1, 0)};
            if (low_inside) std::swap(face[1], face[3]);
            surface_.faces.push_back(face);
          }
    }
  }

  /// Moves the nodes on smooth parts towards the mean of their neighbours, along the surface.
  void even_out() {
    std::vector<Vec3> sum(surface_.nodes.size(), Vec3::Zero());
    std::vector<int> count(surface_.nodes.size(), 0);
    for (const auto& face : surface_.faces)
      for (int c = 0; c < (is_segment(face) ? 1 : 4); ++c)
        for (const auto& [from, to] : {std::pair(face[std::size_t(c)], face[std::size_t(c + 1) % 4]),
                                       std::pair(face[std::size_t(c + 1) % 4], face[std::size_t(c)])}) {
          sum[std::size_t(from)] += surface_.nodes[std::size_t(to)];
          ++count[std::size_t(from)];
        }
    for (std::size_t n = 0; n < sum.size(); ++n) {
      if (!smooth_[n] || count[n] == 0) continue;
      Vec3& x = surface_.nodes[n];
      const Vec3 normal = gradient(x).normalized();
      Vec3 way = 0.5 * (sum[n] / count[n] - x);
      way -= normal * normal.dot(way);
      const Vec3 moved = on_surface(x + way);
      if (std::abs(distance_(moved)) < 1e-6 * h_ && gradient(moved).dot(normal) > 0.8) x = moved;
    }
  }

  bool is_closed() const {
    std::map<std::pair<int, int>, int> edges;
    for (const auto& face : surface_.faces) {
      if (is_segment(face)) {
        ++edges[{face[0], -1}];
        ++edges[{face[1], -2}];
        continue;
      }
      for (std::size_t c = 0; c < 4; ++c) ++edges[{face[c], face[(c + 1) % 4]}];
    }
    return !edges.empty() && std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 1; });
  }

  const std::function<double(const Vec3&)>& distance_;
  double h_;
  int dimension_;
  Index first_{0, 0, 0}, count_{1, 1, 1};
  std::vector<char> inside_;
  std::map<std::pair<std::size_t, int>, Cut> cuts_;
  std::map<std::size_t, int> nodes_;
  std::vector<bool> smooth_;
  WetSurface surface_;
};

}  // namespace

std::optional<WetSurface> surface_net(const std::function<double(const Vec3&)>& distance, const Bounds& box, double spacing,
                                      int dimension) {
  if (dimension < 2) return std::nullopt;
  return Net(distance, box, spacing, dimension).mesh();
}

}  // namespace undex
