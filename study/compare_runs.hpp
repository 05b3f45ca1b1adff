// undex compare: finished runs beside each other (docs/reference/outputs.md, "Comparing runs").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace undex::study {

struct CompareOptions {
  std::vector<std::string> runs;    ///< folders of two runs or more; the first is what the others are compared with
  std::filesystem::path reference;  ///< CSV: a table of metrics or a history; may be empty
  std::string times;                ///< "20,40,60" [us]; empty: chosen
  std::string labels;               ///< "FEM,SPH", one per run; empty: made from what differs
  std::filesystem::path output = "out/compare";
  bool force = false;  ///< an output folder that is not empty may be overwritten
};

/// Prints the table and writes comparison.csv and curves.csv. Throws UsageError with everything that is wrong, FileError.
void compare_runs(const CompareOptions& options);

}  // namespace undex::study
