#include "core/mass_properties.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/triangle_surface.hpp"

namespace undex {
namespace {

struct Round {
  double volume, middle;  // along the axis
  double about, across;   // moments about the axis and about a line across it through the middle
};

/// Truncated cone (or cylinder) of radii a at z = 0 and b at z = h. With r linear in z, the integrals of r^2 z^k and r^4 are
/// polynomials.
Round cone(double a, double b, double h) {
  const double square = (a * a + a * b + b * b) / 3.0, first = (a * a + 2.0 * a * b + 3.0 * b * b) / 12.0,
               second = (a * a + 3.0 * a * b + 6.0 * b * b) / 30.0,
               fourth = (a * a * a * a + a * a * a * b + a * a * b * b + a * b * b * b + b * b * b * b) / 5.0;
  Round r;
  r.volume = pi * h * square;
  r.middle = h * first / square;
  r.about = 0.5 * pi * h * fourth;
  r.across = 0.5 * r.about + pi * h * h * h * second - r.volume * r.middle * r.middle;
  return r;
}

struct Measure {
  int dimension;
  bool of_revolution;

  MassProperties along_axis(int axis, const Vec3& center, double low, const Round& r) const {
    MassProperties m;
    m.volume = r.volume;
    m.centroid = center;
    m.centroid[axis] = low + r.middle;
    m.inertia.diagonal().setConstant(r.across);
    m.inertia(axis, axis) = r.about;
    return m;
  }

  /// Of a body in the plane: its moment about z counts.
  static MassProperties plane(double area, const Vec3& middle, double moment) {
    MassProperties m{area, Vec3(middle[0], middle[1], 0.0), Mat3::Zero()};
    m.inertia(2, 2) = moment;
    return m;
  }

  MassProperties operator()(const Slab& slab) const {
    return {slab.high - slab.low, Vec3(0.5 * (slab.low + slab.high), 0.0, 0.0), Mat3::Zero()};
  }
  MassProperties operator()(const Box& box) const {
    const Vec3 size = box.high - box.low, middle = 0.5 * (box.low + box.high);
    if (of_revolution) {
      const double inner = std::max(box.low[0], 0.0), outer = box.high[0];
      return {pi * (outer * outer - inner * inner) * size[1], Vec3(0.0, middle[1], 0.0), Mat3::Zero()};
    }
    if (dimension == 1) return {size[0], Vec3(middle[0], 0.0, 0.0), Mat3::Zero()};
    const double area = size[0] * size[1], square = size.head<2>().squaredNorm();
    if (dimension == 2) return plane(area, middle, area * square / 12.0);
    MassProperties m{area * size[2], middle, Mat3::Zero()};
    for (int a = 0; a < 3; ++a) m.inertia(a, a) = m.volume * (size.squaredNorm() - size[a] * size[a]) / 12.0;
    return m;
  }
  MassProperties operator()(const Sphere& s) const {
    const double r = s.radius;
    if (of_revolution) return {4.0 / 3.0 * pi * r * r * r, Vec3(0.0, s.center[1], 0.0), Mat3::Zero()};
    if (dimension == 1) return {2.0 * r, Vec3(s.center[0], 0.0, 0.0), Mat3::Zero()};
    if (dimension == 2) return plane(pi * r * r, s.center, 0.5 * pi * r * r * r * r);
    MassProperties m{4.0 / 3.0 * pi * r * r * r, s.center, Mat3::Zero()};
    m.inertia.diagonal().setConstant(0.4 * m.volume * r * r);
    return m;
  }
  MassProperties operator()(const Cylinder& c) const {
    if (dimension < 3 && c.axis >= dimension) return (*this)(Sphere{c.center, c.radius});
    if (dimension < 3) {
      Box box;
      box.low = c.center - Vec3::Constant(c.radius), box.high = c.center + Vec3::Constant(c.radius);
      box.low[c.axis] = c.low, box.high[c.axis] = c.high;
      return (*this)(box);
    }
    return along_axis(c.axis, c.center, c.low, cone(c.radius, c.radius, c.high - c.low));
  }
  MassProperties operator()(const TubeShape& t) const {
    if (dimension < 3) {
      const auto disc = [&](double r) { return (*this)(Sphere{t.center, r}); };
      const MassProperties outer = disc(t.outer), inner = disc(t.inner);
      return {outer.volume - inner.volume, outer.centroid, outer.inertia - inner.inertia};
    }
    const double h = t.high - t.low;
    const Round outer = cone(t.outer, t.outer, h), inner = cone(t.inner, t.inner, h);
    return along_axis(t.axis, t.center, t.low,
                      {outer.volume - inner.volume, outer.middle, outer.about - inner.about, outer.across - inner.across});
  }
  MassProperties operator()(const Cone& c) const {
    const double h = c.high - c.low, a = c.low_radius, b = c.high_radius;
    if (of_revolution) {
      const Round r = cone(a, b, h);
      return {r.volume, Vec3(0.0, c.low + r.middle, 0.0), Mat3::Zero()};
    }
    if (dimension == 3) return along_axis(c.axis, c.center, c.low, cone(a, b, h));
    // A trapezium: strips of width 2 r(z).
    const double area = h * (a + b), middle = h * (a + 2.0 * b) / (3.0 * (a + b));
    const double second = h * h * h * (a + 3.0 * b) / 6.0 - area * middle * middle;  // along
    const double cubes = h * (a * a * a + a * a * b + a * b * b + b * b * b) / 6.0;  // across
    Vec3 centroid = c.center;
    centroid[c.axis] = c.low + middle;
    return plane(area, centroid, second + cubes);
  }
  MassProperties operator()(const Ellipsoid& e) const {
    const Vec3& s = e.semi_axes;
    if (of_revolution) return {4.0 / 3.0 * pi * s[0] * s[0] * s[1], Vec3(0.0, e.center[1], 0.0), Mat3::Zero()};
    if (dimension == 1) return {2.0 * s[0], Vec3(e.center[0], 0.0, 0.0), Mat3::Zero()};
    if (dimension == 2) return plane(pi * s[0] * s[1], e.center, 0.25 * pi * s[0] * s[1] * s.head<2>().squaredNorm());
    MassProperties m{4.0 / 3.0 * pi * s.prod(), e.center, Mat3::Zero()};
    for (int a = 0; a < 3; ++a) m.inertia(a, a) = 0.2 * m.volume * (s.squaredNorm() - s[a] * s[a]);
    return m;
  }
  MassProperties operator()(const HalfSpace& half) const { return integrated(half); }
  MassProperties operator()(const Revolution& r) const { return integrated(r); }
  MassProperties operator()(const Stl& stl) const {
    const Mat3& moments = stl.read->second_moment();
    return {stl.read->volume(), stl.read->centroid(), moments.trace() * Mat3::Identity() - moments};
  }
  MassProperties operator()(const Union& of) const { return integrated(of); }
  MassProperties operator()(const Intersection& of) const { return integrated(of); }
  MassProperties operator()(const Difference& of) const { return integrated(of); }
  MassProperties operator()(const Placed& p) const {
    MassProperties m = mass_properties(p.shape[0], dimension, of_revolution);
    m.centroid = p.after(m.centroid);
    m.inertia = p.turn * m.inertia * p.turn.transpose();
    if (dimension < 3) m.inertia(0, 0) = m.inertia(1, 1) = 0;
    return m;
  }

