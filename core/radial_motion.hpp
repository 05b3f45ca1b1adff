// A motion towards or away from a point or an axis, as a power of the distance from it: what a shell has that implodes.
#pragma once

#include <array>
#include <cmath>

#include "core/record.hpp"
#include "core/vector.hpp"

namespace undex {

struct RadialMotion {
  enum class About { x, y, z, point };
  double speed = 0;   ///< at `radius`, away from the centre [m/s]
  double radius = 0;  ///< [m]
  double power = 0;   ///< of the distance over `radius`
  About about = About::point;
  Vec3 center = Vec3::Zero();  ///< of an axis, a point on it [m]

  /// From the axis or the point to a place [m].
  Vec3 away(const Vec3& x) const {
    Vec3 away = x - center;
    if (about != About::point) away[int(about)] = 0;
    return away;
  }
  /// Velocity [m/s] at a place: along the way from the centre, zero at it.
  Vec3 at(const Vec3& x) const {
    const Vec3 from = away(x);
    const double r = from.norm();
    return r > 0 ? Vec3(speed * std::pow(r / radius, power) / r * from) : Vec3(Vec3::Zero());
  }
};

constexpr auto words(RadialMotion::About) {
  using About = RadialMotion::About;
  return std::to_array<Word<About>>({{"x", About::x}, {"y", About::y}, {"z", About::z}, {"point", About::point}});
}

template <class Visit>
void describe(RadialMotion& motion, Visit&& visit) {
  visit(motion.speed, {.name = "speed",
                       .unit = "m/s",
                       .needed = true,
                       .remedy = "give it at the distance `radius`, e.g. speed = -500",
                       .meaning = "at the distance `radius`, away from the centre (negative: towards it)"});
  visit(motion.radius, {.name = "radius",
                        .unit = "m",
                        .range = Range::length(),
                        .needed = true,
                        .remedy = "give the distance from the centre at which the speed is `speed`",
                        .meaning = "the distance from the centre where the speed is that"});
  visit(motion.power, {.name = "power",
                       .range = Range::between(-10, 10),
                       .meaning = "n of speed (r/radius)^n: -1 about an axis and -2 about a point keep volumes"});
  visit(motion.about, {.name = "about", .meaning = "a point, or an axis"});
  visit(motion.center, {.name = "center", .unit = "m", .range = Range::position(), .meaning = "the point, or one on the axis"});
}

}  // namespace undex
