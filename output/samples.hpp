// A history in memory, in full precision: what is judged, and what a table of results is made of.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/state.hpp"
#include "output/history.hpp"
#include "output/series.hpp"

namespace undex::output {

/// Named columns of equal length; the first is what the others are given over, mostly the time [s].
struct Samples {
  std::vector<Column> columns;
  std::vector<std::vector<double>> values;  ///< one per column

  Samples() = default;
  explicit Samples(std::vector<Column> names) : columns(std::move(names)), values(columns.size()) {}
  std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
  /// One value per column. Throws std::invalid_argument on a wrong count.
  void append(std::span<const double> row);
  void append(std::initializer_list<double> row) { append(std::span<const double>(row.begin(), row.size())); }
  /// The column of that name over the first; empty where there is none.
  Series series(const std::string& column) const;
  void visit_state(StateVisitor& state);
};

/// Writes them as a CSV history (nine digits). Throws FileError.
void write_history(const std::filesystem::path& path, const Samples& samples);

}  // namespace undex::output
