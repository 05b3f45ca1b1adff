// What a scene asks for: water or none, deforming bodies, and the driver that advances them together; or all of it on the
// one-dimensional mesh.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/deformable_body.hpp"
#include "core/meridian.hpp"
#include "coupling/body_group.hpp"
#include "output/run_record.hpp"
#include "run/driver.hpp"
#include "run/line_flow.hpp"
#include "run/stages.hpp"
#include "scene/scene.hpp"
#include "sph_fluid/water/fluid.hpp"

namespace undex::run {

/// Energies [J] of the whole body: what symmetry planes cut off is counted.
struct EnergyBalance {
  double kinetic = 0, internal = 0, dissipated = 0;                     // fluid
  double structure_kinetic = 0, elastic = 0, plastic = 0, viscous = 0;  // structure, or solids in particles
  double obstacle_kinetic = 0;                                          // free rigid bodies
  double work_given = 0, work_received = 0;                             // across the interface
  double external = 0;      // work of prescribed loads on the structure, of rigid planes on solids, of what drives or leads rigid
                            // bodies; the interface's is not in it
  double gravity = 0;       // its work on everything
  double surroundings = 0;  // work of their pressure on the fluid
  double radiated = 0;      // what has left through radiating faces
  double start = 0;         // sum at the start
  double total() const {
    return kinetic + internal + dissipated + structure_kinetic + obstacle_kinetic + elastic + plastic + viscous - external -
           gravity - surroundings + radiated;
  }
  double scale = 0;  // what errors are measured against: docs/theory/equations.md, section 16
  double error() const { return scale > 0 ? (total() - start) / scale : 0.0; }
};

/// What one of several structures has: energies [J] of the whole body.
struct StructureAccount {
  std::string name;
  std::size_t cells = 0;
  long steps = 0;
  double kinetic = 0, elastic = 0, plastic = 0, viscous = 0;
  double received = 0, external = 0, gravity = 0;  ///< work of the water, of loads, of gravity
  double error = 0;                                ///< of its balance, over the largest of these works and energies
  Vec3 impulse = Vec3::Zero();                     ///< from the water, of the computed part, in space [N s]
};

class Simulation {
 public:
  /// An axisymmetric scene is computed in its meridian. `stages` is told what is built. Throws SceneError where a
  /// solver refuses its part of the scene.
  explicit Simulation(const scene::Scene& scene, Stages* stages = nullptr);

  double time() const;
  long steps() const;
  /// One step (a coupling window where two solvers are coupled), not beyond `end` [s].
  void advance(double end);
  /// What the last step was and what set it, in one phrase.
  const std::string& last_step() const { return last_.words; }
  double last_step_size() const { return last_.size; }

  /// What the next step goes on from: all that outlasts a step, of everybody.
  void visit_state(StateVisitor& state);
  /// Goes on from the state of a step that went wrong.
  void find_rates_anew();

  EnergyBalance energy() const;
  double mass_error() const;
  /// Change of momentum of everything together beyond the impulses of gravity, loads and rigid planes, over what all kinetic
  /// energy one way would have (or those impulses, where they are larger). Along the axes to which no wall, support or symmetry
  /// plane gives an impulse of its own; NaN where there is none.
  double momentum_error() const;
  /// Of everything together, of the computed part, in the frame of the solvers [N s].
  Vec3 momentum() const;
  /// The same of the angular momentum about the origin, of solids alone; nothing where there is more, or a
  /// wall, plane, support, load or gravity may turn them.
  std::optional<double> angular_momentum_error() const;
  /// (work given - work received) over the larger of the two across the interface, rigid bodies included (but not less than 1e-6
  /// of all energy, so that rest is no error); nothing where there is no interface.
  std::optional<double> interface_energy_error() const;
  /// |impulse given - impulse received| over all that was exchanged; nothing where there is no interface.
  std::optional<double> interface_impulse_error() const;
  double maximum_pressure() const;
  /// Of each body of the fluid in the scene's order: those of the whole body, what symmetry planes cut off counted; `moment` in
  /// space.
  std::vector<sph::BodyTotals> body_totals() const;
  /// Largest values now of each body, solid and structure, at places in space (of the computed part).
  std::vector<LargestOf> largest() const;
  /// Seconds per pass of all solvers.
  output::NamedNumbers passes() const;

