// What a scene asks for: water or none, deforming bodies, and the driver that advances them together.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/deformable_body.hpp"
#include "output/run_record.hpp"
#include "run/driver.hpp"
#include "scene/scene.hpp"
#include "sph_fluid/water/fluid.hpp"

namespace undex::run {

/// Energies [J] of the whole body: what symmetry planes cut off is counted.
struct EnergyBalance {
  double kinetic = 0, internal = 0, dissipated = 0;                     // fluid
  double structure_kinetic = 0, elastic = 0, plastic = 0, viscous = 0;  // structure, or solids in particles
  double work_given = 0, work_received = 0;                             // across the interface
  double external = 0;  // work of prescribed loads on the structure, of rigid planes on solids
  double gravity = 0;   // its work on everything
  double start = 0;     // sum at the start
  double total() const {
    return kinetic + internal + dissipated + structure_kinetic + elastic + plastic + viscous - external - gravity;
  }
  double scale = 0;  // what errors are measured against
  double error() const { return scale > 0 ? (total() - start) / scale : 0.0; }
};

class Simulation {
 public:
  /// Throws SceneError where a solver refuses its part of the scene.
  explicit Simulation(const scene::Scene& scene);

  double time() const;
  long steps() const;
  /// One step (a coupling window where two solvers are coupled), not beyond `end` [s].
  void advance(double end);
  /// What the last step was and what set it, in one phrase.
  const std::string& last_step() const { return last_.words; }
  double last_step_size() const { return last_.size; }

  EnergyBalance energy() const;
  double mass_error() const;
  /// Relative change of momentum of everything together; NaN where gravity, walls, rigid planes, supports or symmetry planes take
  /// part.
  double momentum_error() const;
  /// The same of the angular momentum about the origin, of solids alone; nothing where there is more or it is not conserved.
  std::optional<double> angular_momentum_error() const;
  /// (work given - work received)/(work given) across the interface; nothing where there is none.
  std::optional<double> interface_energy_error() const;
  /// |impulse given - impulse received| over all that was exchanged; nothing where there is no interface.
  std::optional<double> interface_impulse_error() const;
  double maximum_pressure() const;
  /// Seconds per pass of all solvers.
  output::NamedNumbers passes() const;

  const sph::Fluid* fluid() const { return fluid_.get(); }
  const std::vector<std::unique_ptr<DeformableBody>>& bodies() const { return bodies_; }
  /// Which particle is the fastest, of the water if there is some, and where; empty where there are none.
  std::string fastest_particle() const;

 private:
  void build(const scene::Scene& scene);
  /// `solids`: those in particles, if there are some.
  void make_driver(const coupling::Settings& settings, solid::Solids* solids);
  void take_start(const scene::Scene& scene);
  double mass() const;
  Vec3 momentum() const;
  Vec3 angular_momentum() const;

  std::unique_ptr<sph::Fluid> fluid_;
  std::vector<std::unique_ptr<DeformableBody>> bodies_;
  std::unique_ptr<Driver> driver_;
  std::vector<DeformableBody*> followers_;  // bodies that the driver does not advance
  Step last_;
  double copies_ = 1;  // mirrored copies that the symmetry planes stand for, this one included
  double start_energy_ = 0, start_mass_ = 0;
  double energy_scale_ = 0;  // largest part of the energy met so far
  bool closed_ = false;      // does momentum balance without walls, supports and planes?
  Vec3 start_momentum_ = Vec3::Zero(), start_angular_momentum_ = Vec3::Zero();
};

}  // namespace undex::run
