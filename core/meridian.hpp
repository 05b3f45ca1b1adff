// The meridian half-plane of bodies of revolution: places (r, axial, 0), and the way from space into it and back.
#pragma once

#include "core/vector.hpp"

namespace undex {

struct Meridian {
  int axis = 2;                ///< 0, 1, 2: along which coordinate the axis of revolution runs
  Vec3 center = Vec3::Zero();  ///< a point on it, 0 along it [m]

  Vec3 along() const { return Vec3::Unit(axis); }
  /// Of the half-plane that stands for all: x, or y about the axis x.
  Vec3 outward() const { return Vec3::Unit(axis == 0 ? 1 : 0); }
  /// Away from the axis at a place in space [m], of unit length; on the axis as above.
  Vec3 outward_at(const Vec3& x) const;

  /// A place in space [m] as (r, axial, 0).
  Vec3 place(const Vec3& x) const;
  /// A vector at that place, its part round the axis left out.
  Vec3 vector(const Vec3& v, const Vec3& outward) const;

  /// A place of the meridian in the half-plane towards `outward`, in space [m].
  Vec3 place_in_space(const Vec3& m, const Vec3& outward) const;
  Vec3 vector_in_space(const Vec3& v, const Vec3& outward) const;
  /// A tensor with the axes (r, axial, round).
  Mat3 tensor_in_space(const Mat3& s, const Vec3& outward) const;
};

}  // namespace undex
