#include "core/closed_surface.hpp"

#include "core/constants.hpp"
#include "core/surface_net.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

namespace undex {
namespace {

/// How many cells of that spacing fit into a length, a multiple of `of`.
int count(double length, double spacing, int of) { return of * std::max(1, int(std::lround(length / (of * spacing)))); }

/// Collects patches of faces; nodes at one place are one node.
class Builder {
 public:
  explicit Builder(double spacing) : cell_(1e-5 * spacing) {}

  int node(const Vec3& x) {
    const auto bin = [&](double at) { return std::llround(at / cell_ + 0.137); };  // whole multiples lie well within one
    const auto key = std::tuple(bin(x[0]), bin(x[1]), bin(x[2]));
    const auto [found, fresh] = number_.emplace(key, int(surface_.nodes.size()));
    if (fresh) surface_.nodes.push_back(x);
    return found->second;
  }
  /// A patch of n x m faces; `at` takes (i, j) to a place. `inward` at a place: where the body is.
  void patch(int n, int m, const std::function<Vec3(int, int)>& at, const std::function<Vec3(const Vec3&)>& inward) {
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < n; ++i) {
        std::array<int, 4> face{node(at(i, j)), node(at(i + 1, j)), node(at(i + 1, j + 1)), node(at(i, j + 1))};
        const auto& x = surface_.nodes;
        const Vec3 area = (x[face[2]] - x[face[0]]).cross(x[face[3]] - x[face[1]]);
        const Vec3 middle = 0.25 * (x[face[0]] + x[face[1]] + x[face[2]] + x[face[3]]);
        if (area.dot(inward(middle)) < 0) std::swap(face[1], face[3]);
        surface_.faces.push_back(face);
      }
  }
  /// A line of n segments; the body lies on the side of `inward`.
  void line(int n, const std::function<Vec3(int)>& at, const std::function<Vec3(const Vec3&)>& inward) {
    for (int i = 0; i < n; ++i) {
      const Vec3 from = at(i), to = at(i + 1), way = to - from;
      const bool right = Vec3(way[1], -way[0], 0.0).dot(inward(0.5 * (from + to))) > 0;
      const int a = node(right ? from : to), b = node(right ? to : from);
      surface_.faces.push_back({a, b, b, a});
    }
  }
  WetSurface take() { return std::move(surface_); }

