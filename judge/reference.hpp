// What a run is judged beside: a table of metrics that others got, a reference history.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "judge/comparison_table.hpp"
#include "output/series.hpp"

namespace undex::judge {

struct Reference {
  std::optional<ReferenceTable> table;
  std::vector<output::HistoryColumn> history;

  /// The first column of the history; empty without one.
  output::Series first_history() const { return history.empty() ? output::Series{} : history.front().series; }
};

/// Reads a CSV file that is either, told apart by its header (`metric,...` or `time...`). Throws FileError.
Reference read_reference(const std::filesystem::path& path);

/// Reads a history and checks that it is one. Throws FileError.
std::vector<output::HistoryColumn> read_reference_history(const std::filesystem::path& path);

}  // namespace undex::judge
