// One run: a scene computed from start to end, with its histories, fields and record in one folder.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.hpp"

namespace undex::run {

struct RunOptions {
  std::filesystem::path output;  ///< made if it does not exist
  int threads = 0;               ///< 0: the scene's choice, or all the machine has
  int verbosity = 0;             ///< -1 quiet, 0 normal, 1 every step
  std::string scene_text;        ///< the scene file as the user wrote it
  std::string program;           ///< version text for the record
};

/// Computes the scene. Returns the exit code: 0, 130 or 143 (after SIGINT or SIGTERM: what was computed is kept and
/// recorded). Throws NumericalStop after having recorded the last state, SceneError, FileError.
int compute(const scene::Scene& scene, const RunOptions& options);

}  // namespace undex::run
