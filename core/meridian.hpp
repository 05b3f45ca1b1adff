// The meridian half-plane of bodies of revolution: places (r, axial, 0), and the way from space into it and back.
#pragma once

#include <Eigen/Geometry>

#include <cmath>

#include "core/vector.hpp"

namespace undex {

struct Meridian {
  int axis = 2;                ///< 0, 1, 2: along which coordinate the axis of revolution runs
  Vec3 center = Vec3::Zero();  ///< a point on it, 0 along it [m]

  Vec3 along() const { return Vec3::Unit(axis); }
  /// Of the half-plane that stands for all: x, or y about the axis x.
  Vec3 outward() const { return Vec3::Unit(axis == 0 ? 1 : 0); }
  /// Away from the axis at a place in space [m], of unit length; on the axis as above.
  Vec3 outward_at(const Vec3& x) const {
    Vec3 away = x - center;
    away[axis] = 0.0;
    const double r = away.norm();
    return r > 0.0 ? Vec3(away / r) : outward();
  }

  /// A place in space [m] as (r, axial, 0).
  Vec3 place(const Vec3& x) const { return {outward_at(x).dot(x - center), x[axis], 0.0}; }
  /// A vector at that place, its part round the axis left out.
  Vec3 vector(const Vec3& v, const Vec3& outward) const { return {v.dot(outward), v[axis], 0.0}; }

  /// A place of the meridian in the half-plane towards `outward`, in space [m].
  Vec3 place_in_space(const Vec3& m, const Vec3& outward) const { return center + vector_in_space(m, outward); }
  Vec3 vector_in_space(const Vec3& v, const Vec3& outward) const { return v[0] * outward + v[1] * along(); }
  /// A tensor with the axes (r, axial, round).
  Mat3 tensor_in_space(const Mat3& s, const Vec3& outward) const {
    Mat3 turn;
    turn << outward, along(), outward.cross(along());
    return turn * s * turn.transpose();
  }
};

}  // namespace undex
