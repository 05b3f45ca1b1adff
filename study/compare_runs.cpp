// undex compare: finished runs beside each other.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <set>

#include "study/compare_runs.hpp"
#include "study/run_settings.hpp"
#include "core/errors.hpp"
#include "judge/radial.hpp"
#include "judge/reference.hpp"
#include "output/files.hpp"
#include "study/run_comparison.hpp"
#include "output/run_folder.hpp"
#include "study/run_labels.hpp"
#include "output/text_table.hpp"

namespace undex::study {
namespace {

namespace fs = std::filesystem;
using output::HistoryColumn;
using output::Series;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Every mistake of the command line and of the folders, reported together.
class Mistakes {
 public:
  void add(const std::string& mistake) { text_ += (text_.empty() ? "" : "\n") + mistake; }
  template <class Attempt>
  void collect(const Attempt& attempt) {
    try {
      attempt();
    } catch (const std::runtime_error& error) {  // FileError, SceneError, UsageError
      add(error.what());
    }
  }
  void raise() const {
    if (!text_.empty()) throw UsageError(text_);
  }

 private:
  std::string text_;
};

struct Run {
  output::RunFolder folder;
  ResolvedScene scene;
};

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= list.size();) {
    const std::size_t comma = std::min(list.find(',', start), list.size());
    parts.push_back(list.substr(start, comma - start));
    start = comma + 1;
  }
  return parts;
}

/// "20,40,60" in seconds, in order.
std::vector<double> parsed_times(const std::string& list) {
  std::vector<double> times;
  for (const std::string& part : split(list)) {
    char* end = nullptr;
    const double time = std::strtod(part.c_str(), &end);
    if (part.empty() || *end != '\0' || !std::isfinite(time) || time < 0)
      throw UsageError("--at " + list + ": '" + part + "' is no time; give microseconds, such as --at 20,40,60");
    times.push_back(1e-6 * time);
  }
  std::sort(times.begin(), times.end());
  return times;
}

// ------------------------------------------------------------------------------------------------ quantities

/// A quantity with what decides how it is shown.
struct Compared {
  Quantity quantity;
  std::string kind;    ///< of its probe: "fluid", "wall", "structure"; or "energy"
  std::string column;  ///< name in a history: "pressure"; of a radial component the vector's: "displacement"
};

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// A probe's columns, with complete vectors of a round structure turned into their radial component.
std::vector<HistoryColumn> radial_columns(const std::vector<HistoryColumn>& columns, const RunProbe& probe,
                                          const std::optional<judge::Axis>& axis) {
  const Vec3 outward = axis && probe.kind == "structure" ? axis->outward(probe.point) : Vec3(Vec3::Zero());
  if (outward.isZero()) return columns;
  std::vector<HistoryColumn> result;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string name = columns[c].name.ends_with("_x") ? columns[c].name.substr(0, columns[c].name.size() - 2) : "";
    const auto is = [&](std::size_t k, const char* end) { return k < columns.size() && columns[k].name == name + end; };
    if ((name != "displacement" && name != "velocity") || !is(c + 1, "_y")) {
      result.push_back(columns[c]);
      continue;
    }
    const bool has_z = is(c + 2, "_z");
    result.push_back(
        {"radial " + name, columns[c].unit,
         judge::radial({columns[c].series, columns[c + 1].series, has_z ? columns[c + 2].series : Series{}}, outward)});
    c += has_z ? 2 : 1;
  }
  return result;
}

/// The name under which a run's probe is compared: its own, but the run's compared probe stands for the first run's where
/// the kinds are the same and nothing else has that name.
std::string common_name(const Run& run, const std::string& name, const Run& first) {
  const std::string& primary = first.scene.compared_probe;
  if (name != run.scene.compared_probe || name == primary || run.scene.probes.contains(primary)) return name;
  const auto theirs = first.scene.probes.find(primary), mine = run.scene.probes.find(name);
  const bool same =
      theirs != first.scene.probes.end() && mine != run.scene.probes.end() && theirs->second.kind == mine->second.kind;
  return same ? primary : name;
}

Compared& place(std::vector<Compared>& all, std::size_t runs, const Compared& like) {
  for (Compared& each : all)
    if (each.quantity.probe == like.quantity.probe && each.quantity.name == like.quantity.name && each.kind == like.kind &&
        each.quantity.unit == like.quantity.unit)
      return each;
  all.push_back(like);
  all.back().quantity.runs.resize(runs);
  return all.back();
}

