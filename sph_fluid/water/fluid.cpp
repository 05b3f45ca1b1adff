#include "sph_fluid/water/fluid.hpp"

#include <algorithm>
#include <cmath>

#include "sph_fluid/water/solver.hpp"

namespace undex::sph {

Fluid::Fluid(const Settings& settings) : self_(std::make_unique<Implementation>(settings)) {}
Fluid::~Fluid() = default;
Fluid::Fluid(Fluid&&) noexcept = default;

const Settings& Fluid::settings() const { return self_->settings; }
std::size_t Fluid::particle_count() const { return self_->particles.size(); }
std::size_t Fluid::wall_particle_count() const {
  if (!self_->evaluated) self_->evaluate(0.0, 0.0);
  return self_->wall_origin.size() + self_->images.size();
}
std::vector<std::size_t> Fluid::particles_by_body() const {
  std::vector<std::size_t> counts;
  for (const Group& group : self_->groups) counts.push_back(group.end - group.begin);
  return counts;
}
std::size_t Fluid::memory_bytes() const {
  const Implementation& s = *self_;
  std::size_t bytes = s.particles.memory_bytes() + s.blocks.memory_bytes() + s.interactions.capacity() * sizeof(long long) +
                      s.wall_origin.capacity() * (sizeof(Implementation::WallOrigin) + 3 * sizeof(double)) +
                      s.wall_rows.capacity() * sizeof(WallRow) + s.wall_force.capacity() * sizeof(ForceRow) +
                      s.images.memory_bytes() + s.near.images.memory_bytes();
  for (const Group& group : s.groups) bytes += group.cells.memory_bytes();
  for (const Group& group : s.near.groups) bytes += group.cells.memory_bytes();
  bytes += s.near.particles.memory_bytes() + s.near.blocks.memory_bytes();
  return bytes + s.wall_cells.memory_bytes();
}
double Fluid::time() const { return self_->time; }
long Fluid::steps() const { return self_->steps; }
long Fluid::substeps() const { return self_->substeps; }
std::vector<std::string> Fluid::fast_bodies() const {
  std::vector<std::string> names;
  for (const Group& group : self_->groups)
    if (group.fast) names.push_back(group.body->name);
  return names;
}

int Fluid::add_moving_wall(MovingWall wall) {
  wall.impulse.assign(wall.position.size(), Vec3::Zero());
  self_->moving_force.emplace_back(wall.position.size(), Vec3::Zero());
  self_->moving.push_back(std::move(wall));
  self_->everywhere = true;
  self_->join();
  self_->evaluated = false;
  return int(self_->moving.size()) - 1;
}
const std::vector<Vec3>& Fluid::wall_force(int index) const {
  return (self_->choice == PairChoice::all ? self_->moving_force : self_->whole_force).at(index);
}
MovingWall& Fluid::moving_wall(int index) { return self_->moving.at(index); }

StepLimit Fluid::step_limit() { return self_->step_limit(); }
void Fluid::step(double dt) { self_->step(dt); }
Ledger Fluid::ledger() const { return self_->ledger(); }
FluidPoint Fluid::at(const Vec3& point) const { return self_->at(point); }
double Fluid::maximum_pressure() const {
  return self_->largest([&](std::size_t i) { return self_->particles.predicted[i].p; });
}
double Fluid::maximum_speed() const {
  const Particles& p = self_->particles;
  return std::sqrt(self_->largest([&](std::size_t i) { return p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]; }));
}
Clamps Fluid::clamps() const { return self_->clamps; }
long long Fluid::neighbour_interactions() const { return self_->interaction_sum; }
const PassTimers& Fluid::timers() const { return self_->timers; }
std::vector<double> Fluid::field(std::string_view name) const { return self_->field(name); }

}  // namespace undex::sph
