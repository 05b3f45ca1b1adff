// The blocks of the table that compares runs: which quantities stand in it, and how.
#pragma once

#include <vector>

#include "judge/comparison_table.hpp"
#include "study/compared.hpp"
#include "study/run_comparison.hpp"

namespace undex::study {

/// Quantities that two runs or more have, at those times [s]: pressures by their peak, means and impulse; motion, strain,
/// energies.
std::vector<ComparedBlock> history_blocks(const std::vector<Compared>& all, const std::vector<double>& times);

/// The metrics of the scenes' comparisons, but for those at given times, which the histories have.
ComparedBlock result_block(const std::vector<ComparedRun>& runs);

ComparedBlock cost_block(const std::vector<ComparedRun>& runs);

/// The ledgers' errors at the end.
ComparedBlock error_block(const std::vector<ComparedRun>& runs);

/// How far the runs are from each other over their common time.
ComparedBlock norm_block(const std::vector<Compared>& all);

/// A block per source of the reference table, for comparison.csv.
std::vector<ComparedBlock> reference_blocks(const std::vector<ComparedRun>& runs, const judge::ReferenceTable& table);

}  // namespace undex::study
