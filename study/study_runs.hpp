// The runs of a study on disk: which are there already, and what a row of its table says of each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "study/study_outcome.hpp"
#include "study/study_table.hpp"
#include "scene/study.hpp"

namespace undex::study {

/// What stands in the folder of a run.
struct RunState {
  bool finished = false;   ///< need not be computed again: done, stopped by the numerics, or by a limit that still holds
  bool resumable = false;  ///< it has begun, and has a checkpoint to go on from
  std::string reason;      ///< why it is to be computed: "not there", "changed: scheme.alpha", "half-finished", ...
  std::filesystem::path folder;
  std::string status = "not run";  ///< see StudyRow
  std::string message;
  output::RunRecord record;
  std::vector<double> cpu_times, wall_times;
};

/// Looks into `folder` for that run. A folder counts as this run's where its resolved.toml says the same (but for the title).
RunState run_state(const std::filesystem::path& folder, const scene::Study& study, const scene::StudyRun& run);

/// The states of all runs. A run that is not in the folder of its name may be in one whose name no run has (an axis was added,
/// a label changed): it is found there.
std::vector<RunState> run_states(const scene::Study& study, const std::filesystem::path& runs_folder);

/// Folders in which no run of the study is.
std::vector<std::filesystem::path> left_over(const std::vector<RunState>& states, const scene::Study& study,
                                             const std::filesystem::path& runs_folder);

/// An empty folder for a run; what an older run of a study left there goes. Throws UsageError where something else is there.
void clear_run_folder(const std::filesystem::path& folder);

}  // namespace undex::study
