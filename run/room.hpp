// What a run would take of the machine, from volumes and counts alone: nothing is laid out to know.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace undex::run {

struct Room {
  double particles = 0;        ///< of fluid
  double solid_particles = 0;  ///< of solids
  double wall_particles = 0;   ///< in lined rigid walls
  double cells = 0;            ///< of a structure
  double line_cells = 0;       ///< of the one-dimensional mesh, at most
  double bytes = 0;            ///< of memory, to a third
};
Room room_of(const scene::Scene& scene);

/// Memory that a process may have at most [bytes]: the machine's, or less by the limits of its control group or of its shell.
double memory_limit();

/// One line. Throws SceneError at the spacing (or at the structure's cells) where the memory would not hold the run.
std::string expect_room(const scene::Scene& scene);

/// Of snapshots and histories [bytes].
double bytes_on_disk(const scene::Scene& scene);

/// What is probably not meant, and what the machine may not have room for; `output` is the run's folder.
std::vector<std::string> warnings_of(const scene::Scene& scene, const std::filesystem::path& output);

}  // namespace undex::run
