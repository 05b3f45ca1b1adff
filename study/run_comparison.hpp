// Several runs beside each other: values at common times, their differences, norms. Pure functions from histories to
// blocks of a table; how blocks become text stands at the end.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "output/series.hpp"

namespace undex::study {

/// One quantity as each run recorded it.
struct Quantity {
  std::string probe;                 ///< whose: a probe's name, or "energy"
  std::string name, unit;            ///< "radial displacement", "m"
  std::vector<output::Series> runs;  ///< one per run; empty where the run does not have it
  output::Series reference;          ///< may be empty

  std::string title() const { return probe + ": " + name; }
  /// How many runs have it.
  std::size_t count() const;
};

/// [s]; empty when end <= begin.
struct TimeRange {
  double begin = 0, end = 0;
};
/// The time that all runs that have the quantity cover.
TimeRange common_range(const Quantity& quantity);

/// Round times in begin..end, five to ten of them, and the end itself where it lies off the last by more than a quarter
/// of a step.
std::vector<double> round_times(double begin, double end);

/// A row of the table: one value per run (NaN: not known), a reference, and how far each run is from the first and from the
/// reference, where that means something (NaN: it does not).
struct ComparedRow {
  std::string label, unit;  ///< the unit in which it is shown; may be empty
  std::vector<double> values;
  double reference = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> from_first;  ///< percent; of times (unit us) the difference itself
  std::vector<double> from_reference;
};

struct ComparedBlock {
  std::string title;
  std::vector<ComparedRow> rows;
};

/// A row with its differences. No difference is given from a base of no more than `floor`.
ComparedRow compared(std::string label, std::string unit, std::vector<double> values, double floor = 0,
                     double reference = std::numeric_limits<double>::quiet_NaN());

/// The quantity at each of the times [s], and its largest magnitude over the common range where `with_largest`. In units
/// that suit a table (mm, MPa, kJ). No percentages of less than a hundredth of the first run's largest value.
ComparedBlock values_at(const Quantity& quantity, const std::vector<double>& times, bool with_largest);

/// Only the largest magnitude over the common range, and when it was.
ComparedBlock largest_value(const Quantity& quantity);

/// Mean (L1) and root-mean-square (L2) difference of each run from the first, and from the reference, over the common
/// range, in percent of the largest value of what it is measured against there: a row "..., L1" and a row "..., L2" per
/// quantity; "... from the reference" where that is the base. The first run's own is NaN.
ComparedBlock difference_norms(const std::vector<Quantity>& quantities);

/// The text of blocks for a terminal: titles, a column per run with value, difference from the first run and, in brackets,
/// from the reference, which has the last column. Runs that do not fit into max_width columns follow below.
std::string format_blocks(const std::vector<ComparedBlock>& blocks, const std::vector<std::string>& labels,
                          std::size_t max_width = 120);

/// The header of comparison.csv: quantity, at, unit, a column per run, reference, differences from the first for each run
/// but the first, differences from the reference for each run.
std::string csv_header(const std::vector<std::string>& labels);
/// Its rows, one per row of a block. What is not known is an empty cell.
std::string blocks_csv(const std::vector<ComparedBlock>& blocks);
/// One line of CSV; cells are quoted where they must be.
std::string csv_row(const std::vector<std::string>& cells);

}  // namespace undex::study
