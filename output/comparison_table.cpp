#include "output/comparison_table.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/errors.hpp"

namespace undex::output {

namespace {

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

std::string print(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Four significant digits, without exponents for the magnitudes that occur in a table; times to a hundredth.
std::string number(double value, const std::string& unit) {
  if (std::isnan(value)) return "-";
  if (unit == "us") return print("%.2f", value);
  const double size = std::abs(value);
  if (size >= 1e5 || (size > 0 && size < 1e-4)) return print("%.3e", value);
  return print(size >= 100 ? "%.1f" : size >= 10 ? "%.2f" : size >= 0.1 ? "%.3f" : "%.4f", value);
}

std::string difference(double mine, double theirs, const std::string& unit) {
  if (std::isnan(mine) || std::isnan(theirs)) return "";
  if (unit == "us") return print("%+.2f", mine - theirs);
  return theirs == 0 ? "" : print("%+.1f%%", 100 * (mine - theirs) / std::abs(theirs));
}

// Terminal columns of UTF-8 text.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded_left(const std::string& text, std::size_t columns) {
  return std::string(columns - width(text), ' ') + text;
}

std::string padded_right(const std::string& text, std::size_t columns) {
  return text + std::string(columns - width(text), ' ');
}

}  // namespace

ReferenceTable read_reference_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file)
    throw FileError("cannot read " + path.string() + ": " + std::strerror(errno) + "; check the reference table's path");
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

std::string format_comparison(const NamedNumbers& metrics, const ReferenceTable& reference, std::size_t max_width) {
  std::vector<std::vector<std::string>> lines{{"", "this run"}};
  for (const std::string& source : reference.sources) {
    lines[0].push_back(source);
    lines[0].push_back("");
  }
  for (const ReferenceTable::Row& row : reference.rows) {
    const auto mine = std::find_if(metrics.begin(), metrics.end(), [&](const auto& m) { return m.first == row.metric; });
    if (mine == metrics.end()) continue;
    const double value = mine->second * row.scale;
    std::vector<std::string> line{row.label + (row.unit.empty() ? "" : " [" + row.unit + "]"), number(value, row.unit)};
    for (const ReferenceTable::Value& theirs : row.values) {
      line.push_back(number(theirs.value, row.unit) +
                     (std::isnan(theirs.uncertainty) ? "" : "±" + print("%g", theirs.uncertainty)));
      line.push_back(difference(value, theirs.value, row.unit));
    }
    lines.push_back(std::move(line));
  }

  // A source's name spans its two columns: value and difference.
  std::vector<std::size_t> widths(lines[0].size(), 0);
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t c = 0; c < widths.size(); ++c)
      if (l > 0 || c < 2) widths[c] = std::max(widths[c], width(lines[l][c]));
  for (std::size_t c = 2; c < widths.size(); c += 2) {
    const std::size_t both = widths[c] + 1 + widths[c + 1], name = width(lines[0][c]);
    if (name > both) widths[c] += name - both;
  }

  // As many sources side by side as fit; the others below, with the run's values once more.
  const std::size_t left = widths[0] + 3 + widths[1];
  std::string text;
  for (std::size_t begin = 2; begin < widths.size();) {
    std::size_t end = begin, total = left;
    while (end < widths.size() && (end == begin || total + 4 + widths[end] + widths[end + 1] <= max_width)) {
      total += 4 + widths[end] + widths[end + 1];
      end += 2;
    }
    if (begin > 2) text += "\n";
    for (std::size_t l = 0; l < lines.size(); ++l) {
      bool known = l == 0 || begin == 2;
      for (std::size_t c = begin; c < end; c += 2) known = known || lines[l][c] != "-";
      if (!known) continue;
      std::string line = padded_right(lines[l][0], widths[0]) + "   " + padded_left(lines[l][1], widths[1]);
      for (std::size_t c = begin; c < end; c += 2)
        line += "   " + (l == 0 ? padded_left(lines[0][c], widths[c] + 1 + widths[c + 1])
                                : padded_left(lines[l][c], widths[c]) + " " +
                                      padded_left(lines[l][c + 1], widths[c + 1]));
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n" + (l == 0 ? std::string(total, '-') + "\n" : "");
    }
    begin = end;
  }
  return text;
}

}  // namespace undex::output
