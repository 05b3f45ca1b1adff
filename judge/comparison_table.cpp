#include "judge/comparison_table.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/errors.hpp"
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

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

}  // namespace

ReferenceTable read_reference_table(const std::filesystem::path& path) {
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
  // Columns: the row's label, a value per run; then per source its value and each run's difference from it.
  const std::size_t n = runs.size(), per_source = n + 1;
  std::vector<std::vector<std::string>> lines(1, {""});
  for (const LabelledMetrics& run : runs) lines[0].push_back(run.label);
  for (const std::string& source : reference.sources) {
    lines[0].push_back(source);
    lines[0].resize(lines[0].size() + n);
  }
  for (const ReferenceTable::Row& row : reference.rows) {
    std::vector<double> values;
    bool known = false;
    for (const LabelledMetrics& run : runs) {
      const double* mine = output::find_number(run.metrics, row.metric);
      known = known || mine;
      values.push_back(mine ? *mine * row.scale : nan);
    }
    if (!known) continue;
    std::vector<std::string> line{row.label + (row.unit.empty() ? "" : " [" + row.unit + "]")};
    for (const double value : values) line.push_back(number(value, row.unit));
    for (const ReferenceTable::Value& theirs : row.values) {
      line.push_back(number(theirs.value, row.unit) +
                     (std::isnan(theirs.uncertainty) ? "" : "±" + print("%g", theirs.uncertainty)));
      for (const double value : values) line.push_back(difference_text(difference(value, theirs.value, row.unit), row.unit));
    }
    lines.push_back(std::move(line));
  }

  // A source's name spans its columns: value and differences.
  std::vector<std::size_t> widths(lines[0].size(), 0);
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t c = 0; c < widths.size(); ++c)
      if (l > 0 || c <= n) widths[c] = std::max(widths[c], width(lines[l][c]));
  const auto source_width = [&](std::size_t c) {
    std::size_t total = widths[c];
    for (std::size_t i = 1; i < per_source; ++i) total += 1 + widths[c + i];
    return total;
  };
  for (std::size_t c = n + 1; c < widths.size(); c += per_source) {
    const std::size_t all = source_width(c), name = width(lines[0][c]);
    if (name > all) widths[c] += name - all;
  }

  // As many sources side by side as fit; the others below, with the runs' values once more.
  std::size_t left = widths[0];
  for (std::size_t r = 1; r <= n; ++r) left += 3 + widths[r];
  std::string text;
  for (std::size_t begin = n + 1; begin < widths.size();) {
    std::size_t end = begin, total = left;
    while (end < widths.size() && (end == begin || total + 3 + source_width(end) <= max_width)) {
      total += 3 + source_width(end);
      end += per_source;
    }
    if (begin > n + 1) text += "\n";
    for (std::size_t l = 0; l < lines.size(); ++l) {
      bool known = l == 0 || begin == n + 1;
      for (std::size_t c = begin; c < end; c += per_source) known = known || lines[l][c] != "-";
      if (!known) continue;
      std::string line = padded_right(lines[l][0], widths[0]);
      for (std::size_t r = 1; r <= n; ++r) line += "   " + padded_left(lines[l][r], widths[r]);
      for (std::size_t c = begin; c < end; c += per_source) {
        line += "   " + padded_left(lines[l][c], l == 0 ? source_width(c) : widths[c]);
        for (std::size_t i = 1; l > 0 && i < per_source; ++i)
          line.append(" ").append(padded_left(lines[l][c + i], widths[c + i]));
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n" + (l == 0 ? std::string(total, '-') + "\n" : "");
    }
    begin = end;
  }
  return text;
}

std::string format_comparison(const output::NamedNumbers& metrics, const ReferenceTable& reference, std::size_t max_width) {
  return format_comparison({{"this run", metrics}}, reference, max_width);
}

}  // namespace undex::judge