/// Histories of all probes, the compared probe's first, then the parts of the energy.
std::vector<Compared> gather(const std::vector<Run>& runs, std::vector<std::string>& notes) {
  std::vector<Compared> all;
  std::set<std::string> displaced;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Run& run = runs[r];
    for (const std::string& name : run.scene.probe_order) {
      const auto history = run.folder.probes.find(name);
      if (history == run.folder.probes.end()) continue;
      const RunProbe& probe = run.scene.probes.at(name);
      const std::string common = common_name(run, name, runs.front());
      for (HistoryColumn& column : radial_columns(history->second, probe, run.scene.axis)) {
        const std::string vector = column.name.starts_with("radial ") ? column.name.substr(7) : column.name;
        Compared& entry = place(all, runs.size(), {{common, spoken(column.name), column.unit, {}, {}}, probe.kind, vector});
        entry.quantity.runs[r] = std::move(column.series);
      }
      const auto other = runs.front().scene.probes.find(common);
      if (r > 0 && other != runs.front().scene.probes.end() && other->second.kind == probe.kind &&
          (other->second.point - probe.point).norm() > 1e-9 * (1 + probe.point.norm()))
        displaced.insert(common);
    }
  }
  for (const std::string& name : displaced) notes.push_back("probe " + name + " does not stand at the same point in all runs");
  const std::string& primary = runs.front().scene.compared_probe;
  std::stable_partition(all.begin(), all.end(), [&](const Compared& each) { return each.quantity.probe == primary; });

  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const HistoryColumn& column : runs[r].folder.energies) {
      // What a run does not have at all is zero in its ledger.
      const auto& y = column.series.y;
      if (column.name == "total" || std::all_of(y.begin(), y.end(), [](double value) { return value == 0; })) continue;
      place(all, runs.size(), {{"energy", spoken(column.name), column.unit, {}, {}}, "energy", column.name}).quantity.runs[r] =
          column.series;
    }
  return all;
}

bool is_pressure(const Compared& each) { return each.column == "pressure" && each.kind != "energy"; }
bool is_error(const Compared& each) { return each.kind == "energy" && each.column == "error"; }

/// What a pressure is compared by besides itself.
std::vector<Compared> derived(const Compared& pressure) {
  const auto each = [&](const std::string& name, const std::string& unit, const auto& operation) {
    Compared result = pressure;
    result.quantity.name = name;
    result.quantity.unit = unit;
    for (Series& series : result.quantity.runs) series = operation(series);
    result.quantity.reference = operation(result.quantity.reference);
    return result;
  };
  const auto mean = [](double window) {
    return [window](const Series& series) { return output::moving_average(series, window); };
  };
  return {each("pressure, 1 us mean", "Pa", mean(1e-6)), each("pressure, 3 us mean", "Pa", mean(3e-6)),
          each("impulse", "Pa s", [](const Series& series) { return output::running_integral(series); })};
}

/// Gives each column of the reference to the first quantity of its name. Columns are named as in a history, whatever
/// follows ("pressure at 0.25 mm"); of several for one quantity the first counts.
void attach_reference(std::vector<Compared>& all, const std::vector<HistoryColumn>& reference, const std::string& path,
                      std::vector<std::string>& notes) {
  std::string known;
  std::set<std::string> done, used;
  for (Compared& each : all) {
    if (each.kind == "energy" || each.quantity.count() == 0 || !done.insert(each.column).second) continue;
    known += (known.empty() ? "" : ", ") + each.column + " [" + each.quantity.unit + "]";
    const auto match = std::find_if(reference.begin(), reference.end(), [&](const HistoryColumn& column) {
      return (column.name == each.column || column.name.starts_with(each.column + " ")) && column.unit == each.quantity.unit;
    });
    if (match == reference.end()) continue;
    each.quantity.reference = match->series;
    used.insert(match->name);
  }
  std::string unused;
  for (const HistoryColumn& column : reference)
    if (!used.contains(column.name)) unused += (unused.empty() ? "" : ", ") + column.name + " [" + column.unit + "]";
  if (!unused.empty()) notes.push_back("of the reference not used: " + unused);
  if (used.empty() && !reference.empty())
    throw UsageError(path + ": no column is a quantity that the runs recorded; name one of them as the runs do: " +
                     (known.empty() ? "(the runs have no histories)" : known));
}

// ------------------------------------------------------------------------------------------------ blocks

