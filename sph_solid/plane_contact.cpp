#include "sph_solid/plane_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sph_fluid/pairs/sums.hpp"
#include "sph_solid/bins.hpp"
#include "sph_solid/solids_implementation.hpp"

namespace undex::solid {

using sph::blocked_sum;

OuterLayer outer_layer(const RigidPlane& plane, const Body& body, const SolidParticles& p, std::uint32_t begin, std::uint32_t end,
                       double spacing, int dimension) {
  const Bounds box = bounds(body.shape, dimension);
  const double side = side_of(plane), face = side > 0 ? box.low[plane.axis] : box.high[plane.axis];
  double lowest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = begin; i < end; ++i) lowest = std::min(lowest, side * (p.start[i][plane.axis] - face));
  if (!(lowest > 0.25 * spacing && lowest < 0.75 * spacing)) return {0.5 * spacing, false};
  for (std::uint32_t i = begin; i < end; ++i) {
    const double above = side * (p.start[i][plane.axis] - face) - lowest;
    if (above > 1e-6 * spacing && above < 0.4 * spacing) return {0.5 * spacing, false};
  }
  return {lowest, true};
}

void add_upper_layers(const std::vector<RigidPlane>& planes, const std::vector<Vec3>& x, const std::vector<PlaneSet>& touching,
                      std::uint32_t begin, std::uint32_t end, double spacing, double reach, std::vector<PlaneSet>& backed) {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const PlaneSet bit = PlaneSet(1) << k;
    const auto across = [&](std::uint32_t i) {
      Vec3 place = x[i];
      place[planes[k].axis] = 0.0;
      return place;
    };
    std::vector<Vec3> layer;
    for (std::uint32_t i = begin; i < end; ++i)
      if (touching[i] & bit) layer.push_back(across(i));
    if (layer.empty()) continue;
    const Bins bins(layer, spacing);
#pragma omp parallel for schedule(static)
    for (std::uint32_t i = begin; i < end; ++i) {
      if ((backed[i] & bit) || !(height(planes[k], x[i]) < reach)) continue;
      const Vec3 here = across(i);
      bins.around(here, [&](std::uint32_t below) {
        if ((layer[below] - here).squaredNorm() < spacing * spacing) backed[i] |= bit;
      });
    }
  }
}

// ---- As a part of the step ------------------------------------------------------------------------------------------

namespace {
/// What counts as lying on a plane, and the least distance from it, in spacings.
constexpr double near_enough = 1e-9, least_height = 0.05;
}  // namespace

double Solids::Implementation::gap(const SolidGroup& group, std::size_t plane, std::uint32_t i) const {
  return height(settings.planes[plane], particles.x[i]) - group.layer[plane].half;
}

bool Solids::Implementation::may_touch(const SolidGroup& group, std::size_t plane, std::uint32_t i) const {
  return !group.lagrangian || group.lagrangian->may_touch(plane, i);
}

/// Particles that lie on a plane at the end of a drift of dt [s], and do not leave it, touch it.
void Solids::Implementation::find_touching(double dt) {
  for (std::size_t k = 0; k < settings.planes.size(); ++k) {
    const RigidPlane& plane = settings.planes[k];
    for (const SolidGroup& group : groups)
#pragma omp parallel for schedule(static)
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const double speed = side_of(plane) * particles.v[i][plane.axis];
        if (speed > 0.0 || gap(group, k, i) + dt * speed > near_enough * group.spacing) continue;
        if (may_touch(group, k, i)) particles.touching[i] |= PlaneSet(1) << k;
      }
  }
}

/// A particle leaves a plane when it moves away from it and its stress would pull.
void Solids::Implementation::release() {
  for (std::size_t k = 0; k < settings.planes.size(); ++k) {
    const RigidPlane& plane = settings.planes[k];
    const PlaneSet bit = PlaneSet(1) << k;
    const int a = plane.axis;
#pragma omp parallel for schedule(static)
    for (std::uint32_t i = 0; i < particles.size(); ++i) {
      if (!(particles.touching[i] & bit) || !(side_of(plane) * particles.v[i][a] > 0.0)) continue;
      if (particles.deviator[a][i] - particles.pressure[i] - particles.viscous_pressure[i] > 0.0) particles.touching[i] &= ~bit;
    }
  }
}

/// What the images behind rigid planes do to the bodies over an interval [s]. Particles push each other by equal and opposite
/// forces, so that the sum of all forces along a plane's normal is that of the images.
void Solids::Implementation::book_images(double interval) {
  std::array<bool, 3> booked{};
  for (const RigidPlane& plane : settings.planes) {
    if (std::exchange(booked[plane.axis], true)) continue;
    plane_impulse[plane.axis] += interval * blocked_sum<double>(0, std::uint32_t(particles.size()),
                                                                [&](std::uint32_t i) { return particles.force[i][plane.axis]; });
  }
}

namespace {

/// What a rigid plane does to particles: work [J] and impulse along its normal [N s].
struct Push {
  double work = 0, impulse = 0;
  void operator+=(const Push& other) {
    work += other.work;
    impulse += other.impulse;
  }
};

}  // namespace

/// Particles that no mirror holds stop at a distance of half a spacing from a plane; what that takes of the kinetic energy is
/// work on the plane. (Half of their present thickness would be nearer the truth, and the plane would work on a particle that
/// flattens.) Those that touch bounce off a least distance from it, and all particles off symmetry planes, as off their images.
void Solids::Implementation::meet_planes(double dt) {
  find_touching(dt);
  const auto bounce = [&](std::uint32_t i, int axis, double side, double above) -> Push {
    double& v = particles.v[i][axis];
    if (!(side * v < 0.0 && above + side * v * dt < 0.0)) return {};
    v = -v;
    return {.work = 0.0, .impulse = 2.0 * particles.mass[i] * v};
  };
  for (const SolidGroup& group : groups) {
    for (int a = 0; a < around.dimension; ++a)
      if (around.symmetry.axis[a])
#pragma omp parallel for schedule(static)
        for (std::uint32_t i = group.begin; i < group.end; ++i) bounce(i, a, 1.0, particles.x[i][a]);
    for (std::size_t k = 0; k < settings.planes.size(); ++k) {
      const RigidPlane& plane = settings.planes[k];
      const double side = side_of(plane);
      const Push push = blocked_sum<Push>(group.begin, group.end, [&](std::uint32_t i) -> Push {
        if (particles.touching[i] >> k & 1)
          return bounce(i, plane.axis, side, height(plane, particles.x[i]) - least_height * group.spacing);
        double& v = particles.v[i][plane.axis];
        const double slowest = std::min(0.0, -gap(group, k, i) / dt);  // what has come to lie too deep is not thrown out
        if (side * v >= slowest) return {};
        const double before = v, earlier = v - 0.5 * (dt + last_step) * acceleration[i][plane.axis];
        v = side * slowest;
        // The impulse does its work over the half steps before and after it.
        const double impulse = particles.mass[i] * (v - before);
        return {.work = 0.5 * impulse * (earlier + v), .impulse = impulse};
      });
      plane_work += push.work;
      plane_impulse[plane.axis] += push.impulse;
    }
  }
}

}  // namespace undex::solid
