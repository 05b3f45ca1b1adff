#include "output/series.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "output/files.hpp"

namespace undex::output {

namespace {

double between(const Series& s, std::size_t left, double t) {
  const double width = s.t[left + 1] - s.t[left];
  if (!(width > 0)) return s.y[left + 1];
  return s.y[left] + (t - s.t[left]) / width * (s.y[left + 1] - s.y[left]);
}

// Integral from the first sample to each sample.
std::vector<double> cumulative(const Series& s) {
  std::vector<double> result(s.t.size(), 0.0);
  for (std::size_t i = 1; i < s.t.size(); ++i) result[i] = result[i - 1] + 0.5 * (s.y[i] + s.y[i - 1]) * (s.t[i] - s.t[i - 1]);
  return result;
}

// Integral from the first sample to t, the ends held constant.
double integral_to(const Series& s, const std::vector<double>& sums, double t) {
  if (t <= s.t.front()) return (t - s.t.front()) * s.y.front();
  if (t >= s.t.back()) return sums.back() + (t - s.t.back()) * s.y.back();
  const auto left = static_cast<std::size_t>(std::upper_bound(s.t.begin(), s.t.end(), t) - s.t.begin()) - 1;
  return sums[left] + 0.5 * (s.y[left] + between(s, left, t)) * (t - s.t[left]);
}

}  // namespace

void require_valid(const Series& series) {
  if (series.t.size() != series.y.size())
    throw std::invalid_argument("series: " + std::to_string(series.t.size()) + " times, " + std::to_string(series.y.size()) +
                                " values");
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    if (!std::isfinite(series.t[i]) || !std::isfinite(series.y[i]))
      throw std::invalid_argument("series: sample " + std::to_string(i) + " is not finite");
    if (i > 0 && series.t[i] < series.t[i - 1])
      throw std::invalid_argument("series: time goes back at sample " + std::to_string(i));
  }
}

bool covers(const Series& series, double a, double b) {
  if (series.t.size() < 2) return false;
  const double slack = 0.02 * std::abs(b);
  return series.t.front() <= a + slack && series.t.back() >= b - std::min(slack, 0.25e-6);
}

double value_held(const Series& s, double t) {
  if (t <= s.t.front()) return s.y.front();
  if (t >= s.t.back()) return s.y.back();
  const auto right = std::upper_bound(s.t.begin(), s.t.end(), t);
  return between(s, static_cast<std::size_t>(right - s.t.begin()) - 1, t);
}

double value_at(const Series& series, double t) { return covers(series, t, t) ? value_held(series, t) : nan; }

double integral(const Series& series, double a, double b) {
  if (!covers(series, a, b)) return nan;
  const auto sums = cumulative(series);
  return integral_to(series, sums, b) - integral_to(series, sums, a);
}

Series moving_average(const Series& series, double window) {
  Series result;
  if (series.t.size() < 2) return result;
  const auto sums = cumulative(series);
  result.t = series.t;
  result.y.reserve(series.t.size());
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    const double a = std::max(series.t[i] - 0.5 * window, series.t.front());
    const double b = std::min(series.t[i] + 0.5 * window, series.t.back());
    result.y.push_back(b > a ? (integral_to(series, sums, b) - integral_to(series, sums, a)) / (b - a) : series.y[i]);
  }
  return result;
}

Extremum maximum(const Series& series, double a, double b) {
  Extremum result{nan, nan};
  for (std::size_t i = 0; i < series.t.size(); ++i)
    if (series.t[i] >= a && series.t[i] <= b && !(series.y[i] <= result.y)) result = {series.t[i], series.y[i]};
  return result;
}

double first_rise(const Series& series, double level, double a, double b) {
  bool below = false;
  for (std::size_t i = 0; i < series.t.size() && series.t[i] <= b; ++i) {
    if (series.t[i] < a) continue;
    if (series.y[i] < level) {
      below = true;
    } else if (below) {
      const double rise = series.y[i] - series.y[i - 1];
      return series.t[i] - (series.y[i] - level) / rise * (series.t[i] - series.t[i - 1]);
    }
  }
  return nan;
}