/// Time [s] of a metric "<quantity><time>us...", such as displacement_30us_m; NaN where it is none.
double time_of_metric(const std::string& metric, const std::string& quantity) {
  if (!metric.starts_with(quantity)) return nan;
  char* end = nullptr;
  const double time = std::strtod(metric.c_str() + quantity.size(), &end);
  return end != metric.c_str() + quantity.size() && std::string(end).starts_with("us") ? 1e-6 * time : nan;
}

/// The quantities of which metrics are values at given times.
constexpr std::array timed_metrics{"displacement_", "wall_velocity_", "plastic_strain_"};

bool is_at_time(const std::string& metric) {
  return std::any_of(timed_metrics.begin(), timed_metrics.end(),
                     [&](const char* quantity) { return !std::isnan(time_of_metric(metric, quantity)); });
}

/// The times of a reference table's rows within 0..end.
std::vector<double> reference_times(const judge::ReferenceTable& table, double end) {
  std::set<double> times;
  for (const judge::ReferenceTable::Row& row : table.rows)
    for (const char* quantity : timed_metrics)
      if (const double time = time_of_metric(row.metric, quantity); time > 0 && time <= end * (1 + 1e-9)) times.insert(time);
  return {times.begin(), times.end()};
}

void drop_differences(ComparedBlock& block) {
  for (ComparedRow& row : block.rows) {
    std::fill(row.from_first.begin(), row.from_first.end(), nan);
    std::fill(row.from_reference.begin(), row.from_reference.end(), nan);
  }
}

bool shown_at_times(const Compared& each) {
  if (each.kind == "energy") return !each.column.starts_with("interface_work");  // given and received: among the errors
  if (each.column == "plastic_strain") return true;
  return each.kind == "structure" && (each.column.starts_with("displacement") || each.column.starts_with("velocity"));
}

std::vector<ComparedBlock> history_blocks(const std::vector<Compared>& all, const std::vector<double>& times) {
  std::vector<ComparedBlock> blocks;
  for (const Compared& each : all) {
    if (each.quantity.count() < 2) continue;
    if (is_pressure(each)) {
      blocks.push_back(largest_value(each.quantity));
      for (const Compared& more : derived(each))
        blocks.push_back(values_at(more.quantity, times, more.quantity.name != "impulse"));
    } else if (shown_at_times(each)) {
      blocks.push_back(values_at(each.quantity, times, each.kind == "structure"));
      if (is_error(each)) drop_differences(blocks.back());
    }
  }
  return blocks;
}

