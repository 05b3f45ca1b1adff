// Field snapshots of a run: particles of fluid and of solids as H5Part, the structure as VTKHDF.
#pragma once

#include <filesystem>
#include <optional>

#include "app/simulation.hpp"
#include "output/particle_fields.hpp"
#include "output/structure_fields.hpp"
#include "scene/scene.hpp"

namespace undex::app {

class Snapshots {
 public:
  Snapshots(const scene::Scene& scene, const std::filesystem::path& folder);
  /// The next time at which the scene wants a snapshot after `time` [s]; infinity when there is none.
  double next_after(double time) const;
  void write(const Simulation& simulation);

 private:
  const scene::Output& wanted_;
  std::optional<output::ParticleFields> particles_, solids_;
  std::optional<output::StructureFields> structure_;
};

}  // namespace undex::app
