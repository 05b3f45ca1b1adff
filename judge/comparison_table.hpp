// A run's metrics beside reference values, as an aligned text table.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "output/run_record.hpp"

namespace undex::judge {

/// Reference values, read from CSV: a header `metric,label,unit,scale,<source>,<source>,...`, one row per metric; lines
/// beginning with # are comments. Values are in the row's unit: metric * scale. A cell is empty (nothing known), a number,
/// or a number with its uncertainty, `14.40+-0.05`.
struct ReferenceTable {
  struct Value {
    double value, uncertainty;  ///< NaN: nothing known, or no uncertainty stated
  };
  struct Row {
    std::string metric, label, unit;
    double scale;
    std::vector<Value> values;  ///< one per source
  };
  std::vector<std::string> sources;
  std::vector<Row> rows;
};

/// Throws FileError, naming path and line, when the file cannot be read or understood.
ReferenceTable read_reference_table(const std::filesystem::path& path);

/// A run's metrics under the name that heads its column.
struct LabelledMetrics {
  std::string label;
  output::NamedNumbers metrics;
};

/// One line per row of the reference: a value per run, then each source's value and every run's difference from it: in
/// the unit itself for times (unit "us"), in percent for all else. What a run or the source does not have is "-"; rows
/// that no run knows at all (a time that none reached) are left out. Sources that do not fit into max_width columns follow
/// in a further block.
std::string format_comparison(const std::vector<LabelledMetrics>& runs, const ReferenceTable& reference,
                              std::size_t max_width = 120);
/// The same of one run, headed "this run".
std::string format_comparison(const output::NamedNumbers& metrics, const ReferenceTable& reference, std::size_t max_width = 120);

}  // namespace undex::judge
