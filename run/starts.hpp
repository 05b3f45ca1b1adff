// Every way in which a run may begin.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "run/stages.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// "spherical start", "plane wave", "start from run"; empty for a plain one.
std::string start_words(scene::Start::Kind kind);

struct StartOptions {
  Stages* stages = nullptr;      ///< told how far what takes long has come
  std::string numerics;          ///< what the digits depend on beside the scene: a checkpoint of another is not begun from
  std::filesystem::path output;  ///< of the run, from which it cannot begin; empty: none
  std::vector<std::filesystem::path> receivers = {};  ///< scenes that wait for this one's state
};

/// Lays the scene's start on its bodies. Returns lines that say what was done, without the kind of start; empty where there is
/// nothing to say. Throws
/// SceneError where the scene does not allow its start, and FileError.
std::string begin(scene::Scene& scene, const StartOptions& options = {});

}  // namespace undex::run
