// A study: one or more scenes computed over a grid of settings, as plain data, read from one TOML file
// (docs/reference/studies.md).
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "scene/scene.hpp"

namespace undex::scene {

/// One value of an axis: what it changes in the scene, or which scene it is.
struct StudyValue {
  std::string label;  ///< as in tables, folder names and `exclude`
  std::vector<Override> settings;
  std::filesystem::path scene;                               ///< of the axis of scenes only
  double number = std::numeric_limits<double>::quiet_NaN();  ///< the value itself, where it is a number
};

struct StudyAxis {
  std::string name;
  bool problem = false;  ///< its values are different problems: their errors are not compared with each other
  std::vector<StudyValue> values;
};

/// What a study measures: a metric of summary.json that is an error itself, or its relative difference from a source of
/// the scene's reference table.
struct StudyError {
  std::string metric, source, label;  ///< empty source: the metric itself
  Where where;
};

/// One run: a combination of values.
struct StudyRun {
  std::string name;                 ///< its labels, fit for a folder's name; distinct
  std::vector<std::size_t> values;  ///< index into each axis
  std::filesystem::path scene;
  std::vector<Override> settings;
  std::string resolved;  ///< what resolved.toml of the run will be
  int dimension = 3;
  std::filesystem::path reference;  ///< the scene's comparison.reference; may be empty
};

struct Study {
  std::string name, title;
  std::filesystem::path file, output;
  std::vector<StudyAxis> axes;
  std::optional<std::size_t> resolution;  ///< the axis whose numbers are lengths that go to zero
  std::vector<StudyError> errors;
  int repeats = 1;                              ///< how often a run is computed; the least CPU time counts
  std::optional<double> cpu_limit, wall_limit;  ///< [s] after which a run is ended
  std::vector<StudyRun> runs;                   ///< without those that are excluded; the last axis varies fastest
};

/// Reads a study (a .toml file, or a folder with study.toml), and the scene of every run, so that no mistake is left for
/// the middle of the night. Throws SceneError with all that was found, FileError when a file cannot be read.
Study read_study(const std::filesystem::path& path, const std::vector<ComparisonKind>& kinds);

}  // namespace undex::scene
