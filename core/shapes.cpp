// Signed distances of the primitives in one, two and three dimensions, and volumes by subdivision.
//
// In fewer than three dimensions the unused coordinates are taken away from every formula: a cylinder along z in two
// dimensions is a disc, one along x is the strip between its two generators, one along x in one dimension an interval.
#include "core/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/triangle_surface.hpp"

namespace undex {
namespace {

constexpr double unbounded = 1e300;

/// Distance to low..high on a line, negative inside.
double interval(double x, double low, double high) { return std::max(low - x, x - high); }

/// Distance to the product of sets whose own distances are given, as in a box of intervals: exact inside and outside.
template <std::size_t N>
double product(const std::array<double, N>& q) {
  double outside = 0, largest = -unbounded;
  for (const double each : q) {
    if (each > 0) outside += each * each;
    largest = std::max(largest, each);
  }
  return outside > 0 ? std::sqrt(outside) : largest;
}

/// Distance from the axis of a round body, over those axes across it that the dimension has.
double radial(const Vec3& x, const Vec3& center, int axis, int dimension) {
  double square = 0;
  for (int a = 0; a < dimension; ++a)
    if (a != axis) square += (x[a] - center[a]) * (x[a] - center[a]);
  return std::sqrt(square);
}
bool has_radius(int axis, int dimension) { return dimension > 1 || axis != 0; }

/// From (r, z) to the line from (r0, z0) to (r1, z1).
double to_segment(double r, double z, double r0, double z0, double r1, double z1) {
  const double dr = r1 - r0, dz = z1 - z0, square = dr * dr + dz * dz;
  const double share = square > 0 ? std::clamp(((r - r0) * dr + (z - z0) * dz) / square, 0.0, 1.0) : 0.0;
  return std::hypot(r - r0 - share * dr, z - z0 - share * dz);
}

/// From a place to the surface of an ellipsoid about the origin, negative inside. The nearest point is
/// e^2 y / (s + e^2 - e_min^2) at the root s > 0 of sum (e y / (s + e^2 - e_min^2))^2 = 1, which Newton's method finds from
/// below (D. Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid, 2013).
double to_ellipsoid(const Vec3& place, const Vec3& semi_axes, int dimension) {
  double smallest = unbounded;
  for (int a = 0; a < dimension; ++a) smallest = std::min(smallest, semi_axes[a]);
  Vec3 y = Vec3::Zero(), e = Vec3::Ones(), more = Vec3::Zero();
  double level = 0, root = 0;
  for (int a = 0; a < dimension; ++a) {
    e[a] = semi_axes[a];
    more[a] = (e[a] - smallest) * (e[a] + smallest);
    y[a] = std::max(std::abs(place[a]), 1e-12 * smallest);
    level += (y[a] / e[a]) * (y[a] / e[a]);
    root = std::max(root, e[a] * y[a] - more[a]);
  }
  for (int k = 0; k < 200; ++k) {
    double value = -1, slope = 0;
    for (int a = 0; a < dimension; ++a) {
      const double ratio = e[a] * y[a] / (root + more[a]);
      value += ratio * ratio;
      slope -= 2 * ratio * ratio / (root + more[a]);
    }
    const double step = value / slope;
    if (!(value > 0) || root - step == root) break;
    root -= step;
  }
  double square = 0;
  for (int a = 0; a < dimension; ++a) {
    const double apart = y[a] * (root - smallest * smallest) / (root + more[a]);
    square += apart * apart;
  }
  return level < 1 ? -std::sqrt(square) : std::sqrt(square);
}

/// From (r, z) to the sides of a polygon, negative within; sides on the axis are none.
double to_polygon(const Polygon& points, double r, double z) {
  double nearest = unbounded;
  bool within = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [r0, z0] = points[k];
    const auto [r1, z1] = points[(k + 1) % points.size()];
    if (r0 > 0 || r1 > 0) nearest = std::min(nearest, to_segment(r, z, r0, z0, r1, z1));
    if ((z0 <= z) != (z1 <= z) && r < r0 + (z - z0) / (z1 - z0) * (r1 - r0)) within = !within;
  }
  return within ? -nearest : nearest;
}

struct Distance {
  const Vec3& x;
  int dimension;
  double beyond;