 private:
  double cell_;
  WetSurface surface_;
  std::map<std::tuple<long long, long long, long long>, int> number_;
};

std::function<Vec3(const Vec3&)> along(const Vec3& way) {
  return [way](const Vec3&) { return way; };
}

/// A place of a round body from its distances across (e1, e2) and along the axis.
struct Frame {
  int axis;
  Vec3 center;
  Vec3 at(double p, double q, double z) const {
    Vec3 x = Vec3::Zero();
    x[(axis + 1) % 3] = center[(axis + 1) % 3] + p;
    x[(axis + 2) % 3] = center[(axis + 2) % 3] + q;
    x[axis] = z;
    return x;
  }
  Vec3 outward(const Vec3& x) const {
    Vec3 away = x - center;
    away[axis] = 0.0;
    return away;
  }
};

/// The unit disc in square cells: a core of m x m, the rest a ring about it of `rings` x 4 m; visit(n, m, (i, j) -> place).
template <class Visit>
void disc(int m, int rings, Visit visit) {
  constexpr double core = 0.6;  // its half width over the radius, 0.7 times that at the corners
  const auto circle = [m](int side, double i) {
    const double angle = 0.5 * pi * side - 0.25 * pi + 0.5 * pi * i / m;
    return Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  // A point of the core's rim lies between that of a square and that of a circle.
  const auto rim = [&](int side, double i) {
    const double t = 2.0 * i / m - 1.0;
    static constexpr int turn[4][4] = {{1, 0, 0, 1}, {0, -1, 1, 0}, {-1, 0, 0, -1}, {0, 1, -1, 0}};
    const int* r = turn[side];
    const Eigen::Vector2d square(r[0] + r[1] * t, r[2] + r[3] * t);
    return Eigen::Vector2d(0.5 * core * (0.85 * square + circle(side, i)));
  };
  for (int side = 0; side < 4; ++side)
    visit(m, rings, [=](int i, int j) {
      const double share = double(j) / rings;
      return Eigen::Vector2d((1.0 - share) * rim(side, i) + share * circle(side, i));
    });
  // Transfinite interpolation between the four rims: 0 on the right, 1 above, 2 on the left, 3 below.
  const Eigen::Vector2d corner[4] = {rim(3, 0), rim(0, 0), rim(1, 0), rim(2, 0)};  // below left, below right, above ...
  visit(m, m, [=](int i, int j) {
    const double u = double(i) / m, v = double(j) / m;
    const Eigen::Vector2d sides = (1 - v) * rim(3, i) + v * rim(1, m - i) + (1 - u) * rim(2, m - j) + u * rim(0, j);
    const Eigen::Vector2d corners =
        (1 - u) * (1 - v) * corner[0] + u * (1 - v) * corner[1] + u * v * corner[2] + (1 - u) * v * corner[3];
    return Eigen::Vector2d(sides - corners);
  });
}

struct Mesher {
  double spacing;
  int dimension;

  std::optional<WetSurface> operator()(const Slab& slab) const {
    if (dimension > 1) return std::nullopt;
    return interval(slab.low, slab.high);
  }

  std::optional<WetSurface> operator()(const Box& box) const {
    if (dimension == 1) return interval(box.low[0], box.high[0]);
    const Vec3 size = box.high - box.low, middle = 0.5 * (box.low + box.high);
    Builder built(spacing);
    int n[3];
    for (int a = 0; a < 3; ++a) n[a] = count(size[a], spacing, 2);
    if (dimension == 2) {
      for (int a = 0; a < 2; ++a)
        for (const double side : {box.low[1 - a], box.high[1 - a]})
          built.line(
              n[a],
              [&](int i) {
                Vec3 x = Vec3::Zero();
                x[a] = middle[a] + size[a] * (double(i) / n[a] - 0.5);
                x[1 - a] = side;
                return x;
              },
              along((middle[1 - a] - side) * Vec3::Unit(1 - a)));
      return built.take();
    }
    for (int a = 0; a < 3; ++a)
      for (const double side : {box.low[a], box.high[a]}) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        built.patch(
            n[b], n[c],
            [&](int i, int j) {
              Vec3 x;
              x[a] = side;
              x[b] = middle[b] + size[b] * (double(i) / n[b] - 0.5);
              x[c] = middle[c] + size[c] * (double(j) / n[c] - 0.5);
              return x;
            },
            along((middle[a] - side) * Vec3::Unit(a)));
      }
    return built.take();
  }

  std::optional<WetSurface> operator()(const Sphere& sphere) const {
    if (dimension == 1) return interval(sphere.center[0] - sphere.radius, sphere.center[0] + sphere.radius);
    if (dimension == 2) return circles(sphere.center, {sphere.radius}, {-1.0});
    Builder built(spacing);
    const int n = count(0.5 * pi * sphere.radius, spacing, 2);
    const auto slope = [n](int i) { return 2 * i == n ? 0.0 : std::tan(0.25 * pi * (2.0 * i / n - 1.0)); };
    for (int a = 0; a < 3; ++a)
      for (const double side : {-1.0, 1.0})
        built.patch(
            n, n,
            [&](int i, int j) {
              Vec3 way;
              way[a] = side;
              way[(a + 1) % 3] = slope(i);
              way[(a + 2) % 3] = slope(j);
              return Vec3(sphere.center + sphere.radius * way.normalized());
            },
            [&](const Vec3& x) { return Vec3(sphere.center - x); });
    return built.take();
  }

  std::optional<WetSurface> operator()(const Cylinder& c) const {
    if (dimension < 3 && c.axis < dimension) return flat(c.axis, c.low, c.high, c.center, c.radius, c.radius);
    if (dimension == 1) return interval(c.center[0] - c.radius, c.center[0] + c.radius);
    if (dimension == 2) return circles(c.center, {c.radius}, {-1.0});
    return round(c.axis, c.center, c.low, c.high, c.radius, c.radius);
  }

  std::optional<WetSurface> operator()(const Cone& c) const {
    if (dimension == 1) return std::nullopt;
    if (dimension == 2)
      return c.axis < 2 ? std::optional(flat(c.axis, c.low, c.high, c.center, c.low_radius, c.high_radius)) : std::nullopt;
    return round(c.axis, c.center, c.low, c.high, c.low_radius, c.high_radius);
  }

  std::optional<WetSurface> operator()(const Ellipsoid& e) const {
    if (dimension == 1) return interval(e.center[0] - e.semi_axes[0], e.center[0] + e.semi_axes[0]);
    Builder built(spacing);
    const double longest = e.semi_axes.head(dimension).maxCoeff();
    if (dimension == 2) {
      const int n = count(2 * pi * longest, spacing, 8);
      const Frame frame{2, Vec3::Zero()};
      built.line(
          n,
          [&](int i) {
            return Vec3(e.center.cwiseProduct(Vec3(1, 1, 0)) +
                        on_circle(frame, 1.0, 2 * pi * (i % n) / n, 0.0).cwiseProduct(e.semi_axes));
          },
          [&](const Vec3& x) { return Vec3(e.center - x); });
      return built.take();
    }
    int n[3];
    for (int a = 0; a < 3; ++a) n[a] = count(0.5 * pi * e.semi_axes[a], spacing, 2);
    const auto slope = [](int i, int of) { return 2 * i == of ? 0.0 : std::tan(0.25 * pi * (2.0 * i / of - 1.0)); };
    for (int a = 0; a < 3; ++a)
      for (const double side : {-1.0, 1.0}) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        built.patch(
            n[b], n[c],
            [&](int i, int j) {
              Vec3 way;
              way[a] = side;
              way[b] = slope(i, n[b]);
              way[c] = slope(j, n[c]);
              return Vec3(e.center + way.normalized().cwiseProduct(e.semi_axes));
            },
            [&](const Vec3& x) { return Vec3(e.center - x); });
      }
    return built.take();
  }

