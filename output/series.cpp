#include "output/series.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "core/errors.hpp"

namespace undex::output {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double between(const Series& s, std::size_t left, double t) {
  const double width = s.t[left + 1] - s.t[left];
  if (!(width > 0)) return s.y[left + 1];
  return s.y[left] + (t - s.t[left]) / width * (s.y[left + 1] - s.y[left]);
}

// Integral from the first sample to each sample.
std::vector<double> cumulative(const Series& s) {
  std::vector<double> result(s.t.size(), 0.0);
  for (std::size_t i = 1; i < s.t.size(); ++i)
    result[i] = result[i - 1] + 0.5 * (s.y[i] + s.y[i - 1]) * (s.t[i] - s.t[i - 1]);
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
    throw std::invalid_argument("series: " + std::to_string(series.t.size()) + " times, " +
                                std::to_string(series.y.size()) + " values");
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

Series read_series(const std::filesystem::path& path, const std::string& column) {
  std::ifstream file(path);
  if (!file)
    throw FileError("cannot read " + path.string() + ": " + std::strerror(errno) + "; check the reference file's path");
  Series result;
  std::size_t wanted = 0;
  bool header_seen = false;
  long number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
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
      if (column.empty())
        wanted = 1;
      else
        for (std::size_t i = 1; i < cells.size() && wanted == 0; ++i)
          if (cells[i].starts_with(column)) wanted = i;
      if (wanted == 0 || wanted >= cells.size())
        throw FileError("cannot read " + path.string() + ": no column '" + column + "' in its header '" + line + "'");
      continue;
    }
    char *end_t = nullptr, *end_y = nullptr;
    const double t = std::strtod(cells[0].c_str(), &end_t);
    const double y = wanted < cells.size() ? std::strtod(cells[wanted].c_str(), &end_y) : nan;
    if (end_t == cells[0].c_str() || wanted >= cells.size() || end_y == cells[wanted].c_str())
      throw FileError("cannot read " + path.string() + ":" + std::to_string(number) + ": expected numbers, found '" +
                      line + "'");
    result.append(t, y);
  }
  if (!header_seen) throw FileError("cannot read " + path.string() + ": the file is empty; a header row is expected");
  return result;
}

}  // namespace undex::output