  double operator()(const Box& box) const {
    std::array<double, 3> q{-unbounded, -unbounded, -unbounded};
    for (int a = 0; a < dimension; ++a) q[a] = interval(x[a], box.low[a], box.high[a]);
    return product(q);
  }
  double operator()(const Slab& slab) const {
    return slab.axis < dimension ? interval(x[slab.axis], slab.low, slab.high) : -unbounded;
  }
  double operator()(const Sphere& sphere) const {
    double square = 0;
    for (int a = 0; a < dimension; ++a) square += (x[a] - sphere.center[a]) * (x[a] - sphere.center[a]);
    return std::sqrt(square) - sphere.radius;
  }
  double operator()(const Cylinder& c) const {
    return round(c.axis, c.low, c.high, radial(x, c.center, c.axis, dimension) - c.radius);
  }
  double operator()(const TubeShape& t) const {
    return round(t.axis, t.low, t.high, interval(radial(x, t.center, t.axis, dimension), t.inner, t.outer));
  }
  double operator()(const Cone& cone) const {
    const double r = radial(x, cone.center, cone.axis, dimension), z = x[cone.axis];
    const double nearest = std::min({to_segment(r, z, 0, cone.low, cone.low_radius, cone.low),
                                     to_segment(r, z, cone.low_radius, cone.low, cone.high_radius, cone.high),
                                     to_segment(r, z, cone.high_radius, cone.high, 0, cone.high)});
    return z >= cone.low && z <= cone.high && r <= cone.radius_at(z) ? -nearest : nearest;
  }

  double operator()(const Ellipsoid& e) const { return to_ellipsoid(x - e.center, e.semi_axes, dimension); }
  double operator()(const HalfSpace& half) const {
    double along = 0, square = 0;
    for (int a = 0; a < dimension; ++a) {
      along += half.normal[a] * (x[a] - half.point[a]);
      square += half.normal[a] * half.normal[a];
    }
    return along / std::sqrt(square);
  }
  double operator()(const Revolution& r) const { return to_polygon(r.points, radial(x, r.center, r.axis, dimension), x[r.axis]); }
  double operator()(const Stl& stl) const { return stl.read->signed_distance(x, beyond); }
  double operator()(const Union& of) const {
    double least = unbounded;
    for (const Primitive& each : of.shapes) least = std::min(least, signed_distance(each, x, dimension, beyond));
    return least;
  }
  double operator()(const Intersection& of) const {
    double largest = -unbounded;
    for (const Primitive& each : of.shapes) largest = std::max(largest, signed_distance(each, x, dimension, beyond));
    return largest;
  }
  double operator()(const Difference& of) const {
    double largest = signed_distance(of.shapes[0], x, dimension, beyond);
    for (std::size_t k = 1; k < of.shapes.size(); ++k)
      largest = std::max(largest, -signed_distance(of.shapes[k], x, dimension, beyond));
    return largest;
  }
  double operator()(const Placed& p) const { return signed_distance(p.shape[0], p.before(x), dimension, beyond); }

  double round(int axis, double low, double high, double across) const {
    std::array<double, 2> q{-unbounded, -unbounded};
    if (has_radius(axis, dimension)) q[0] = across;
    if (axis < dimension) q[1] = interval(x[axis], low, high);
    return product(q);
  }
};

/// How far a shape reaches along a direction d: the largest x.d [m]; `unbounded` where it has no end. A direction that is off an
/// axis by rounding is along it.
double support(const Primitive& shape, const Vec3& direction, int dimension);

struct Reach {
  Vec3 d;
  int dimension;

