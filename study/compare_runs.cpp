#include "study/compare_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>

#include "core/errors.hpp"
#include "judge/metric_names.hpp"
#include "judge/reference.hpp"
#include "output/files.hpp"
#include "output/folder_lock.hpp"
#include "output/text_table.hpp"
#include "study/compared.hpp"
#include "study/compared_blocks.hpp"
#include "study/curves.hpp"
#include "study/run_labels.hpp"

namespace undex::study {
namespace {

namespace fs = std::filesystem;

// ------------------------------------------------------------------------------------------------ what is given

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

/// One name for each run.
std::vector<std::string> parsed_labels(const std::string& list, std::size_t runs) {
  std::vector<std::string> labels = split(list);
  const std::set<std::string> distinct(labels.begin(), labels.end());
  if (labels.size() != runs || distinct.size() != labels.size() || distinct.contains(""))
    throw UsageError("--label " + list + ": give one name for each of the " + std::to_string(runs) +
                     " runs, no two alike, with commas between them");
  return labels;
}

struct Inputs {
  std::vector<ComparedRun> runs;
  judge::Reference reference;
  std::vector<double> times;        ///< [s]; empty: to be chosen
  std::vector<std::string> labels;  ///< likewise
};

ComparedRun read_run(const std::string& folder, std::set<fs::path>& seen) {
  std::error_code error;
  if (!seen.insert(fs::weakly_canonical(folder, error)).second) throw UsageError(folder + " is given twice; leave one out");
  ComparedRun run{output::read_run_folder(folder), {}};
  run.scene = read_resolved(run.folder.settings, (run.folder.path / "resolved.toml").string());
  return run;
}

Inputs read_inputs(const CompareOptions& options) {
  Inputs inputs;
  Mistakes mistakes;
  std::set<fs::path> seen;
  mistakes.collect([&] { output::require_unused_folder(options.output, options.force); });
  if (!options.times.empty()) mistakes.collect([&] { inputs.times = parsed_times(options.times); });
  if (!options.labels.empty()) mistakes.collect([&] { inputs.labels = parsed_labels(options.labels, options.runs.size()); });
  for (const std::string& folder : options.runs) mistakes.collect([&] { inputs.runs.push_back(read_run(folder, seen)); });
  if (!options.reference.empty()) mistakes.collect([&] { inputs.reference = judge::read_reference(options.reference); });
  mistakes.raise();
  return inputs;
}

/// Throws UsageError where a comparison would compare nothing, or one thing with another.
void require_common(const std::vector<ComparedRun>& runs, const std::vector<Compared>& all) {
  for (const ComparedRun& run : runs)
    if (run.scene.dimension != runs.front().scene.dimension)
      throw UsageError(run.folder.path.string() + " is " + std::to_string(run.scene.dimension) + "D, " +
                       runs.front().folder.path.string() + " is " + std::to_string(runs.front().scene.dimension) +
                       "D: their energies are not of one kind; compare runs of one dimension");
  // An energy error everything has.
  if (std::none_of(all.begin(), all.end(), [](const Compared& each) { return each.quantity.count() > 1 && !each.is_error(); }))
    throw UsageError(
        "the runs have no quantity in common (no probe of one name and kind, no part of the energy); give them "
        "probes of one name in their scenes");
}

/// Throws UsageError where no run has a metric of the reference table.
void require_known_metrics(const std::vector<judge::LabelledMetrics>& metrics, const judge::ReferenceTable& table,
                           const fs::path& path) {
  for (const judge::ReferenceTable::Row& row : table.rows)
    for (const judge::LabelledMetrics& run : metrics)
      if (output::find_number(run.metrics, row.metric) != nullptr) return;
  throw UsageError(path.string() +
                   ": none of its metrics is a result of these runs; give the table of their scenes' "
                   "comparison, or a history");
}

/// The times of a reference table's rows within 0..end.
std::vector<double> reference_times(const judge::ReferenceTable& table, double end) {
  std::set<double> times;
  for (const judge::ReferenceTable::Row& row : table.rows)
    for (const char* quantity : judge::timed_quantities)
      if (const double time = judge::time_of_metric(row.metric, quantity); time > 0 && time <= end * (1 + 1e-9))
        times.insert(time);
  return {times.begin(), times.end()};
}

/// The times of the table's rows: those asked for, the reference table's, or round ones.
std::vector<double> chosen_times(const CompareOptions& options, const Inputs& inputs) {
  double first_end = std::numeric_limits<double>::infinity(), last_end = 0;
  for (const ComparedRun& run : inputs.runs) {
    first_end = std::min(first_end, run.folder.record.time_s);
    last_end = std::max(last_end, run.folder.record.time_s);
  }
  std::vector<double> times = inputs.times;
  if (!times.empty() && times.front() > last_end * (1 + 1e-9))
    throw UsageError("--at " + options.times +
                     output::print(": no run reaches these times; the longest ends at %.6g us", 1e6 * last_end));
  if (times.empty() && inputs.reference.table) times = reference_times(*inputs.reference.table, first_end);
  return times.empty() ? round_times(0, first_end) : times;
}

// ------------------------------------------------------------------------------------------------ what is said

std::string runs_text(const std::vector<ComparedRun>& runs, const std::vector<std::string>& labels) {
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
  std::string text = "\n";
  text += output::aligned(lines, 1);
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

/// Runs that did not come to their end, and quantities of one run alone.
void add_notes(const std::vector<ComparedRun>& runs, const std::vector<Compared>& all, std::vector<std::string>& notes) {
  for (const ComparedRun& run : runs)
    if (const output::RunRecord& record = run.folder.record; record.status != "done")
      notes.push_back(run.folder.path.string() + (record.status == "failed" ? " " : " was ") + record.status + ": " +
                      record.message);
  std::string only_once;
  for (const Compared& each : all)
    if (each.quantity.count() == 1) only_once += (only_once.empty() ? "" : "; ") + each.quantity.title();
  if (!only_once.empty()) notes.push_back("in one run only: " + only_once);
}

std::vector<DifferingSetting> differing_settings_of(const std::vector<ComparedRun>& runs) {
  std::vector<RunSettings> settings;
  for (const ComparedRun& run : runs) settings.push_back(run.scene.settings);
  return differing_settings(settings);
}

std::vector<std::string> labels_of(const Inputs& inputs, const std::vector<DifferingSetting>& differing) {
  std::vector<std::string> names;
  for (const ComparedRun& run : inputs.runs) names.push_back(run.folder.path.string());
  return inputs.labels.empty() ? run_labels(differing, names) : inputs.labels;
}

std::vector<ComparedBlock> blocks_of(const std::vector<ComparedRun>& runs, const std::vector<Compared>& all,
                                     const std::vector<double>& times) {
  std::vector<ComparedBlock> blocks = history_blocks(all, times);
  for (ComparedBlock& block : std::array{result_block(runs), cost_block(runs), error_block(runs)})
    if (!block.rows.empty()) blocks.push_back(std::move(block));
  return blocks;
}

}  // namespace

void compare_runs(const CompareOptions& options) {
  const Inputs inputs = read_inputs(options);
  const std::vector<ComparedRun>& runs = inputs.runs;
  const judge::Reference& reference = inputs.reference;
  std::vector<std::string> notes;
  std::vector<Compared> all = gather(runs, notes);
  require_common(runs, all);
  attach_reference(all, reference.history, options.reference.string(), notes);
  const std::vector<double> times = chosen_times(options, inputs);
  const std::vector<DifferingSetting> differing = differing_settings_of(runs);
  const std::vector<std::string> labels = labels_of(inputs, differing);
  std::vector<judge::LabelledMetrics> metrics;
  for (std::size_t r = 0; r < runs.size(); ++r) metrics.push_back({labels[r], runs[r].folder.record.metrics});
  if (reference.table) require_known_metrics(metrics, *reference.table, options.reference);
  add_notes(runs, all, notes);

  std::vector<ComparedBlock> blocks = blocks_of(runs, all, times);
  const ComparedBlock norms = norm_block(all);
  std::string text = runs_text(runs, labels) + settings_text(differing, labels) + format_blocks(blocks, labels);
  if (!norms.rows.empty()) text += format_blocks({norms}, labels);  // narrow numbers, long names: widths of its own
  if (reference.table)
    text += "\nbeside the reference; after each source's value every run's difference from it\n" +
            judge::format_comparison(metrics, *reference.table);
  text += "\nPercentages: difference from " + labels.front() +
          (reference.history.empty() ? "" : "; in brackets from the reference") + ". Definitions: undex help outputs\n";
  for (const std::string& note : notes) text += "note: " + note + "\n";

  blocks.push_back(norms);
  if (reference.table)
    for (ComparedBlock& block : reference_blocks(runs, *reference.table)) blocks.push_back(std::move(block));
  const output::FolderLock lock(options.output, "undex compare");
  output::write_text_atomically(options.output / "comparison.csv",
                                csv_header(labels) + settings_csv(differing) + blocks_csv(blocks));
  output::write_text_atomically(options.output / "curves.csv", curves_csv(all, labels, reference.table));
  std::printf("%s%s and curves.csv are written. Pictures: undex plot %s\n", text.c_str(),
              (options.output / "comparison.csv").c_str(), options.output.c_str());
}

}  // namespace undex::study