/// The metrics of the scenes' comparisons, but for those at given times, which the histories have.
ComparedBlock result_block(const std::vector<Run>& runs) {
  // By the end of a metric's name, the longer ends first: unit shown, and its factor.
  struct End {
    const char *name, *unit;
    double factor;
  };
  static constexpr std::array ends{End{"_pa_s", "kPa s", 1e-3}, End{"_m_s", "m/s", 1}, End{"_pa", "MPa", 1e-6},
                                   End{"_s", "us", 1e6},        End{"_m", "mm", 1e3},  End{"", "", 1}};
  ComparedBlock block{"results", {}};
  std::vector<std::string> names;
  for (const Run& run : runs)
    for (const auto& [name, ignored] : run.folder.record.metrics) {
      if (!is_at_time(name) && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  for (const std::string& name : names) {
    const End& end = *std::find_if(ends.begin(), ends.end(), [&](const End& each) { return name.ends_with(each.name); });
    std::vector<double> values;
    for (const Run& run : runs) {
      const double* value = output::find_number(run.folder.record.metrics, name);
      values.push_back(value ? end.factor * *value : nan);
    }
    const std::string label = spoken(name.substr(0, name.size() - std::string(end.name).size()));
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
      block.rows.push_back(compared(label, end.unit, std::move(values)));
  }
  return block;
}

template <class Value>
void add_row(ComparedBlock& block, const std::vector<Run>& runs, const char* label, const char* unit, const Value& value) {
  std::vector<double> values;
  for (const Run& run : runs) values.push_back(value(run.folder.record));
  if (!std::all_of(values.begin(), values.end(), [](double each) { return std::isnan(each); }))
    block.rows.push_back(compared(label, unit, std::move(values)));
}

ComparedBlock cost_block(const std::vector<Run>& runs) {
  using output::RunRecord;
  const auto count = [](std::int64_t number) { return number > 0 ? static_cast<double>(number) : nan; };
  ComparedBlock block{"cost", {}};
  add_row(block, runs, "wall time", "s", [](const RunRecord& r) { return r.wall_time_s; });
  add_row(block, runs, "CPU time", "s", [](const RunRecord& r) { return r.cpu_time_s; });
  add_row(block, runs, "threads", "", [&](const RunRecord& r) { return count(r.threads); });
  add_row(block, runs, "steps", "", [&](const RunRecord& r) { return count(r.steps); });
  add_row(block, runs, "particles", "", [&](const RunRecord& r) { return count(r.particles); });
  add_row(block, runs, "cells", "", [&](const RunRecord& r) { return count(r.cells); });
  add_row(block, runs, "particle updates", "million/CPU s",
          [&](const RunRecord& r) { return r.cpu_time_s > 0 ? 1e-6 * count(r.particle_updates) / r.cpu_time_s : nan; });
  add_row(block, runs, "memory", "MB", [&](const RunRecord& r) { return 1e-6 * count(r.peak_memory_bytes); });
  return block;
}

ComparedBlock error_block(const std::vector<Run>& runs) {
  using output::RunRecord;
  ComparedBlock block{"errors at the end", {}};
  add_row(block, runs, "mass", "", [](const RunRecord& r) { return r.mass_error; });
  add_row(block, runs, "momentum", "", [](const RunRecord& r) { return r.momentum_error; });
  add_row(block, runs, "energy", "", [](const RunRecord& r) { return r.energy_error; });
  add_row(block, runs, "interface energy", "", [](const RunRecord& r) { return r.interface_energy_error.value_or(nan); });
  add_row(block, runs, "interface impulse", "", [](const RunRecord& r) { return r.interface_impulse_error.value_or(nan); });
  drop_differences(block);
  return block;
}

ComparedBlock norm_block(const std::vector<Compared>& all) {
  std::vector<Quantity> quantities;
  for (const Compared& each : all)
    if (each.quantity.count() >= 2 && !is_error(each)) {
      quantities.push_back(each.quantity);
      if (is_pressure(each)) quantities.push_back(derived(each).back().quantity);  // the impulse, which no spike disturbs
    }
  return difference_norms(quantities);
}

// ------------------------------------------------------------------------------------------------ what is said

std::string runs_text(const std::vector<Run>& runs, const std::vector<std::string>& labels) {
  std::vector<std::vector<std::string>> lines;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const output::RunRecord& record = runs[r].folder.record;
    lines.push_back({labels[r], runs[r].folder.path.string(),
                     record.scene + ", " + record.status + output::print(" at %.6g us", 1e6 * record.time_s)});
  }
  return output::aligned(lines, 3);
}

/// The settings that differ, the first of them only.
std::string settings_text(const std::vector<DifferingSetting>& settings, const std::vector<std::string>& labels) {
  constexpr std::size_t most = 12, longest_value = 24;
  if (settings.empty()) return "\nno setting differs\n";
  const auto shown = std::min(most, settings.size());
  const auto cell = [](const std::string& value) {
    if (value.empty()) return std::string("-");
    char* end = nullptr;
    if (const double number = std::strtod(value.c_str(), &end); *end == '\0') return output::print("%.5g", number);
    return value.size() > longest_value ? value.substr(0, longest_value - 3) + "..." : value;
  };
  std::vector<std::vector<std::string>> lines{{"settings that differ"}};
  lines[0].insert(lines[0].end(), labels.begin(), labels.end());
  for (std::size_t s = 0; s < shown; ++s) {
    lines.push_back({"  " + settings[s].key});
    for (const std::string& value : settings[s].values) lines.back().push_back(cell(value));
  }
  std::string text = "\n" + output::aligned(lines, 1);
  if (settings.size() > shown) text += "  and " + std::to_string(settings.size() - shown) + " more: comparison.csv has all\n";
  return text;
}

std::string settings_csv(const std::vector<DifferingSetting>& settings) {
  std::string text;
  for (const DifferingSetting& setting : settings) {
    std::vector<std::string> cells{"setting", setting.key, ""};
    cells.insert(cells.end(), setting.values.begin(), setting.values.end());
    cells.resize(cells.size() + 2 * setting.values.size());  // no reference, no differences
    text += csv_row(cells);
  }
  return text;
}

/// A block per source of the reference table, for comparison.csv.
std::vector<ComparedBlock> reference_blocks(const std::vector<Run>& runs, const judge::ReferenceTable& table) {
  std::vector<ComparedBlock> blocks;
  for (std::size_t s = 0; s < table.sources.size(); ++s) {
    blocks.push_back({"reference " + table.sources[s], {}});
    for (const judge::ReferenceTable::Row& row : table.rows) {
      std::vector<double> values;
      for (const Run& run : runs) {
        const double* value = output::find_number(run.folder.record.metrics, row.metric);
        values.push_back(value ? row.scale * *value : nan);
      }
      if (!std::isnan(row.values[s].value))
        blocks.back().rows.push_back(compared(row.label, row.unit, std::move(values), 0, row.values[s].value));
    }
  }
  return blocks;
}

/// The lines of curves.csv of one curve.
std::string curve_lines(const Compared& curve, const std::string& label, const Series& series) {
  const Quantity& quantity = curve.quantity;
  std::string head = csv_row({quantity.probe, curve.kind, quantity.name, quantity.unit, label});
  head.back() = ',';  // the line goes on
  std::string text;
  char numbers[64];
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    std::snprintf(numbers, sizeof numbers, "%.9g,%.9g\n", series.t[i], series.y[i]);
    text += head;
    text += numbers;
  }
  return text;
}