  std::optional<WetSurface> operator()(const HalfSpace&) const { return std::nullopt; }
  std::optional<WetSurface> operator()(const Revolution& r) const { return net(r); }
  std::optional<WetSurface> operator()(const Stl& stl) const { return dimension == 3 ? net(stl) : std::nullopt; }
  std::optional<WetSurface> operator()(const Union& of) const { return net(of); }
  std::optional<WetSurface> operator()(const Intersection& of) const { return net(of); }
  std::optional<WetSurface> operator()(const Difference& of) const { return net(of); }

  /// The mesh of the shape before the turn, unless it then crosses a plane in which the turned shape is its own image.
  std::optional<WetSurface> operator()(const Placed& p) const {
    std::optional<WetSurface> mesh = closed_surface(p.shape[0], spacing, dimension);
    if (!mesh) return mesh;
    for (Vec3& x : mesh->nodes) x = p.after(x);
    for (int a = 0; a < dimension && dimension > 1; ++a) {
      const bool across = std::any_of(mesh->faces.begin(), mesh->faces.end(), [&](const auto& face) {
        const auto beside = [&](double side) {
          return std::any_of(face.begin(), face.end(),
                             [&](int n) { return side * mesh->nodes[std::size_t(n)][a] > 1e-6 * spacing; });
        };
        return beside(1.0) && beside(-1.0);
      });
      if (across && is_mirrored(p, a, 0.0, dimension)) return net(p);
    }
    return mesh;
  }