double first_below(const Series& series, double level, double a, double b) {
  for (std::size_t i = 0; i < series.t.size() && series.t[i] <= b; ++i) {
    if (series.t[i] < a || series.y[i] >= level) continue;
    if (i == 0 || series.t[i - 1] < a) return series.t[i];
    const double fall = series.y[i - 1] - series.y[i];
    return series.t[i] - (level - series.y[i]) / fall * (series.t[i] - series.t[i - 1]);
  }
  return nan;
}

Series running_integral(const Series& series) { return {series.t, cumulative(series)}; }

Norms difference_norms(const Series& series, const Series& base, double a, double b) {
  if (!(b > a) || !covers(series, a, b) || !covers(base, a, b)) return {nan, nan};
  std::vector<double> times{a, b};
  for (const Series* s : {&series, &base})
    for (const double t : s->t)
      if (t > a && t < b) times.push_back(t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());

  double sum = 0, squares = 0, peak = 0, left = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double value = value_held(base, times[i]), right = value_held(series, times[i]) - value;
    peak = std::max(peak, std::abs(value));
    if (i > 0) {
      const double width = times[i] - times[i - 1], ends = std::abs(left) + std::abs(right);
      // Where the difference changes sign in between its magnitude is two triangles.
      if (left * right < 0) sum += 0.5 * width * (left * left + right * right) / ends;
      else sum += 0.5 * width * ends;
      squares += width / 3 * (left * left + left * right + right * right);
    }
    left = right;
  }
  if (!(peak > 0)) return {nan, nan};
  return {sum / (b - a) / peak, std::sqrt(squares / (b - a)) / peak};
}

std::vector<HistoryColumn> read_history(const std::filesystem::path& path, bool may_be_cut) {
  require_file(path);
  std::ifstream file(path);
  if (!file) throw FileError("cannot read " + path.string() + ": " + std::strerror(errno) + "; check the file's path");
  std::vector<HistoryColumn> columns;
  bool header_seen = false;
  long line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    if (may_be_cut && file.eof()) break;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    for (std::size_t start = 0; start <= line.size();) {
      const std::size_t comma = std::min(line.find(',', start), line.size());
      cells.push_back(line.substr(start, comma - start));
      start = comma + 1;
    }
    if (!header_seen) {
      header_seen = true;
      if (!line.starts_with("time") || cells.size() < 2)
        throw FileError("cannot read " + path.string() + ":" + std::to_string(line_number) +
                        ": a header such as 'time [s],pressure [Pa]' is expected");
      for (std::size_t i = 1; i < cells.size(); ++i) {
        const std::size_t bracket = cells[i].rfind(" [");
        const bool has_unit = bracket != std::string::npos && cells[i].back() == ']';
        columns.push_back({cells[i].substr(0, has_unit ? bracket : cells[i].size()),
                           has_unit ? cells[i].substr(bracket + 2, cells[i].size() - bracket - 3) : "-",
                           {}});
      }
      continue;
    }
    std::vector<double> row;
    for (const std::string& cell : cells) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      if (end == cell.c_str() || cell.find_first_not_of(" \t", static_cast<std::size_t>(end - cell.c_str())) != std::string::npos)
        break;
      row.push_back(value);
    }
    if (row.size() < columns.size() + 1)
      throw FileError("cannot read " + path.string() + ":" + std::to_string(line_number) + ": expected numbers, found '" +
                      line.substr(0, 200) + "'");
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].series.append(row[0], row[i + 1]);
  }
  if (!header_seen) throw FileError("cannot read " + path.string() + ": the file is empty; a header row is expected");
  return columns;
}

}  // namespace undex::output