  double of_box(const Bounds& box) const {
    double sum = 0;
    for (int a = 0; a < dimension; ++a) {
      if (d[a] == 0) continue;
      const double end = d[a] > 0 ? box.high[a] : box.low[a];
      if (std::abs(end) >= unbounded) return unbounded;
      sum += d[a] * end;
    }
    return sum;
  }
  double across(int axis, const Vec3& center, double& sine) const {
    double sum = 0, square = 0;
    for (int a = 0; a < dimension; ++a)
      if (a != axis) sum += d[a] * center[a], square += d[a] * d[a];
    sine = std::sqrt(square);
    return sum;
  }
  double along(int axis, double at) const { return axis < dimension ? d[axis] * at : 0.0; }
  double ends(int axis, const Vec3& center, double low, double low_radius, double high, double high_radius) const {
    double sine = 0;
    const double middle = across(axis, center, sine);
    return middle + std::max(along(axis, low) + low_radius * sine, along(axis, high) + high_radius * sine);
  }

  double operator()(const Box& box) const { return of_box({box.low, box.high}); }
  double operator()(const Slab& slab) const { return of_box(bounds(Primitive(slab), dimension)); }
  double operator()(const Sphere& s) const {
    return d.head(dimension).dot(s.center.head(dimension)) + s.radius * d.head(dimension).norm();
  }
  double operator()(const Cylinder& c) const { return ends(c.axis, c.center, c.low, c.radius, c.high, c.radius); }
  double operator()(const TubeShape& t) const { return ends(t.axis, t.center, t.low, t.outer, t.high, t.outer); }
  double operator()(const Cone& c) const { return ends(c.axis, c.center, c.low, c.low_radius, c.high, c.high_radius); }
  double operator()(const Ellipsoid& e) const {
    return d.head(dimension).dot(e.center.head(dimension)) + d.head(dimension).cwiseProduct(e.semi_axes.head(dimension)).norm();
  }
  double operator()(const HalfSpace& half) const {
    const auto n = half.normal.head(dimension).normalized(), way = d.head(dimension).normalized();
    return (n - way).norm() < 1e-12 ? d.head(dimension).dot(half.point.head(dimension)) : unbounded;
  }
  double operator()(const Revolution& r) const {
    double sine = 0, most = -unbounded;
    const double middle = across(r.axis, r.center, sine);
    for (const auto& [radius, z] : r.points) most = std::max(most, middle + along(r.axis, z) + radius * sine);
    return most;
  }
  double operator()(const Stl& stl) const { return stl.read->reach(d); }
  double operator()(const Union& of) const {
    double most = -unbounded;
    for (const Primitive& each : of.shapes) most = std::max(most, support(each, d, dimension));
    return most;
  }
  double operator()(const Intersection& of) const {
    double least = of_box(bounds(Primitive(of), dimension));
    for (const Primitive& each : of.shapes) least = std::min(least, support(each, d, dimension));
    return least;
  }
  double operator()(const Difference& of) const { return support(of.shapes[0], d, dimension); }
  double operator()(const Placed& p) const {
    const Vec3 before = p.turn.transpose() * d;
    const double there = support(p.shape[0], before, dimension);
    return there < unbounded ? there + d.dot(*p.placement.about + p.placement.move) - before.dot(*p.placement.about) : unbounded;
  }
};

double support(const Primitive& shape, const Vec3& direction, int dimension) {
  Vec3 clean = direction;
  for (int a = 0; a < 3; ++a)
    if (std::abs(clean[a]) < 1e-14 * direction.norm()) clean[a] = 0;
  return std::visit(Reach{clean, dimension}, shape);
}

Bounds common(const Bounds& a, const Bounds& b) { return {a.low.cwiseMax(b.low), a.high.cwiseMin(b.high)}; }

struct Extent {
  int dimension;

