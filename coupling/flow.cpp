#include "coupling/flow.hpp"

#include "core/errors.hpp"

namespace undex::coupling {
namespace {

std::vector<RigidObstacle> built(const std::vector<Obstacle>& given, const sph::Settings& fluid) {
  std::vector<RigidObstacle> obstacles;
  for (const Obstacle& each : given) obstacles.emplace_back(each, fluid);
  return obstacles;
}

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

void Flow::visit_state(StateVisitor& state) {
  for (RigidObstacle& obstacle : obstacles_) state.part(obstacle.given().name, [&] { obstacle.visit_state(state); });
  if (!obstacles_.empty()) state("timers", timers_);
}

}  // namespace undex::coupling
