#include "core/bilinear_patch.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace undex {

Vec3 blended(const std::array<double, 4>& weight, const std::array<Vec3, 4>& corner) {
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2] + weight[3] * corner[3];
}

Vec3 blended(const std::array<double, 4>& weight, const std::array<int, 4>& face, std::span<const Vec3> nodal) {
  return weight[0] * nodal[face[0]] + weight[1] * nodal[face[1]] + weight[2] * nodal[face[2]] + weight[3] * nodal[face[3]];
}

Vec3 slope_along_u(const std::array<Vec3, 4>& corner, double v) {
  return (1 - v) * (corner[1] - corner[0]) + v * (corner[2] - corner[3]);
}

Vec3 slope_along_v(const std::array<Vec3, 4>& corner, double u) {
  return (1 - u) * (corner[3] - corner[0]) + u * (corner[2] - corner[1]);
}

double BilinearPatch::Frame::element(double behind) const {
  return (foot_u + behind * normal_u).cross(foot_v + behind * normal_v).dot(normal);
}

BilinearPatch::Frame BilinearPatch::frame(double u, double v) const {
  const std::array<double, 4> weight = bilinear_weights(u, v);
  Frame f;
  f.foot = blended(weight, corner), f.foot_u = slope_along_u(corner, v), f.foot_v = slope_along_v(corner, u);
  const Vec3 blend = blended(weight, normal), blend_u = slope_along_u(normal, v), blend_v = slope_along_v(normal, u);
  const double length = blend.norm();
  f.normal = blend / length;
  f.normal_u = (blend_u - f.normal.dot(blend_u) * f.normal) / length;
  f.normal_v = (blend_v - f.normal.dot(blend_v) * f.normal) / length;
  return f;
}

bool BilinearPatch::project(const Vec3& place, double size, PatchPoint& at, double beyond) const {
  for (int k = 0; k < 8; ++k) {
    const Frame f = frame(at.u, at.v);
    const Vec3 miss = place - (f.foot - at.distance * f.normal);
    Mat3 jacobian;
    jacobian << f.foot_u - at.distance * f.normal_u, f.foot_v - at.distance * f.normal_v, -f.normal;
    const Vec3 step = jacobian.inverse() * miss;
    at.u += step[0], at.v += step[1], at.distance += step[2];
    if (!(std::abs(at.u - 0.5) < beyond && std::abs(at.v - 0.5) < beyond)) return false;
    if (std::abs(step[0]) + std::abs(step[1]) < 1e-10 && std::abs(step[2]) < 1e-10 * size) return true;
  }
  return false;
}

}  // namespace undex
