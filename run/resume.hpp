// A run that goes on: from which checkpoint, and whether its scene is still that of the checkpoint.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/checkpoint.hpp"
#include "scene/scene.hpp"

namespace undex::run {

struct Continued {
  std::optional<output::Checkpoint> checkpoint;  ///< empty: there is none yet, and the run begins at its start
  std::string words;                             ///< what is gone on from, in a sentence
  std::vector<std::string> warnings;             ///< checkpoints that were passed over
};

/// The newest checkpoint of the folder that is whole. Where the folder's resolved.toml is gone it is put back. Throws UsageError
/// where the folder is no run's, RestartError where every checkpoint is damaged or the digits are those of other numerics.
Continued find_checkpoint(const std::filesystem::path& folder, const std::string& numerics);

/// Throws RestartError where a key that the state depends on has changed since the checkpoint.
void require_same_scene(const Continued& continued, const scene::Scene& scene);

/// Has the run come to the scene's end, with its record written?
bool is_done(const std::filesystem::path& folder, const Continued& continued, const scene::Scene& scene);

}  // namespace undex::run
