#include "study/run_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "output/text_table.hpp"

namespace undex::study {

namespace {

using output::aligned;
using output::difference;
using output::difference_text;
using output::Extremum;
using output::Norms;
using output::number;
using output::padded_left;
using output::padded_right;
using output::print;
using output::Series;
using output::width;

// Below this share of the largest value a percentage says nothing: the first run passes zero, or has nothing but noise.
constexpr double least_share = 1e-2;

struct ShownUnit {
  std::string name;
  double factor;
};

ShownUnit shown(const std::string& unit, double largest) {
  if (unit == "Pa") return {"MPa", 1e-6};
  if (unit == "Pa s") return {"kPa s", 1e-3};
  if (unit == "m") return {"mm", 1e3};
  if (unit == "s") return {"us", 1e6};
  if (unit == "J" && largest >= 1e3) return {"kJ", 1e-3};
  return {unit == "-" ? "" : unit, 1};
}

// Where the magnitude is largest in the range, its ends included, with its sign.
Extremum largest(const Series& series, const TimeRange& range) {
  Extremum result{nan, nan};
  const auto consider = [&](double t, double y) {
    if (!(std::abs(y) <= std::abs(result.y))) result = {t, y};
  };
  if (!series.empty() && covers(series, range.begin, range.end)) consider(range.begin, value_held(series, range.begin));
  for (std::size_t i = 0; i < series.t.size(); ++i)
    if (series.t[i] >= range.begin && series.t[i] <= range.end) consider(series.t[i], series.y[i]);
  if (!series.empty() && covers(series, range.begin, range.end)) consider(range.end, value_held(series, range.end));
  return result;
}

double largest_of_all(const Quantity& quantity) {
  double result = 0;
  for (const Series& series : quantity.runs)
    if (const double size = std::abs(largest(series, {-forever, forever}).y); size > result) result = size;
  return result;
}

std::string microseconds(double time) { return print("%.6g us", 1e6 * time); }

// The unit that all rows of a block share, which then stands in its heading; else each row has its own.
std::string common_unit(const ComparedBlock& block) {
  const auto same = [&](const ComparedRow& row) { return row.unit == block.rows.front().unit; };
  return !block.rows.empty() && std::all_of(block.rows.begin(), block.rows.end(), same) ? block.rows.front().unit : "";
}

std::string with_unit(const std::string& text, const std::string& unit) { return text + (unit.empty() ? "" : " [" + unit + "]"); }

std::string heading(const ComparedBlock& block) { return with_unit(block.title, common_unit(block)); }

std::string row_label(const ComparedBlock& block, const ComparedRow& row) {
  return with_unit("  " + row.label, common_unit(block).empty() ? row.unit : "");
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted.append(1, '"');
}

std::string full(double value) { return std::isnan(value) ? "" : print("%.9g", value); }

}  // namespace

std::size_t Quantity::count() const {
  return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const Series& s) { return !s.empty(); }));
}

TimeRange common_range(const Quantity& quantity) {
  TimeRange range{-forever, forever};
  for (const Series& series : quantity.runs)
    if (!series.empty()) range = {std::max(range.begin, series.t.front()), std::min(range.end, series.t.back())};
  return quantity.count() > 0 ? range : TimeRange{};
}

std::vector<double> round_times(double begin, double end) {
  if (!(end > begin)) return {};
  const double most = 8, decade = std::pow(10, std::floor(std::log10((end - begin) / most)));
  double step = 10 * decade;
  for (const double factor : {5.0, 2.0, 1.0})
    if ((end - begin) / (factor * decade) <= most * (1 + 1e-9)) step = factor * decade;
  std::vector<double> times;
  for (double n = std::floor(begin / step + 1e-9) + 1; n * step <= end * (1 + 1e-9); ++n) times.push_back(n * step);
  if (times.empty() || end - times.back() > 0.25 * step) times.push_back(end);
  return times;
}