/// curves.csv: every history that two runs or more have, one sample a line, for plots; and the points that the sources of
/// a reference table give of the compared probe's motion.
std::string curves_csv(const std::vector<Compared>& all, const std::vector<std::string>& labels,
                       const std::optional<judge::ReferenceTable>& table) {
  std::string text = "probe,kind,quantity,unit,run,time [s],value\n";
  const auto add = [&](const Compared& each) {
    for (std::size_t r = 0; r < labels.size(); ++r) text += curve_lines(each, labels[r], each.quantity.runs[r]);
    text += curve_lines(each, "reference", each.quantity.reference);
  };
  std::set<std::string> met;
  for (const Compared& each : all) {
    if (each.quantity.count() < 2) continue;
    add(each);
    if (is_pressure(each))
      for (const Compared& more : derived(each)) add(more);
    const bool motion = each.quantity.name == "radial displacement" || each.quantity.name == "radial velocity";
    if (!table || !motion || !met.insert(each.quantity.name).second) continue;  // only of the first probe: the compared one
    for (std::size_t s = 0; s < table->sources.size(); ++s) {
      Series points;
      for (const judge::ReferenceTable::Row& row : table->rows) {
        const double time = time_of_metric(row.metric, each.column == "velocity" ? "wall_velocity_" : "displacement_");
        if (!std::isnan(time) && !std::isnan(row.values[s].value)) points.append(time, row.values[s].value / row.scale);
      }
      text += curve_lines(each, table->sources[s], points);
    }
  }
  return text;
}

/// Throws UsageError where a comparison would compare nothing, or one thing with another.
void require_common(const std::vector<Run>& runs, const std::vector<Compared>& all) {
  for (const Run& run : runs)
    if (run.scene.dimension != runs.front().scene.dimension)
      throw UsageError(run.folder.path.string() + " is " + std::to_string(run.scene.dimension) + "D, " +
                       runs.front().folder.path.string() + " is " + std::to_string(runs.front().scene.dimension) +
                       "D: their energies are not of one kind; compare runs of one dimension");
  // An energy error everything has.
  if (std::none_of(all.begin(), all.end(), [](const Compared& each) { return each.quantity.count() > 1 && !is_error(each); }))
    throw UsageError(
        "the runs have no quantity in common (no probe of one name and kind, no part of the energy); give them "
        "probes of one name in their scenes");
}

}  // namespace