  Bounds operator()(const Box& box) const { return kept(box.low, box.high); }
  Bounds operator()(const Slab& slab) const {
    Vec3 low = Vec3::Constant(-unbounded), high = Vec3::Constant(unbounded);
    low[slab.axis] = slab.low;
    high[slab.axis] = slab.high;
    return kept(low, high);
  }
  Bounds operator()(const Sphere& s) const {
    return kept(s.center - Vec3::Constant(s.radius), s.center + Vec3::Constant(s.radius));
  }
  Bounds operator()(const Cylinder& c) const { return round(c.axis, c.center, c.radius, c.low, c.high); }
  Bounds operator()(const TubeShape& t) const { return round(t.axis, t.center, t.outer, t.low, t.high); }
  Bounds operator()(const Cone& c) const { return round(c.axis, c.center, std::max(c.low_radius, c.high_radius), c.low, c.high); }
  Bounds operator()(const Ellipsoid& e) const { return kept(e.center - e.semi_axes, e.center + e.semi_axes); }
  Bounds operator()(const HalfSpace& half) const {
    Vec3 low = Vec3::Constant(-unbounded), high = Vec3::Constant(unbounded);
    for (int a = 0; a < dimension; ++a) {
      Vec3 others = half.normal;
      for (int b = 0; b < 3; ++b)
        if (b == a || b >= dimension) others[b] = 0;
      if (!others.isZero(0)) continue;
      (half.normal[a] > 0 ? high : low)[a] = half.point[a];
    }
    return kept(low, high);
  }
  Bounds operator()(const Revolution& r) const {
    double radius = 0, low = unbounded, high = -unbounded;
    for (const auto& [from_axis, along] : r.points) {
      radius = std::max(radius, from_axis);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    return round(r.axis, r.center, radius, low, high);
  }
  Bounds operator()(const Stl& stl) const { return stl.read->bounds(); }
  Bounds operator()(const Union& of) const {
    Bounds all;
    for (const Primitive& each : of.shapes) all.include(bounds(each, dimension));
    return all;
  }
  Bounds operator()(const Intersection& of) const {
    Bounds all = bounds(of.shapes[0], dimension);
    for (const Primitive& each : of.shapes) all = common(all, bounds(each, dimension));
    return all;
  }
  Bounds operator()(const Difference& of) const { return bounds(of.shapes[0], dimension); }
  Bounds operator()(const Placed& p) const {
    Vec3 low, high;
    for (int a = 0; a < 3; ++a) {
      high[a] = support(p, Vec3::Unit(a), dimension);
      low[a] = -support(p, -Vec3::Unit(a), dimension);
    }
    return kept(low, high);
  }

  Bounds round(int axis, const Vec3& center, double radius, double low, double high) const {
    Vec3 lowest = center - Vec3::Constant(radius), highest = center + Vec3::Constant(radius);
    lowest[axis] = low;
    highest[axis] = high;
    return kept(lowest, highest);
  }
  /// The unused axes are the point 0.
  Bounds kept(Vec3 low, Vec3 high) const {
    for (int a = dimension; a < 3; ++a) low[a] = high[a] = 0;
    return {low, high};
  }
};

double longest(const Vec3& size, int dimension) {
  double most = size[0];
  for (int a = 1; a < dimension; ++a) most = std::max(most, size[a]);
  return most;
}
double content(const Vec3& size, int dimension) {
  double product = size[0];
  for (int a = 1; a < dimension; ++a) product *= size[a];
  return product;
}
double half_diagonal(const Vec3& size, int dimension) {
  double square = 0;
  for (int a = 0; a < dimension; ++a) square += size[a] * size[a];
  return 0.5 * std::sqrt(square);
}

bool is_axis_aligned(const Primitive& shape) { return std::holds_alternative<Box>(shape) || std::holds_alternative<Slab>(shape); }

/// Does a distance take microseconds?
bool is_slow(const Primitive& shape) {
  return std::visit(
      [](const auto& each) {
        using Type = std::decay_t<decltype(each)>;
        if constexpr (requires { each.shapes; })
          return std::any_of(each.shapes.begin(), each.shapes.end(), [](const Primitive& part) { return is_slow(part); });
        else if constexpr (std::is_same_v<Type, Placed>) return is_slow(each.shape[0]);
        else return std::is_same_v<Type, Stl>;
      },
      shape);
}
bool is_slow(const Shape& shape) {
  return is_slow(shape.base) ||
         std::any_of(shape.removed.begin(), shape.removed.end(), [](const Primitive& each) { return is_slow(each); });
}

/// What a cell about a place counts beside its content: 1, or the length of the circle that the place runs round the axis; or
/// many weights at once, the first of which says when the sum has settled.
template <class Value>
using Way = std::function<Value(const Vec3& middle, const Vec3& size)>;
double leading(double value) { return value; }
double leading(const Integrals& values) { return values[0]; }
double once(const Vec3&, const Vec3&) { return 1.0; }
double round_the_axis(const Vec3& x, const Vec3&) { return 2.0 * std::numbers::pi * x[0]; }

/// Exact volume of boxes and slabs less boxes and slabs: the window is cut along every face, each piece is in or out.
template <class Value>
Value volume_of_boxes(const Shape& shape, const Bounds& window, int dimension, const Way<Value>& weight, const Value& zero) {
  std::array<std::vector<double>, 3> cuts;
  for (int a = 0; a < 3; ++a) cuts[a] = {a < dimension ? window.low[a] : 0, a < dimension ? window.high[a] : 1};
  for (const Primitive& removed : shape.removed) {
    const Bounds part = bounds(removed, dimension);
    for (int a = 0; a < dimension; ++a)
      for (const double cut : {part.low[a], part.high[a]})
        if (cut > window.low[a] && cut < window.high[a]) cuts[a].push_back(cut);
  }
  for (auto& cut : cuts) std::sort(cut.begin(), cut.end());
  Value total = zero;
  for (std::size_t i = 0; i + 1 < cuts[0].size(); ++i)
    for (std::size_t j = 0; j + 1 < cuts[1].size(); ++j)
      for (std::size_t k = 0; k + 1 < cuts[2].size(); ++k) {
        const Vec3 low(cuts[0][i], cuts[1][j], cuts[2][k]), high(cuts[0][i + 1], cuts[1][j + 1], cuts[2][k + 1]);
        if (signed_distance(shape, 0.5 * low + 0.5 * high, dimension) < 0)
          total += (high - low).prod() * weight(0.5 * (low + high), high - low);
      }
  return total;
}

/// Share of a box of the given size in which distance + normal.x < 0, x from its centre (after Scardovelli and Zaleski,
/// J. Comput. Phys. 164, 2000: inclusion-exclusion over the corners).
double share_below_plane(double distance, const Vec3& normal, const Vec3& size, int dimension) {
  std::array<double, 3> m{};
  double sum = 0;
  for (int a = 0; a < dimension; ++a) sum += m[a] = std::abs(normal[a]) * size[a];
  int count = 0;
  for (int a = 0; a < dimension; ++a)
    if (m[a] > 1e-4 * sum) m[count++] = m[a];  // a nearly parallel axis would only cost digits
  if (count == 0) return distance < 0 ? 1 : 0;
  sum = 0;
  for (int a = 0; a < count; ++a) sum += m[a];
  const double alpha = 0.5 * sum - distance;
  if (alpha <= 0) return 0;
  if (alpha >= sum) return 1;
  double total = 0, scale = 1;
  for (int a = 0; a < count; ++a) scale *= m[a] * (a + 1);
  for (int corner = 0; corner < (1 << count); ++corner) {
    double rest = alpha;
    int sign = 1;
    for (int a = 0; a < count; ++a)
      if (corner & (1 << a)) rest -= m[a], sign = -sign;
    if (rest > 0) total += sign * std::pow(rest, count);
  }
  return std::clamp(total / scale, 0.0, 1.0);
}

/// Volume of the part of one cell inside the shape, the surface in it taken as a plane.
double share(const Shape& shape, const Vec3& center, const Vec3& size, double distance, int dimension) {
  Vec3 gradient = Vec3::Zero();
  const double beyond = std::abs(distance) + 0.3 * size.head(dimension).maxCoeff();
  for (int a = 0; a < dimension; ++a) {
    const double step = 0.25 * size[a];
    Vec3 below = center, above = center;
    below[a] -= step;
    above[a] += step;
    gradient[a] =
        (signed_distance(shape, above, dimension, beyond) - signed_distance(shape, below, dimension, beyond)) / (2 * step);
  }
  const double length = gradient.norm();
  if (!(length > 1e-3)) return distance < 0 ? 1 : 0;
  return share_below_plane(distance, gradient / length, size, dimension);
}

/// The numbers that make a primitive; a component that means nothing is zero.
std::vector<double> numbers_of(Primitive shape) {
  std::vector<double> numbers{double(shape.index())};
  const auto take = [&](const std::vector<Primitive>& parts) {
    numbers.push_back(double(parts.size()));
    for (const Primitive& part : parts) {
      const std::vector<double> of_part = numbers_of(part);
      numbers.insert(numbers.end(), of_part.begin(), of_part.end());
    }
  };
  std::visit(
      [&](auto& each) {
        if constexpr (requires {
                        each.axis;
                        each.center;
                      })
          each.center[each.axis] = 0.0;
        for_each_field(each, [&](const auto& member, const Key&) {
          using Member = std::decay_t<decltype(member)>;
          if constexpr (std::is_same_v<Member, Vec3>) numbers.insert(numbers.end(), member.begin(), member.end());
          else if constexpr (std::is_same_v<Member, std::optional<Vec3>>)
            numbers.insert(numbers.end(), member->begin(), member->end());
          else if constexpr (std::is_same_v<Member, std::vector<Primitive>>) take(member);
          else if constexpr (std::is_same_v<Member, std::string>) numbers.insert(numbers.end(), member.begin(), member.end());
          else if constexpr (std::is_same_v<Member, Polygon>)
            for (const auto& point : member) numbers.insert(numbers.end(), point.begin(), point.end());
          else numbers.push_back(double(member));
        });
        if constexpr (std::is_same_v<std::decay_t<decltype(each)>, Placed>) take(each.shape);
      },
      shape);
  return numbers;
}

}  // namespace

bool same_shape(const Primitive& one, const Primitive& other) { return numbers_of(one) == numbers_of(other); }

double signed_distance(const Primitive& shape, const Vec3& x, int dimension, double beyond) {
  return std::visit(Distance{x, dimension, beyond}, shape);
}

double signed_distance(const Shape& shape, const Vec3& x, int dimension, double beyond) {
  double distance = signed_distance(shape.base, x, dimension, beyond);
  for (const Primitive& removed : shape.removed) distance = std::max(distance, -signed_distance(removed, x, dimension, beyond));
  return distance;
}

Bounds bounds(const Primitive& shape, int dimension) { return std::visit(Extent{dimension}, shape); }

Bounds bounds(const Shape& shape, int dimension) { return bounds(shape.base, dimension); }

bool is_bounded(const Primitive& shape, int dimension) {
  const Bounds box = bounds(shape, dimension);
  for (int a = 0; a < dimension; ++a)
    if (!(box.high[a] - box.low[a] < 1e200)) return false;
  return true;
}

Placed placed(const Primitive& shape, const Placement& placement, int dimension) {
  Placed of{placement, {shape}, Mat3::Identity()};
  if (!of.placement.about) of.placement.about = middle(shape, dimension);
  if (const double angle = placement.rotate.norm(); angle > 0)
    of.turn = Eigen::AngleAxisd(angle * std::numbers::pi / 180.0, placement.rotate / angle).toRotationMatrix();
  return of;
}

bool has_one_face(const Primitive& shape) { return shape.index() >= Primitive(Ellipsoid{}).index(); }

bool is_mirrored(const Primitive& shape, int axis, double at, int dimension) {
  const Bounds box = bounds(shape, dimension);
  const double size = box.high[axis] - box.low[axis];
  if (std::abs(box.low[axis] + box.high[axis] - 2 * at) > 2e-6 * size) return false;
  if (const auto* cone = std::get_if<Cone>(&shape)) return cone->axis != axis || cone->low_radius == cone->high_radius;
  if (shape.index() <= Primitive(Ellipsoid{}).index()) return true;
  constexpr int along = 29;
  const Vec3 step = (box.high - box.low) / (along - 1);
  const double near = 0.1 * size;  // farther off one is as good as another
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < (dimension > 1 ? along : 1); ++j)
      for (int k = 0; k < (dimension > 2 ? along : 1); ++k) {
        const Vec3 x = box.low + Vec3(i, j, k).cwiseProduct(step);
        Vec3 image = x;
        image[axis] = 2 * at - x[axis];
        if (std::abs(signed_distance(shape, x, dimension, near) - signed_distance(shape, image, dimension, near)) > 1e-6 * size)
          return false;
      }
  return true;
}

