#include "judge/comparison_table.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/text_table.hpp"

namespace undex::judge {

namespace {

using output::difference;
using output::difference_text;
using output::number;
using output::padded_left;
using output::padded_right;
using output::print;
using output::width;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t comma = std::min(line.find(',', start), line.size());
    std::string cell = line.substr(start, comma - start);
    const std::size_t first = cell.find_first_not_of(" \t"), last = cell.find_last_not_of(" \t");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    start = comma + 1;
  }
  return cells;
}

bool read_number(const std::string& text, double& number) {
  char* end = nullptr;
  number = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(number);
}

bool read_value(const std::string& cell, ReferenceTable::Value& value) {
  value = {nan, nan};
  if (cell.empty()) return true;
  const std::size_t sign = cell.find("+-");
  if (!read_number(cell.substr(0, sign), value.value)) return false;
  return sign == std::string::npos || read_number(cell.substr(sign + 2), value.uncertainty);
}

/// The cells of a comparison. Columns: the row's label, a value per run; then per source its value and each run's difference
/// from it. A source's name spans its columns.
class Grid {
 public:
  Grid(const std::vector<LabelledMetrics>& runs, const ReferenceTable& reference)
      : runs_(runs.size()), lines_{heading(runs, reference)} {
    for (const ReferenceTable::Row& row : reference.rows) add_line(runs, row);
    measure();
  }

  std::size_t columns() const { return widths_.size(); }
  std::size_t first_source() const { return runs_ + 1; }

  /// As many sources side by side from `begin` on as fit, one at least: the column behind them.
  std::size_t last_that_fits(std::size_t begin, std::size_t max_width) const {
    std::size_t end = begin, total = left_width();
    while (end < columns() && (end == begin || total + 3 + source_width(end) <= max_width)) {
      total += 3 + source_width(end);
      end += per_source();
    }
    return end;
  }

  /// The sources in columns begin..end, with the runs' values. Below the first block lines that none of them knows are left out.
  std::string block(std::size_t begin, std::size_t end) const {
    std::string text;
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      bool known = l == 0 || begin == first_source();
      for (std::size_t c = begin; c < end; c += per_source()) known = known || lines_[l][c] != "-";
      if (!known) continue;
      text += line(l, begin, end) + "\n";
      if (l == 0) text += std::string(block_width(begin, end), '-') + "\n";
    }
    return text;
  }

 private:
  std::size_t per_source() const { return runs_ + 1; }

  static std::vector<std::string> heading(const std::vector<LabelledMetrics>& runs, const ReferenceTable& reference) {
    std::vector<std::string> cells{""};
    for (const LabelledMetrics& run : runs) cells.push_back(run.label);
    for (const std::string& source : reference.sources) {
      cells.push_back(source);
      cells.resize(cells.size() + runs.size());
    }
    return cells;
  }

  /// A row that no run knows is left out.
  void add_line(const std::vector<LabelledMetrics>& runs, const ReferenceTable::Row& row) {
    std::vector<double> values;
    bool known = false;
    for (const LabelledMetrics& run : runs) {
      const double* mine = output::find_number(run.metrics, row.metric);
      known = known || mine;
      values.push_back(mine ? *mine * row.scale : nan);
    }
    if (!known) return;
    std::vector<std::string> line{row.label + (row.unit.empty() ? "" : " [" + row.unit + "]")};
    for (const double value : values) line.push_back(number(value, row.unit));
    for (const ReferenceTable::Value& theirs : row.values) {
      line.push_back(number(theirs.value, row.unit) +
                     (std::isnan(theirs.uncertainty) ? "" : "±" + print("%g", theirs.uncertainty)));
      for (const double value : values) line.push_back(difference_text(difference(value, theirs.value, row.unit), row.unit));
    }
    lines_.push_back(std::move(line));
  }

  void measure() {
    widths_.assign(lines_[0].size(), 0);
    for (std::size_t l = 0; l < lines_.size(); ++l)
      for (std::size_t c = 0; c < columns(); ++c)
        if (l > 0 || c <= runs_) widths_[c] = std::max(widths_[c], width(lines_[l][c]));
    for (std::size_t c = first_source(); c < columns(); c += per_source()) {
      const std::size_t all = source_width(c), name = width(lines_[0][c]);
      if (name > all) widths_[c] += name - all;
    }
  }

  std::size_t source_width(std::size_t c) const {
    std::size_t total = widths_[c];
    for (std::size_t i = 1; i < per_source(); ++i) total += 1 + widths_[c + i];
    return total;
  }

  /// Of the label and the runs' values.
  std::size_t left_width() const {
    std::size_t left = widths_[0];
    for (std::size_t r = 1; r <= runs_; ++r) left += 3 + widths_[r];
    return left;
  }

  std::size_t block_width(std::size_t begin, std::size_t end) const {
    std::size_t total = left_width();
    for (std::size_t c = begin; c < end; c += per_source()) total += 3 + source_width(c);
    return total;
  }

  std::string line(std::size_t l, std::size_t begin, std::size_t end) const {
    const std::vector<std::string>& cells = lines_[l];
    std::string text = padded_right(cells[0], widths_[0]);
    for (std::size_t r = 1; r <= runs_; ++r) text += "   " + padded_left(cells[r], widths_[r]);
    for (std::size_t c = begin; c < end; c += per_source()) {
      text += "   " + padded_left(cells[c], l == 0 ? source_width(c) : widths_[c]);
      for (std::size_t i = 1; l > 0 && i < per_source(); ++i) text.append(" ").append(padded_left(cells[c + i], widths_[c + i]));
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  }

  std::size_t runs_;
  std::vector<std::vector<std::string>> lines_;  ///< the heading first
  std::vector<std::size_t> widths_;
};

}  // namespace