  std::optional<WetSurface> net(const Primitive& shape) const {
    if (!is_bounded(shape, dimension)) return std::nullopt;
    return surface_net([&](const Vec3& x) { return signed_distance(shape, x, dimension, 3.0 * spacing); },
                       bounds(shape, dimension), spacing, dimension);
  }

  std::optional<WetSurface> operator()(const TubeShape& t) const {
    if (dimension == 2 && t.axis == 2) return circles(t.center, {t.inner, t.outer}, {1.0, -1.0});
    if (dimension < 3) return std::nullopt;
    const Frame frame{t.axis, t.center};
    Builder built(spacing);
    const int around = count(pi * (t.inner + t.outer), spacing, 8), tall = count(t.high - t.low, spacing, 2),
              through = count(t.outer - t.inner, spacing, 1);
    for (const double r : {t.inner, t.outer}) side(built, frame, around, tall, t.low, t.high, r, r, r == t.inner ? 1.0 : -1.0);
    for (const double z : {t.low, t.high})
      built.patch(
          around, through,
          [&](int i, int j) {
            const double r = t.inner + (t.outer - t.inner) * j / through, angle = 2 * pi * (i % around) / around;
            return on_circle(frame, r, angle, z);
          },
          along((0.5 * (t.low + t.high) - z) * Vec3::Unit(t.axis)));
    return built.take();
  }

  WetSurface interval(double low, double high) const {
    WetSurface surface;
    for (const double x : {low, high}) {
      const int first = int(surface.nodes.size());
      for (const auto& [y, z] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) surface.nodes.push_back({x, y, z});
      // In the order y, z the normal is +x, into the body from its lower end.
      if (x == low) surface.faces.push_back({first, first + 1, first + 2, first + 3});
      else surface.faces.push_back({first, first + 3, first + 2, first + 1});
    }
    return surface;
  }

  /// Circles in the plane; `way` of each: 1 where the body lies outside of it.
  WetSurface circles(const Vec3& center, const std::vector<double>& radii, const std::vector<double>& way) const {
    Builder built(spacing);
    const Frame frame{2, Vec3(center[0], center[1], 0.0)};
    for (std::size_t k = 0; k < radii.size(); ++k) {
      const int n = count(2 * pi * radii[k], spacing, 8);
      built.line(
          n, [&](int i) { return on_circle(frame, radii[k], 2 * pi * (i % n) / n, 0.0); },
          [&](const Vec3& x) { return Vec3(way[k] * frame.outward(x)); });
    }
    return built.take();
  }

  /// The section of a cone or cylinder through its axis, in the plane.
  WetSurface flat(int axis, double low, double high, const Vec3& center, double low_radius, double high_radius) const {
    const int across = 1 - axis;
    const Vec3 middle = [&] {
      Vec3 x = Vec3::Zero();
      x[axis] = 0.5 * (low + high);
      x[across] = center[across];
      return x;
    }();
    if (dimension == 1) return interval(low, high);
    Builder built(spacing);
    const auto place = [&](double s, double r) {
      Vec3 x = Vec3::Zero();
      x[axis] = s;
      x[across] = center[across] + r;
      return x;
    };
    const int tall = count(std::hypot(high - low, high_radius - low_radius), spacing, 2);
    for (const double sign : {-1.0, 1.0})
      built.line(
          tall,
          [&](int i) {
            const double share = double(i) / tall;
            return place(low + (high - low) * share, sign * (low_radius + (high_radius - low_radius) * share));
          },
          [&](const Vec3&) { return Vec3(-sign * Vec3::Unit(across)); });
    for (const auto& [s, r] : {std::pair(low, low_radius), {high, high_radius}}) {
      if (r == 0.0) continue;
      const int n = count(2 * r, spacing, 2);
      built.line(
          n, [&, s = s, r = r](int i) { return place(s, r * (2.0 * i / n - 1.0)); },
          along((middle[axis] - s) * Vec3::Unit(axis)));
    }
    return built.take();
  }