Vec3 middle(const Primitive& shape, int dimension) {
  const Bounds box = bounds(shape, dimension);
  Vec3 center = Vec3::Zero();
  for (int a = 0; a < dimension; ++a)
    if (box.high[a] < 1e200) center[a] = 0.5 * (box.low[a] + box.high[a]);
  return center;
}

namespace {

// Cells that the surface may cross are halved level by level. Each level gives an estimate with an error of second order
// in the cell size (curvature of the surface, edges), so two levels are extrapolated; it ends when that has settled.
template <class Value>
Value summed(const Shape& shape, const Bounds& given_window, int dimension, const Way<Value>& weight, const Value& zero,
             std::size_t most_cells = 3'000'000) {
  assert(dimension >= 1 && dimension <= 3);
  const Bounds window = common(given_window, bounds(shape, dimension));
  for (int a = 0; a < dimension; ++a)
    if (!(window.low[a] < window.high[a])) return zero;
  if (is_axis_aligned(shape.base) && shape.removed.size() <= 40 &&
      std::all_of(shape.removed.begin(), shape.removed.end(), is_axis_aligned))
    return volume_of_boxes<Value>(shape, window, dimension, weight, zero);

  // A wall may be thinner than any cell that can be afforded: take it as the difference of two solid cylinders.
  if (const auto* tube = std::get_if<TubeShape>(&shape.base); tube && tube->inner > 0 && has_radius(tube->axis, dimension)) {
    const auto solid = [&](double radius) {
      return summed<Value>(
          {Cylinder{.axis = tube->axis, .center = tube->center, .radius = radius, .low = tube->low, .high = tube->high},
           shape.removed},
          window, dimension, weight, zero, most_cells);
    };
    return Value(solid(tube->outer) - solid(tube->inner));
  }

  Vec3 size = Vec3::Ones();
  for (int a = 0; a < dimension; ++a) size[a] = window.high[a] - window.low[a];
  if (!(longest(size, dimension) < 1e100)) return Value(zero + std::numeric_limits<double>::infinity());

  if (is_slow(shape)) most_cells = std::min(most_cells, std::size_t{200'000});
  constexpr double settled = 1e-6;
  std::vector<Vec3> crossed{0.5 * (window.low + window.high)}, finer;
  Value inside = zero, last_estimate = zero, last_extrapolated = zero;
  for (int level = 0; level < 60; ++level) {
    const double most = longest(size, dimension);
    std::array<int, 3> pieces{1, 1, 1};
    bool all_halved = true;
    for (int a = 0; a < dimension; ++a) {
      if (size[a] > 0.5 * most) pieces[a] = 2;
      else all_halved = false;
    }
    Vec3 cell = size;
    for (int a = 0; a < dimension; ++a) cell[a] /= pieces[a];
    const double reach = half_diagonal(cell, dimension);
    const double cell_volume = content(cell, dimension);
    finer.clear();
    Value estimate = zero;
    for (const Vec3& center : crossed)
      for (int i = 0; i < pieces[0]; ++i)
        for (int j = 0; j < pieces[1]; ++j)
          for (int k = 0; k < pieces[2]; ++k) {
            const std::array<int, 3> at{i, j, k};
            Vec3 x = center;
            for (int a = 0; a < dimension; ++a) x[a] += (at[a] + 0.5) * cell[a] - 0.5 * size[a];
            const double distance = signed_distance(shape, x, dimension, reach);
            if (distance >= reach) continue;
            if (distance <= -reach) {
              inside += cell_volume * weight(x, cell);
              continue;
            }
            estimate += cell_volume * weight(x, cell) * share(shape, x, cell, distance, dimension);
            finer.push_back(x);
          }
    crossed.swap(finer);
    size = cell;
    estimate += inside;
    const Value extrapolated = all_halved && level > 0 ? Value((4 * estimate - last_estimate) / 3) : estimate;
    const bool steady =
        level >= 4 && std::abs(leading(extrapolated) - leading(last_extrapolated)) <= settled * std::abs(leading(extrapolated));
    last_estimate = estimate;
    last_extrapolated = extrapolated;
    if (crossed.empty()) return inside;
    if ((steady && all_halved) || crossed.size() * (std::size_t{1} << dimension) > most_cells) break;
  }
  return last_extrapolated;
}

}  // namespace

double volume(const Shape& shape, const Bounds& window, int dimension) {
  if (const auto* stl = std::get_if<Stl>(&shape.base)) {
    const double whole = stl->read->volume(window);
    if (shape.removed.empty()) return whole;
    return whole - volume({Intersection{{Union{shape.removed}, shape.base}}, {}}, window, dimension);
  }
  if (const auto* of = std::get_if<Placed>(&shape.base); of && shape.removed.empty()) {
    const Bounds box = bounds(shape.base, dimension);
    const Vec3 before = of->before(Vec3::Zero());
    bool all = true;
    for (int a = 0; a < dimension; ++a) all = all && window.low[a] <= box.low[a] && window.high[a] >= box.high[a];
    if (all) return volume({of->shape[0], {}}, bounds(of->shape[0], dimension), dimension);
    if (of->turn.isIdentity(0.0)) return volume({of->shape[0], {}}, {window.low + before, window.high + before}, dimension);
  }
  return std::max(summed<double>(shape, window, dimension, once, 0.0), 0.0);
}

Integrals integrals(const Shape& shape, const Bounds& window, int dimension,
                    const std::function<Integrals(const Vec3&)>& weights) {
  // The mean over a cell by two Gauss points along each axis, exact for cubics.
  const auto mean = [&](const Vec3& middle, const Vec3& size) {
    Integrals sum = Integrals::Zero();
    for (int corner = 0; corner < 1 << dimension; ++corner) {
      Vec3 x = middle;
      for (int a = 0; a < dimension; ++a) x[a] += (corner >> a & 1 ? 0.5 : -0.5) * size[a] / std::numbers::sqrt3;
      sum += weights(x);
    }
    return Integrals(sum / (1 << dimension));
  };
  return summed<Integrals>(shape, window, dimension, mean, Integrals::Zero(), 300'000);
}

double volume_of_revolution(const Shape& shape, const Bounds& window) {
  Bounds right = window;
  right.low[0] = std::max(right.low[0], 0.0);
  return std::max(summed<double>(shape, right, 2, round_the_axis, 0.0), 0.0);
}

}  // namespace undex