void compare_runs(const CompareOptions& options) {
  Mistakes mistakes;
  std::vector<std::string> notes;
  mistakes.collect([&] { output::require_unused_folder(options.output, options.force); });
  std::vector<double> times;
  if (!options.times.empty()) mistakes.collect([&] { times = parsed_times(options.times); });
  std::vector<std::string> labels = options.labels.empty() ? std::vector<std::string>() : split(options.labels);
  if (!labels.empty()) {
    const std::set<std::string> distinct(labels.begin(), labels.end());
    if (labels.size() != options.runs.size() || distinct.size() != labels.size() || distinct.contains(""))
      mistakes.add("--label " + options.labels + ": give one name for each of the " + std::to_string(options.runs.size()) +
                   " runs, no two alike, with commas between them");
  }
  std::vector<Run> runs;
  std::set<fs::path> seen;
  for (const std::string& folder : options.runs)
    mistakes.collect([&] {
      std::error_code error;
      if (!seen.insert(fs::weakly_canonical(folder, error)).second) throw UsageError(folder + " is given twice; leave one out");
      Run run{output::read_run_folder(folder), {}};
      run.scene = read_resolved(run.folder.settings, (run.folder.path / "resolved.toml").string());
      runs.push_back(std::move(run));
    });
  judge::Reference reference;
  if (!options.reference.empty()) mistakes.collect([&] { reference = judge::read_reference(options.reference); });
  mistakes.raise();

  std::vector<Compared> all = gather(runs, notes);
  require_common(runs, all);
  attach_reference(all, reference.history, options.reference, notes);

  double first_end = std::numeric_limits<double>::infinity(), last_end = 0;
  for (const Run& run : runs) {
    const output::RunRecord& record = run.folder.record;
    first_end = std::min(first_end, record.time_s);
    last_end = std::max(last_end, record.time_s);
    if (record.status != "done") notes.push_back(run.folder.path.string() + " was " + record.status + ": " + record.message);
  }
  if (!times.empty() && times.front() > last_end * (1 + 1e-9))
    throw UsageError("--at " + options.times +
                     output::print(": no run reaches these times; the longest ends at %.6g us", 1e6 * last_end));
  if (times.empty() && reference.table) times = reference_times(*reference.table, first_end);
  if (times.empty()) times = round_times(0, first_end);

  std::vector<judge::LabelledMetrics> metrics;
  std::vector<RunSettings> settings;
  std::vector<std::string> names;
  for (const Run& run : runs) {
    settings.push_back(run.scene.settings);
    names.push_back(run.folder.path.string());
  }
  const std::vector<DifferingSetting> differing = differing_settings(settings);
  if (labels.empty()) labels = run_labels(differing, names);
  for (std::size_t r = 0; r < runs.size(); ++r) metrics.push_back({labels[r], runs[r].folder.record.metrics});
  if (reference.table &&
      std::none_of(reference.table->rows.begin(), reference.table->rows.end(), [&](const judge::ReferenceTable::Row& row) {
        return std::any_of(metrics.begin(), metrics.end(), [&](const judge::LabelledMetrics& run) {
          return output::find_number(run.metrics, row.metric) != nullptr;
        });
      }))
    throw UsageError(options.reference.string() +
                     ": none of its metrics is a result of these runs; give the table of their scenes' "
                     "comparison, or a history");

  std::string only_once;
  for (const Compared& each : all)
    if (each.quantity.count() == 1) only_once += (only_once.empty() ? "" : "; ") + each.quantity.title();
  if (!only_once.empty()) notes.push_back("in one run only: " + only_once);

  std::vector<ComparedBlock> blocks = history_blocks(all, times);
  for (ComparedBlock& block : std::array{result_block(runs), cost_block(runs), error_block(runs)})
    if (!block.rows.empty()) blocks.push_back(std::move(block));
  const ComparedBlock norms = norm_block(all);

  std::string text = runs_text(runs, labels) + settings_text(differing, labels) + format_blocks(blocks, labels);
  if (!norms.rows.empty()) text += format_blocks({norms}, labels);  // narrow numbers, long names: widths of its own
  blocks.push_back(norms);
  if (reference.table)
    text += "\nbeside the reference; after each source's value every run's difference from it\n" +
            judge::format_comparison(metrics, *reference.table);
  text += "\nPercentages: difference from " + labels.front() +
          (reference.history.empty() ? "" : "; in brackets from the reference") + ". Definitions: docs/outputs.md\n";
  for (const std::string& note : notes) text += "note: " + note + "\n";

  const fs::path folder = options.output;
  output::make_folder(folder);
  if (reference.table)
    for (ComparedBlock& block : reference_blocks(runs, *reference.table)) blocks.push_back(std::move(block));
  output::write_text_atomically(folder / "comparison.csv", csv_header(labels) + settings_csv(differing) + blocks_csv(blocks));
  output::write_text_atomically(folder / "curves.csv", curves_csv(all, labels, reference.table));
  std::printf("%s", text.c_str());
  std::printf("%s and curves.csv are written. Pictures: /usr/bin/python3 scripts/plot.py --compare %s\n",
              (folder / "comparison.csv").c_str(), folder.c_str());
}

}  // namespace undex::study
