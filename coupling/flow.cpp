#include "coupling/flow.hpp"

#include <Eigen/Geometry>
#include <numbers>

#include "core/errors.hpp"

namespace undex::coupling {
namespace {

std::vector<RigidObstacle> built(const std::vector<Obstacle>& given, const sph::Settings& fluid) {
  std::vector<RigidObstacle> obstacles;
  for (const Obstacle& each : given) obstacles.emplace_back(each, fluid);
  return obstacles;
}

/// Pressure on the faces of a surface under forces F [N] on its nodes. A node has that which on its share g of the surface comes
/// nearest to F = p g, and a face the mean of its nodes', weighted by |g|.
std::vector<double> pressures(const WetSurface& surface, const std::vector<Vec3>& place, std::span<const Vec3> force,
                              bool axisymmetric) {
  std::vector<Vec3> share(place.size(), Vec3::Zero());  // into the body
  for (const auto& face : surface.faces) {
    const std::array<Vec3, 4> corner = corners_of(face, place);
    const Vec3 area = 0.5 * (corner[2] - corner[0]).cross(corner[3] - corner[1]);
    if (!is_segment(face)) {
      for (const int n : face) share[std::size_t(n)] += 0.25 * area;
      continue;
    }
    for (const auto& [n, m] : {std::pair{face[0], face[1]}, {face[1], face[0]}}) {
      const double r = place[std::size_t(n)][0], other = place[std::size_t(m)][0];
      share[std::size_t(n)] += (axisymmetric ? 2.0 * std::numbers::pi * (r / 3.0 + other / 6.0) : 0.5) * area;
    }
  }
  std::vector<double> pressure;
  for (const auto& face : surface.faces) {
    double pushed = 0, size = 0;
    for (const int k : face) {
      const auto n = std::size_t(k);
      const double weight = share[n].norm();
      if (weight > 0.0) pushed += force[n].dot(share[n]) / weight;
      size += weight;
    }
    pressure.push_back(size > 0.0 ? pushed / size : 0.0);
  }
  return pressure;
}

void append(std::vector<double>& all, const Vec3& v) { all.insert(all.end(), v.data(), v.data() + 3); }

}  // namespace

Flow::Flow(sph::Fluid& fluid, const std::vector<Obstacle>& obstacles)
    : fluid_(fluid), obstacles_(built(obstacles, fluid.settings())), contacts_(obstacles_, fluid.settings()) {
  for (const RigidObstacle& obstacle : obstacles_) walls_.push_back(fluid_.add_wall(obstacle.wall()));
}

sph::StepLimit Flow::step_limit() {
  sph::StepLimit limit = fluid_.step_limit();
  if (fluid_.settings().numerics.fixed_step) return limit;
  for (const RigidObstacle& obstacle : obstacles_)
    if (obstacle.stable_step() < limit.step)
      limit = {.step = obstacle.stable_step(),
               .criterion = "added mass of " + obstacle.given().name,
               .position = obstacle.body().center(),
               .body = obstacle.body_of_step()};
  return limit;
}

void Flow::step(double dt) {
  if (obstacles_.empty()) return fluid_.step(dt);
  const double start = fluid_.time();
  const std::vector<RigidObstacle> before = obstacles_;
  {
    const auto timer = timers_.measure("obstacles");
    contacts_.expect_room(obstacles_, fluid_.settings(), start);
    for (std::size_t k = 0; k < obstacles_.size(); ++k)
      obstacles_[k].set_out(start, dt, fluid_.wall_force(walls_[k]), fluid_.wall(walls_[k]));
  }
  try {
    fluid_.step(dt);
  } catch (const NumericalStop&) {
    obstacles_ = before;
    throw;
  }
  const auto timer = timers_.measure("obstacles");
  for (std::size_t k = 0; k < obstacles_.size(); ++k) obstacles_[k].arrive(start + dt, dt, fluid_.wall(walls_[k]));
}

BodySnapshot Flow::snapshot() const {
  BodySnapshot all;
  std::vector<double> displacement, velocity, pressure, number;
  for (std::size_t k = 0; k < obstacles_.size(); ++k) {
    const WetSurface& surface = obstacles_[k].surface();
    const std::vector<Vec3> place = obstacles_[k].places();
    const int before = int(all.position.size());
    for (std::size_t n = 0; n < place.size(); ++n) {
      all.position.push_back(place[n]);
      append(displacement, place[n] - surface.nodes[n]);
      append(velocity, obstacles_[k].body().velocity_at(place[n]));
    }
    for (const double p : pressures(surface, place, fluid_.wall_force(walls_[k]), fluid_.settings().axisymmetric))
      pressure.push_back(p);
    for (const auto& face : surface.faces) {
      std::array<int, 8> cell;
      for (int c = 0; c < 8; ++c) cell[std::size_t(c)] = before + face[std::size_t(c % 4)];
      all.cells.push_back(cell);
      number.push_back(double(k));
    }
  }
  all.of_points = {{"displacement", 3, std::move(displacement)}, {"velocity", 3, std::move(velocity)}};
  all.of_cells = {{"pressure", 1, std::move(pressure)}, {"obstacle", 1, std::move(number)}};
  return all;
}

void Flow::visit_state(StateVisitor& state) {
  for (RigidObstacle& obstacle : obstacles_) state.part(obstacle.given().name, [&] { obstacle.visit_state(state); });
  if (!obstacles_.empty()) state("timers", timers_);
}

}  // namespace undex::coupling
