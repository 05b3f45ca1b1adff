// Short names for runs, made of the settings in which they differ.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace undex::study {

/// A run's settings in the order of the file: dotted key ("resolution.spacing", "bodies.water.material.name") and value as
/// text. Lengths are in metres.
using RunSettings = std::vector<std::pair<std::string, std::string>>;

/// Is it something said about a run, and not computed by it (title, probes, output, a source)?
bool is_silent(const std::string& key);

/// A setting that is not the same in all runs; empty text where a run does not have it.
struct DifferingSetting {
  std::string key;
  std::vector<std::string> values;
};

/// The settings that differ, the telling ones first: the scene's name, methods, spacing, cells, materials, the scheme, then
/// the others; those that every run has come before those that some lack.
std::vector<DifferingSetting> differing_settings(const std::vector<RunSettings>& runs);

/// One label per run: the fewest values, in the order given, that tell the runs apart ("sph 3 mm"). Runs that no setting
/// tells apart also get their `names` (their folders).
std::vector<std::string> run_labels(const std::vector<DifferingSetting>& settings, const std::vector<std::string>& names);

}  // namespace undex::study