ComparedRow compared(std::string label, std::string unit, std::vector<double> values, double floor, double reference) {
  ComparedRow row{std::move(label), std::move(unit), std::move(values), reference, {}, {}};
  for (std::size_t r = 0; r < row.values.size(); ++r) {
    const auto from = [&](double base) { return std::abs(base) > floor ? difference(row.values[r], base, row.unit) : nan; };
    row.from_first.push_back(r > 0 ? from(row.values.front()) : nan);
    row.from_reference.push_back(from(reference));
  }
  return row;
}

ComparedBlock values_at(const Quantity& quantity, const std::vector<double>& times, bool with_largest) {
  const ShownUnit unit = shown(quantity.unit, largest_of_all(quantity));
  const TimeRange range = common_range(quantity);
  ComparedBlock block{quantity.title(), {}};
  const double first_largest = std::abs(largest(quantity.runs.front(), range).y) * unit.factor;
  const double floor = std::isnan(first_largest) ? 0.0 : least_share * first_largest;
  for (const double time : times) {
    std::vector<double> values;
    for (const Series& series : quantity.runs) values.push_back(unit.factor * value_at(series, time));
    block.rows.push_back(
        compared(microseconds(time), unit.name, std::move(values), floor, unit.factor * value_at(quantity.reference, time)));
  }
  if (with_largest && range.end > range.begin) {
    std::vector<double> values;
    for (const Series& series : quantity.runs) values.push_back(unit.factor * largest(series, range).y);
    block.rows.push_back(compared("largest to " + microseconds(range.end), unit.name, std::move(values), 0,
                                  unit.factor * largest(quantity.reference, range).y));
  }
  return block;
}

ComparedBlock largest_value(const Quantity& quantity) {
  ComparedBlock block = values_at(quantity, {}, true);
  const TimeRange range = common_range(quantity);
  std::vector<double> times;
  for (const Series& series : quantity.runs) times.push_back(1e6 * largest(series, range).t);
  if (!block.rows.empty())
    block.rows.push_back(compared("at", "us", std::move(times), 0, 1e6 * largest(quantity.reference, range).t));
  return block;
}

ComparedBlock difference_norms(const std::vector<Quantity>& quantities) {
  ComparedBlock block{"difference over the common time, of the peak", {}};
  const auto add = [&](const Quantity& quantity, const Series& base, const std::string& from) {
    const TimeRange range = common_range(quantity);
    std::vector<double> l1, l2;
    for (const Series& series : quantity.runs) {
      const bool itself = &series == &base;
      const Norms norms =
          itself ? Norms{nan, nan}
                 : difference_norms(series, base, std::max(range.begin, base.t.front()), std::min(range.end, base.t.back()));
      l1.push_back(100 * norms.l1);
      l2.push_back(100 * norms.l2);
    }
    const auto known = [](double value) { return !std::isnan(value); };
    if (std::none_of(l1.begin(), l1.end(), known)) return;
    const std::vector<double> none(l1.size(), nan);
    block.rows.push_back({.label = quantity.title() + from + ", L1",
                          .unit = "%",
                          .values = std::move(l1),
                          .from_first = none,
                          .from_reference = none});
    block.rows.push_back({.label = quantity.title() + from + ", L2",
                          .unit = "%",
                          .values = std::move(l2),
                          .from_first = none,
                          .from_reference = none});
  };
  for (const Quantity& quantity : quantities) {
    if (!quantity.runs.front().empty()) add(quantity, quantity.runs.front(), "");
    if (!quantity.reference.empty()) add(quantity, quantity.reference, " from the reference");
  }
  return block;
}