  /// The meridian in which solvers see an axisymmetric scene: their places, and vectors, are (r, axial, 0).
  const std::optional<Meridian>& meridian() const { return meridian_; }
  const sph::Fluid* fluid() const { return fluid_.get(); }  ///< in particles; null: none
  /// Rigid bodies in it, as the solvers see them.
  /// Of all obstacles, as they are now.
  BodySnapshot obstacle_surfaces() const { return flow_ ? flow_->snapshot() : BodySnapshot(); }
  /// Of one of them, in space: along the axis of revolution alone where there is one.
  coupling::ObstacleState obstacle_state(std::size_t which) const;
  std::span<const coupling::RigidObstacle> obstacles() const {
    return flow_ ? std::span(flow_->obstacles()) : std::span<const coupling::RigidObstacle>();
  }
  const LineFlow* line() const { return line_.get(); }  ///< where all is on the one-dimensional mesh; else null
  bool has_fluid() const { return fluid_ || line_; }
  /// A field of the fluid's particles, or of the mesh's cells, at time().
  std::vector<double> fluid_field(const std::string& name) const { return fluid_ ? fluid_->field(name) : line_->field(name); }
  /// What the water has given to the wet faces since the start [N s], of the computed part; nothing where nothing is coupled.
  std::optional<coupling::InterfaceLedger> on_structure() const { return driver_->interface(); }
  /// The same of each of the wet faces that have names; null where there are none.
  const coupling::FaceImpulses* on_faces() const { return driver_->on_faces(); }
  const std::vector<std::unique_ptr<DeformableBody>>& bodies() const { return bodies_; }
  /// Of each structure, in the scene's order, where there are several; else none.
  std::vector<StructureAccount> accounts() const;
  /// Which particle is the fastest, of the water if there is some, and where; empty where there are none.
  std::string fastest_particle() const;

 private:
  void build(const scene::Scene& scene, Stages& stages);
  void settle(Stages& stages);
  /// `solids`: those in particles, if there are some.
  void make_driver(const scene::Scene& scene, solid::Solids* solids);
  void take_start(const scene::Scene& scene);
  double mass() const;
  double all_mass() const;
  /// What has crossed wet faces and the surfaces of rigid bodies.
  std::optional<coupling::InterfaceLedger> interface() const;
  /// Of gravity, loads, rigid planes, and what drives or holds rigid bodies since the start [N s].
  Vec3 impulse() const;
  Vec3 angular_momentum() const;

  std::optional<Meridian> meridian_;
  std::unique_ptr<LineFlow> line_;
  std::unique_ptr<sph::Fluid> fluid_;
  std::unique_ptr<coupling::Flow> flow_;  // the fluid with its obstacles
  std::vector<std::unique_ptr<DeformableBody>> bodies_;
  std::unique_ptr<coupling::BodyGroup> group_;  // of several structures
  std::unique_ptr<Driver> driver_;
  std::vector<WetBody*> followers_;  // what the driver does not advance
  Step last_;
  std::array<bool, 3> mirrored_{};  // across which axes of space is there a symmetry plane?
  double copies_ = 1;               // mirrored copies that the symmetry planes stand for, this one included
  Vec3 gravity_ = Vec3::Zero();
  bool surrounded_ = false;  // does anything press from outside?
  double start_time_ = 0, start_energy_ = 0, start_mass_ = 0;
  double least_scale_ = 0;             // of energies: what pressure and rounding at the start stand for [J]
  std::array<bool, 3> balanced_{};     // axes along which all impulses are booked
  bool closed_ = false;                // does nothing act from outside?
  std::vector<double> start_balance_;  // of each member of the group [J]
  Vec3 start_momentum_ = Vec3::Zero(), start_angular_momentum_ = Vec3::Zero();
};

}  // namespace undex::run
