#include "sph_fluid/walls/moving_walls.hpp"

#include <cstddef>
#include <string>

namespace undex::sph {
namespace {

template <class Wall>
PointLoads zeros(const std::vector<Wall>& walls) {
  PointLoads loads;
  for (const Wall& wall : walls) loads.emplace_back(wall.position.size(), Vec3::Zero());
  return loads;
}

template <class Wall>
PointLoads impulses_of(const std::vector<Wall>& walls) {
  PointLoads loads;
  for (const Wall& wall : walls) loads.push_back(wall.impulse);
  return loads;
}

template <class Wall>
void set_impulses_of(std::vector<Wall>& walls, const PointLoads& impulse) {
  for (std::size_t w = 0; w < walls.size(); ++w) walls[w].impulse = impulse[w];
}

template <class Wall>
void receive_on(std::vector<Wall>& walls, const PointLoads& force, double duration) {
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (std::size_t k = 0; k < force[w].size(); ++k) walls[w].impulse[k] += duration * force[w][k];
}

PointLoads sum_of(PointLoads a, const PointLoads& b) {
  for (std::size_t w = 0; w < a.size(); ++w)
    for (std::size_t k = 0; k < a[w].size(); ++k) a[w][k] += b[w][k];
  return a;
}

WallMotion between(const WallMotion& before, const WallMotion& after, double dt, double share) {
  WallMotion wall = after;
  const double s = share, r = 1.0 - share;
  for (std::size_t k = 0; k < wall.position.size(); ++k) {
    wall.position[k] = r * r * (1.0 + 2.0 * s) * before.position[k] + s * s * (1.0 + 2.0 * r) * after.position[k] +
                       s * r * dt * (r * before.velocity[k] - s * after.velocity[k]);
    wall.velocity[k] = r * before.velocity[k] + s * after.velocity[k];
    if (wall.normal.size() > k) wall.normal[k] = (r * before.normal[k] + s * after.normal[k]).normalized();
  }
  return wall;
}

}  // namespace

WallLoads MovingWalls::unloaded() const { return {zeros(mirrors), zeros(lined)}; }

WallLoads MovingWalls::impulses() const { return {impulses_of(mirrors), impulses_of(lined)}; }

void MovingWalls::set_impulses(const WallLoads& impulse) {
  set_impulses_of(mirrors, impulse.mirrors);
  set_impulses_of(lined, impulse.lined);
}

void MovingWalls::receive(const WallLoads& force, double duration) {
  receive_on(mirrors, force.mirrors, duration);
  receive_on(lined, force.lined, duration);
}

std::vector<WallMotion> MovingWalls::motions() const {
  std::vector<WallMotion> motions;
  for (const MirrorWall& wall : mirrors) motions.push_back({wall.position, wall.velocity, {}});
  for (const LinedWall& wall : lined) motions.push_back({wall.position, wall.velocity, wall.normal});
  return motions;
}

void MovingWalls::show(const std::vector<WallMotion>& motions) {
  std::size_t w = 0;
  for (MirrorWall& wall : mirrors) {
    wall.position = motions[w].position;
    wall.velocity = motions[w++].velocity;
  }
  for (LinedWall& wall : lined) {
    wall.position = motions[w].position;
    wall.velocity = motions[w].velocity;
    wall.normal = motions[w++].normal;
  }
}

void MovingWalls::show_between(const std::vector<WallMotion>& before, const std::vector<WallMotion>& after, double dt,
                               double share) {
  std::vector<WallMotion> motions;
  for (std::size_t w = 0; w < after.size(); ++w) motions.push_back(between(before[w], after[w], dt, share));
  show(motions);
}

void WallMotion::visit_state(StateVisitor& state) {
  state("position", position);
  state("velocity", velocity);
  state("normal", normal);
}

void WallLoads::visit_state(StateVisitor& state) {
  state("mirrors", mirrors);
  state("lined", lined);
}

void MovingWalls::visit_state(StateVisitor& state) {
  std::vector<WallMotion> motion = motions();
  WallLoads impulse = impulses();
  for (std::size_t w = 0; w < motion.size(); ++w)
    state.part("motion " + std::to_string(w), [&] { motion[w].visit_state(state); });
  state.part("impulse", [&] { impulse.visit_state(state); });
  for (std::size_t w = 0; w < lined.size(); ++w)
    state.part("surface " + std::to_string(w), [&] { state("node", lined[w].node); });
  if (!state.restores()) return;
  show(motion);
  set_impulses(impulse);
}

WallLoads sum_of(const WallLoads& a, const WallLoads& b) { return {sum_of(a.mirrors, b.mirrors), sum_of(a.lined, b.lined)}; }

}  // namespace undex::sph