std::string format_blocks(const std::vector<ComparedBlock>& blocks, const std::vector<std::string>& labels,
                          std::size_t max_width) {
  // One set of widths for all blocks, so that a run's column stands in one place all the way down.
  constexpr std::size_t gap = 3;
  std::size_t left = 0;
  std::vector<std::size_t> value_width(labels.size(), 0), difference_width(labels.size(), 0);
  std::size_t reference_width = 0;
  const auto differences = [](const ComparedRow& row, std::size_t r) {
    std::string text = difference_text(row.from_first[r], row.unit);
    if (const std::string from = difference_text(row.from_reference[r], row.unit); !from.empty())
      text += (text.empty() ? "(" : " (") + from + ")";
    return text;
  };
  for (const ComparedBlock& block : blocks) {
    left = std::max(left, width(heading(block)));
    for (const ComparedRow& row : block.rows) {
      left = std::max(left, width(row_label(block, row)));
      for (std::size_t r = 0; r < labels.size(); ++r) {
        value_width[r] = std::max(value_width[r], width(number(row.values[r], row.unit)));
        difference_width[r] = std::max(difference_width[r], width(differences(row, r)));
      }
      if (!std::isnan(row.reference)) reference_width = std::max(reference_width, width(number(row.reference, row.unit)));
    }
  }
  if (reference_width > 0) reference_width = std::max(reference_width, width("reference"));
  const auto run_width = [&](std::size_t r) { return value_width[r] + (difference_width[r] > 0 ? 1 + difference_width[r] : 0); };
  for (std::size_t r = 0; r < labels.size(); ++r)
    if (width(labels[r]) > run_width(r)) value_width[r] += width(labels[r]) - run_width(r);

  std::string text;
  for (std::size_t begin = 0; begin < labels.size();) {
    std::size_t end = begin, total = left + (reference_width > 0 ? gap + reference_width : 0);
    while (end < labels.size() && (end == begin || total + gap + run_width(end) <= max_width)) total += gap + run_width(end++);
    for (const ComparedBlock& block : blocks) {
      const bool has_reference =
          std::any_of(block.rows.begin(), block.rows.end(), [](const ComparedRow& row) { return !std::isnan(row.reference); });
      const auto finish = [&](std::string line) {
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
      };
      std::string line = padded_right(heading(block), left);
      for (std::size_t r = begin; r < end; ++r)
        line += std::string(gap, ' ') + padded_right(padded_left(labels[r], value_width[r]), run_width(r));
      if (has_reference) line += std::string(gap, ' ') + padded_left("reference", reference_width);
      text += "\n";
      finish(line);
      for (const ComparedRow& row : block.rows) {
        line = padded_right(row_label(block, row), left);
        for (std::size_t r = begin; r < end; ++r) {
          line += std::string(gap, ' ') + padded_left(number(row.values[r], row.unit), value_width[r]);
          if (difference_width[r] > 0) line.append(" ").append(padded_right(differences(row, r), difference_width[r]));
        }
        if (has_reference) line += std::string(gap, ' ') + padded_left(number(row.reference, row.unit), reference_width);
        finish(line);
      }
    }
    begin = end;
  }
  return text;
}

std::string csv_row(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) row.append(i > 0 ? 1 : 0, ',').append(csv_cell(cells[i]));
  return row.append(1, '\n');
}

std::string csv_header(const std::vector<std::string>& labels) {
  std::vector<std::string> cells{"quantity", "at", "unit"};
  cells.insert(cells.end(), labels.begin(), labels.end());
  cells.emplace_back("reference");
  for (std::size_t r = 1; r < labels.size(); ++r) cells.push_back(labels[r] + " from " + labels[0] + " [%]");
  for (const std::string& label : labels) cells.push_back(label + " from reference [%]");
  return csv_row(cells);
}

std::string blocks_csv(const std::vector<ComparedBlock>& blocks) {
  std::string text;
  for (const ComparedBlock& block : blocks)
    for (const ComparedRow& row : block.rows) {
      std::vector<std::string> cells{block.title, row.label, row.unit};
      for (const double value : row.values) cells.push_back(full(value));
      cells.push_back(full(row.reference));
      for (std::size_t r = 1; r < row.from_first.size(); ++r) cells.push_back(full(row.from_first[r]));
      for (const double value : row.from_reference) cells.push_back(full(value));
      text += csv_row(cells);
    }
  return text;
}

}  // namespace undex::study