ReferenceTable read_reference_table(const std::filesystem::path& path) {
  output::require_file(path);
  std::ifstream file(path);
  if (!file) throw FileError("cannot read " + path.string() + ": " + std::strerror(errno) + "; check the reference table's path");
  ReferenceTable table;
  bool header_seen = false;
  long line_number = 0;
  const auto fail = [&](const std::string& what) {
    throw FileError("cannot read " + path.string() + ":" + std::to_string(line_number) + ": " + what);
  };
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = split(line);
    if (!header_seen) {
      header_seen = true;
      if (cells.size() < 5 || cells[0] != "metric" || cells[1] != "label" || cells[2] != "unit" || cells[3] != "scale")
        fail("the header must be metric,label,unit,scale and at least one source");
      table.sources.assign(cells.begin() + 4, cells.end());
      continue;
    }
    if (cells.size() != table.sources.size() + 4)
      fail(std::to_string(cells.size()) + " cells, the header has " + std::to_string(table.sources.size() + 4));
    ReferenceTable::Row row{cells[0], cells[1], cells[2], 1.0, {}};
    if (!read_number(cells[3], row.scale)) fail("scale '" + cells[3] + "' is not a number");
    for (std::size_t i = 4; i < cells.size(); ++i) {
      ReferenceTable::Value value{};
      if (!read_value(cells[i], value)) fail("'" + cells[i] + "' is neither a number nor number+-uncertainty");
      row.values.push_back(value);
    }
    table.rows.push_back(std::move(row));
  }
  if (!header_seen) fail("the file has no header");
  return table;
}

std::string format_comparison(const std::vector<LabelledMetrics>& runs, const ReferenceTable& reference, std::size_t max_width) {
  const Grid grid(runs, reference);
  std::string text;
  for (std::size_t begin = grid.first_source(); begin < grid.columns();) {
    const std::size_t end = grid.last_that_fits(begin, max_width);
    if (begin > grid.first_source()) text += '\n';
    text += grid.block(begin, end);
    begin = end;
  }
  return text;
}

std::string format_comparison(const output::NamedNumbers& metrics, const ReferenceTable& reference, std::size_t max_width) {
  return format_comparison({{"this run", metrics}}, reference, max_width);
}

}  // namespace undex::judge