  static Vec3 on_circle(const Frame& frame, double r, double angle, double z) {
    const auto clean = [](double value) { return std::abs(value) < 1e-14 ? 0.0 : value; };
    return frame.at(r * clean(std::cos(angle)), r * clean(std::sin(angle)), z);
  }

  /// The side between two circles; `way`: 1 where the body lies outside of it.
  void side(Builder& built, const Frame& frame, int around, int tall, double low, double high, double low_radius,
            double high_radius, double way) const {
    built.patch(
        around, tall,
        [&](int i, int j) {
          const double share = double(j) / tall;
          return on_circle(frame, low_radius + (high_radius - low_radius) * share, 2 * pi * (i % around) / around,
                           low + (high - low) * share);
        },
        [&](const Vec3& x) { return Vec3(way * frame.outward(x)); });
  }

  /// A cylinder or cone. A tip is the middle of the disc that its side is then.
  WetSurface round(int axis, const Vec3& center, double low, double high, double low_radius, double high_radius) const {
    const Frame frame{axis, center};
    Builder built(spacing);
    const double widest = std::max(low_radius, high_radius), slant = std::hypot(high - low, high_radius - low_radius);
    const int m = count(0.5 * pi * widest, spacing, 2), around = 4 * m;
    const auto cap = [&](double z, double radius, double rise, int rings, const std::function<Vec3(const Vec3&)>& inward) {
      disc(m, rings, [&](int n, int k, const auto& at) {
        built.patch(
            n, k,
            [&](int i, int j) {
              const Eigen::Vector2d p = at(i, j);
              return frame.at(radius * p[0], radius * p[1], z + rise * (1.0 - p.norm()));
            },
            inward);
      });
    };
    const Vec3 up = Vec3::Unit(axis);
    const auto rings_on = [&](double length) { return count(0.45 * length, spacing, 1); };
    if (low_radius > 0 && high_radius > 0) {
      // The side's nodes meet the discs', whose circle begins an eighth of a turn back.
      const int tall = count(slant, spacing, 2);
      built.patch(
          around, tall,
          [&](int i, int j) {
            const double share = double(j) / tall;
            const double angle = 2 * pi * (i % around) / around - 0.25 * pi;
            return on_circle(frame, low_radius + (high_radius - low_radius) * share, angle, low + (high - low) * share);
          },
          [&](const Vec3& x) { return Vec3(-frame.outward(x)); });
    } else {
      const bool tip_below = low_radius == 0;
      const auto inward = along(tip_below ? up : Vec3(-up));
      cap(tip_below ? high : low, widest, tip_below ? low - high : high - low, rings_on(slant), inward);
    }
    if (low_radius > 0) cap(low, low_radius, 0.0, rings_on(low_radius), along(up));
    if (high_radius > 0) cap(high, high_radius, 0.0, rings_on(high_radius), along(-up));
    return built.take();
  }
};

}  // namespace

std::optional<WetSurface> closed_surface(const Primitive& shape, double spacing, int dimension) {
  return std::visit([&](const auto& each) { return Mesher{spacing, dimension}(each); }, shape);
}

WetSurface without(const WetSurface& surface, const std::vector<bool>& dry) {
  WetSurface kept;
  std::vector<int> number(surface.nodes.size(), -1);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    if (dry[f]) continue;
    std::array<int, 4> face = surface.faces[f];
    for (int& n : face) {
      int& there = number[std::size_t(n)];
      if (there < 0) {
        there = int(kept.nodes.size());
        kept.nodes.push_back(surface.nodes[std::size_t(n)]);
      }
      n = there;
    }
    kept.faces.push_back(face);
  }
  return kept;
}

double face_area(const std::array<int, 4>& face, std::span<const Vec3> position) {
  const std::array<Vec3, 4> x = corners_of(face, position);
  return 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm();
}

}  // namespace undex
