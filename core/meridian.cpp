#include "core/meridian.hpp"

#include <Eigen/Geometry>

namespace undex {

Vec3 Meridian::outward_at(const Vec3& x) const {
  Vec3 away = x - center;
  away[axis] = 0.0;
  const double r = away.norm();
  return r > 0.0 ? Vec3(away / r) : outward();
}

Vec3 Meridian::place(const Vec3& x) const { return {outward_at(x).dot(x - center), x[axis], 0.0}; }

Vec3 Meridian::vector(const Vec3& v, const Vec3& outward) const { return {v.dot(outward), v[axis], 0.0}; }

Vec3 Meridian::place_in_space(const Vec3& m, const Vec3& outward) const { return center + vector_in_space(m, outward); }

Vec3 Meridian::vector_in_space(const Vec3& v, const Vec3& outward) const { return v[0] * outward + v[1] * along(); }

Mat3 Meridian::tensor_in_space(const Mat3& s, const Vec3& outward) const {
  Mat3 turn;
  turn << outward, along(), outward.cross(along());
  return turn * s * turn.transpose();
}

}  // namespace undex
