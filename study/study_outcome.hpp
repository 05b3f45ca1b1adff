// outcome.json: what a study knows of one of its runs beyond the run's own summary.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace undex::study {

struct StudyOutcome {
  std::string status;  ///< see StudyRow
  std::string message;
  std::vector<double> cpu_times_s, wall_times_s;  ///< of each repetition, the kept run's first
  double cpu_limit_s = 0, wall_limit_s = 0;       ///< the limit that ended it; 0: none did
};

/// Throws FileError.
void write_outcome(const std::filesystem::path& path, const StudyOutcome& outcome);
/// Nothing where there is none, or none that can be understood.
std::optional<StudyOutcome> read_outcome(const std::filesystem::path& path);

}  // namespace undex::study