  /// By subdivision, as volumes are.
  MassProperties integrated(const Primitive& of) const {
    const Shape shape{of, {}};
    Bounds box = bounds(of, dimension);
    MassProperties m;
    if (of_revolution) {
      box.low[0] = std::max(box.low[0], 0.0);
      const Integrals sums = integrals(shape, box, 2, [](const Vec3& x) -> Integrals {
        const double length = 2.0 * pi * x[0];
        return (Integrals() << length, length * x[1], 0, 0, 0, 0, 0, 0, 0, 0).finished();
      });
      m.volume = volume_of_revolution(shape, box);
      m.centroid[1] = sums[1] / sums[0];
      return m;
    }
    m.volume = volume(shape, box, dimension);
    const Vec3 near = middle(of, dimension);
    const Integrals sums = integrals(shape, box, dimension, [&](const Vec3& x) -> Integrals {
      const Vec3 r = x - near;
      return (Integrals() << 1, r[0], r[1], r[2], r[0] * r[0], r[1] * r[1], r[2] * r[2], r[1] * r[2], r[2] * r[0], r[0] * r[1])
          .finished();
    });
    Vec3 offset = Vec3::Zero();
    for (int a = 0; a < dimension; ++a) offset[a] = sums[1 + a] / sums[0];
    m.centroid = near + offset;
    for (int a = dimension; a < 3; ++a) m.centroid[a] = 0.0;
    Mat3 moments;
    moments << sums[4], sums[9], sums[8], sums[9], sums[5], sums[7], sums[8], sums[7], sums[6];
    moments -= sums[0] * offset * offset.transpose();
    if (dimension == 2) m.inertia(2, 2) = moments(0, 0) + moments(1, 1);
    if (dimension == 3) m.inertia = moments.trace() * Mat3::Identity() - moments;
    return m;
  }
};

}  // namespace

MassProperties mass_properties(const Primitive& shape, int dimension, bool of_revolution) {
  return std::visit([&](const auto& each) { return Measure{dimension, of_revolution}(each); }, shape);
}

}  // namespace undex
