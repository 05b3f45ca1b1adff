#include "sph_fluid/water/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sph_fluid/water/fluid_implementation.hpp"

namespace undex::sph {

Fluid::Fluid(const Settings& settings) : self_(std::make_unique<Implementation>(settings)) {}
Fluid::~Fluid() = default;
Fluid::Fluid(Fluid&&) noexcept = default;

const Settings& Fluid::settings() const { return self_->settings; }
std::size_t Fluid::particle_count() const { return self_->all.particles.size(); }
std::size_t Fluid::wall_particle_count() const {
  if (!self_->evaluated) self_->evaluate(self_->all, {.time = self_->clock.time});
  return self_->evaluation.lining().size() + self_->all.images.size();
}
std::vector<std::size_t> Fluid::particles_by_body() const {
  std::vector<std::size_t> counts;
  for (const Group& group : self_->all.groups) counts.push_back(group.end - group.begin);
  return counts;
}
std::vector<std::size_t> Fluid::particles_by_body_at_start() const {
  std::vector<std::size_t> counts;
  for (const Group& group : self_->all.groups) counts.push_back(group.laid);
  return counts;
}
long long Fluid::updates() const { return self_->clock.updates; }
std::size_t Fluid::memory_bytes() const {
  return self_->all.memory_bytes() + self_->local_steps.memory_bytes() + self_->evaluation.memory_bytes();
}
double Fluid::time() const { return self_->clock.time; }
long Fluid::steps() const { return self_->clock.steps; }
long Fluid::substeps() const { return self_->local_steps.substeps(); }
std::vector<std::string> Fluid::fast_bodies() const {
  std::vector<std::string> names;
  for (const Group& group : self_->all.groups)
    if (group.fast) names.push_back(group.body->name);
  return names;
}

MirrorIndex Fluid::add_wall(MirrorWall wall) {
  wall.impulse.assign(wall.position.size(), Vec3::Zero());
  self_->walls.mirrors.push_back(std::move(wall));
  self_->expect_walls();
  return {int(self_->walls.mirrors.size()) - 1};
}
LinedIndex Fluid::add_wall(LinedWall wall) {
  wall.impulse.assign(wall.position.size(), Vec3::Zero());
  self_->walls.lined.push_back(std::move(wall));
  self_->expect_walls();
  return {int(self_->walls.lined.size()) - 1};
}
MirrorWall& Fluid::wall(MirrorIndex index) { return self_->walls.mirrors.at(index.number); }
LinedWall& Fluid::wall(LinedIndex index) { return self_->walls.lined.at(index.number); }
const std::vector<Vec3>& Fluid::wall_force(MirrorIndex index) const {
  return self_->local_steps.wall_force().mirrors.at(index.number);
}
const std::vector<Vec3>& Fluid::wall_force(LinedIndex index) const {
  return self_->local_steps.wall_force().lined.at(index.number);
}

void Fluid::settle(const SettleNews& news) { self_->settle(news); }
StepLimit Fluid::step_limit() { return self_->step_limit(); }
void Fluid::step(double dt) { self_->step(dt); }
void Fluid::visit_state(StateVisitor& state) { self_->visit_state(state); }
void Fluid::find_rates_anew() { self_->find_rates_anew(); }
Ledger Fluid::ledger() const { return self_->ledger(); }
const OnFixedFaces& Fluid::on_fixed_faces() const { return self_->exchange.fixed; }
std::vector<BodyTotals> Fluid::totals() const { return self_->totals(); }
std::vector<LargestOf> Fluid::largest() const { return self_->largest_of_bodies(); }
FluidPoint Fluid::at(const Vec3& point) const { return self_->at(point); }
double Fluid::maximum_pressure() const {
  return self_->largest(
      [&](std::size_t i) { return self_->all.particles.predicted[i].p + self_->settings.surroundings.pressure; });
}
double Fluid::maximum_speed() const {
  const Particles& p = self_->all.particles;
  return std::sqrt(self_->largest([&](std::size_t i) { return p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]; }));
}
Clamps Fluid::clamps() const { return self_->clamps; }
long long Fluid::neighbour_interactions() const { return self_->evaluation.interactions(); }
const PassTimers& Fluid::timers() const { return self_->timers; }
std::vector<double> Fluid::field(std::string_view name) const { return self_->field(name); }

}  // namespace undex::sph
