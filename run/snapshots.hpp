// Field snapshots of a run: particles of fluid and of solids as H5Part, the structure as VTKHDF.
#pragma once

#include <filesystem>
#include <optional>

#include "run/simulation.hpp"
#include "output/particle_fields.hpp"
#include "output/structure_fields.hpp"
#include "scene/scene.hpp"

namespace undex::run {

class Snapshots {
 public:
  Snapshots(const scene::Scene& scene, const std::filesystem::path& folder);
  /// The next time at which the scene wants a snapshot after `time` [s]; infinity when there is none.
  double next_after(double time) const;
  void write(const Simulation& simulation);
  /// The last sound state, after a NumericalStop, whether or not the scene asked for snapshots. A particle or cell of which a
  /// value is not finite all the same has `not_finite` = 1, and 0 stands for that value. False: the scene wants no fields of
  /// what it has.
  bool write_at_stop(const Simulation& simulation);

 private:
  void open();
  void write(const Simulation& simulation, bool at_stop);

  const scene::Scene& scene_;
  std::filesystem::path folder_;
  const scene::Output& wanted_;
  double last_time_ = -1.0;
  std::optional<output::ParticleFields> particles_, solids_;
  std::optional<output::StructureFields> structure_;
};

}  // namespace undex::run
