// What Solids is made of. Set-up and step are in solids.cpp, what others ask in solid_queries.cpp.
#pragma once

#include <memory>
#include <vector>

#include "sph_solid/plane_contact.hpp"
#include "sph_solid/solid_pairs.hpp"
#include "sph_solid/solid_particles.hpp"
#include "sph_solid/solids.hpp"
#include "sph_solid/total_lagrangian.hpp"

namespace undex::solid {

/// A body's particles: one range, in the order of the start.
struct SolidGroup {
  const Body* body;
  std::uint32_t begin, end;
  double spacing, h;                            // [m]
  std::unique_ptr<TotalLagrangian> lagrangian;  // null: updated Lagrangian
  std::vector<OuterLayer> layer;                // towards each rigid plane
};

struct Solids::Implementation {
  sph::Settings around;  // what all particles share, and whether there is water
  Settings settings;
  SolidParticles particles;
  std::vector<SolidGroup> groups;
  std::unique_ptr<SolidPairs> pairs;                                // null where no body is updated and none can touch another
  std::vector<Vec3> acceleration, impulse_force;                    // [m/s^2], [N]
  std::vector<std::pair<std::uint32_t, std::array<bool, 3>>> held;  // particles of supports, and the components that rest
  PassTimers timers;
  double time = 0, last_step = 0;
  long steps = 0;
  Vec3 plane_impulse = Vec3::Zero();  // received from the rigid planes [N s]
  double received_work = 0, plane_work = 0, integrator_jumps = 0, integrator_held = 0, first_step = 0;

  // The meshed wet faces: nodes as material points, and their motion, found when it is asked for.
  WetSurface surface;
  std::vector<BodyPoint> surface_points;
  std::vector<Vec3> surface_position, surface_velocity, surface_acceleration;
  bool surface_has_moved = false;
  std::vector<double> surface_mass, skin_mass;

  Implementation(const Settings& settings, const sph::Settings& around);
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  // Set-up.
  void fill();
  void start_motion(const SolidGroup& group);
  void hold_supports(const SolidGroup& group);
  void start_stress(const SolidGroup& group);
  void share_mass();  // of the particles, among the nodes of the surface
  void find_skin_mass();

  void advance(double t_end, std::span<const Vec3> wet_impulse);
  void spread_impulse(std::span<const Vec3> wet_impulse, double interval);
  void show_surface_motion();
  BodyPoint locate(const Vec3& reference_position) const;
  MaterialPoint read(const BodyPoint& point) const;
  double stable_step() const;

  // The step: kick, drift, stresses and forces, kick (central differences, exact for a step that varies).
  void step(double dt);
  void meet_planes(double dt);
  void find_touching(double dt);
  void book_images(double interval);
  void release();
  double gap(const SolidGroup& group, std::size_t plane, std::uint32_t particle) const;  // to touching [m]
  bool may_touch(const SolidGroup& group, std::size_t plane, std::uint32_t particle) const;
  void find_forces(double dt);
  void find_acceleration();
  void hold(std::vector<Vec3>& vectors) const;  // zeroes what supports hold
  double held_back(double dt) const;

  void visit_state(StateVisitor& state);

  const SolidGroup& group_of(std::uint32_t particle) const;
  std::uint32_t fastest() const;  // the particle that limits the step
  /// Throws NumericalStop where a step's new stresses or forces cannot be gone on with. Positions and velocities are left in
  /// the middle of the step, between its two kicks, and finite; stresses are those that went wrong.
  void expect_sound(double dt);
  std::string description_of(std::uint32_t particle, const char* what, double dt) const;
};

}  // namespace undex::solid
