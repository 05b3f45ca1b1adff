// What a run's resolved.toml says, read without the checks of a scene: runs of older and newer programs can be compared.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/vector.hpp"
#include "judge/radial.hpp"
#include "study/run_labels.hpp"

namespace undex::study {

struct RunProbe {
  std::string kind;           ///< "fluid", "wall", "structure"
  Vec3 point = Vec3::Zero();  ///< [m]
};

struct ResolvedScene {
  int dimension = 3;
  RunSettings settings;  ///< all that bears on the physics and its discretisation
  std::map<std::string, RunProbe> probes;
  std::vector<std::string> probe_order;  ///< as in the scene
  std::string compared_probe;            ///< comparison.probe; may be empty
  std::optional<judge::Axis> axis;       ///< of the structure, where it is round
};

/// Reads the text of a resolved.toml. Throws SceneError, naming `file`, where it is not TOML.
ResolvedScene read_resolved(const std::string& text, const std::string& file);

}  // namespace undex::study
