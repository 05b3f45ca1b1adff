// A comparison is one way to judge a run: comparison.kind of its scene. Each stands in the file of its name, with its check of
// the scene, its metrics and its title; comparisons.cpp lists them all.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "judge/reference.hpp"
#include "output/evidence.hpp"
#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

struct Verdict {
  output::NamedNumbers metrics;                        ///< NaN: has no value
  output::Reasons missing = {};                        ///< why, of every metric that is NaN
  std::map<std::string, output::Samples> tables = {};  ///< further results, by the names of their files
};

struct Comparison {
  scene::ComparisonKind kind;  ///< its name, its keys, its check of a scene
  const char* title = "";      ///< what is compared
  bool beside_table = true;    ///< shown beside the table that comparison.reference names
  /// Why a metric has no value, where the comparison does not say more itself.
  const char* without_value = "it did not happen before the run's end, or the probes do not show it";
  const char* history = "";  ///< name of a reference history in that table's folder
  /// Which fields of the run's last state it needs (output/evidence.hpp); null: none.
  std::vector<std::string> (*last_fields)(const scene::Scene& scene) = nullptr;
  /// The scene is the one given, before a start has changed it. Throws std::invalid_argument where the histories are no numbers.
  Verdict (*judge)(const scene::Scene& scene, const output::Evidence& evidence, const Reference& reference) = nullptr;
};

/// All comparisons, in the order in which messages name them.
const std::vector<Comparison>& comparisons();

/// The scene's own; null where it has none.
const Comparison* comparison_of(const scene::Scene& scene);

/// What the reader of scenes must know of them.
const std::vector<scene::ComparisonKind>& comparison_kinds();

}  // namespace undex::judge
