// A study's rows: what its table says of each run, and the reference tables from which its errors are taken.
#pragma once

#include <filesystem>
#include <map>

#include "judge/comparison_table.hpp"
#include "scene/study.hpp"
#include "study/study_runs.hpp"
#include "study/study_table.hpp"

namespace undex::study {

using References = std::map<std::filesystem::path, judge::ReferenceTable>;

/// The reference tables of the scenes, where an error is a difference from one of their sources. Throws SceneError where one does
/// not have what an error needs, FileError.
References read_references(const scene::Study& study);

/// The errors of a run's ledgers by their names in summary.json; NaN where it has none.
output::NamedNumbers ledger_errors(const output::RunRecord& record);

/// The row that says what is known of a run.
StudyRow row_of(const scene::Study& study, const scene::StudyRun& run, const RunState& state, const References& references);

}  // namespace undex::study
