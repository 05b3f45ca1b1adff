// Field snapshots of a run: particles of fluid and of bodies as H5Part, bodies of finite elements as VTKHDF.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "run/simulation.hpp"
#include "output/particle_fields.hpp"
#include "output/structure_fields.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// The next time at which the output has a snapshot after `time` [s]; infinity when there is none.
double next_snapshot_after(const scene::Output& output, double time);

class Snapshots {
 public:
  /// Of the simulation, which must outlive it, into folder/fields. Where the run goes on, the files that are there are gone on
  /// with: visit_state says how far.
  Snapshots(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder, bool goes_on);
  /// A file that the checkpoint does not know (the scene wants fields now) is begun.
  void visit_state(StateVisitor& state);
  double next_after(double time) const { return next_snapshot_after(wanted_, time); }
  void write() { write(false); }
  /// The last sound state, after a NumericalStop, whether or not the scene asked for snapshots. A particle or cell of which a
  /// value is not finite all the same has `not_finite` = 1, and 0 stands for that value. False: the scene wants no fields of
  /// what it has.
  bool write_at_stop();

 private:
  /// A body's file, by what the body is made of; neither where the scene wants none of it.
  struct BodyFile {
    const DeformableBody* body;
    std::string name;
    std::optional<output::ParticleFields> particles;
    std::optional<output::StructureFields> cells;
  };
  bool is_open() const { return water_ || obstacles_ || !bodies_.empty(); }
  void open(bool goes_on);
  void write(bool at_stop);

  const Simulation& simulation_;
  std::filesystem::path folder_;
  scene::Output wanted_;
  const std::vector<fem::Settings>& structures_;
  double last_time_ = -1.0;
  std::optional<output::ParticleFields> water_;
  std::vector<BodyFile> bodies_;
  std::optional<output::StructureFields> obstacles_;  ///< their surfaces
};

}  // namespace undex::run
