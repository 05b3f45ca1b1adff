// curves.csv: what undex plot draws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "judge/comparison_table.hpp"
#include "study/compared.hpp"

namespace undex::study {

/// Every history that two runs or more have, one sample a line, for plots; and the points that the sources of a reference table
/// give of the compared probe's motion.
std::string curves_csv(const std::vector<Compared>& all, const std::vector<std::string>& labels,
                       const std::optional<judge::ReferenceTable>& table);

}  // namespace undex::study
