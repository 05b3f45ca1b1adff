#include "study/study_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "scene/suggestion.hpp"

namespace undex::study {
namespace {

/// What a table does not have that an error needs; empty where it has it.
std::string lacks(const judge::ReferenceTable& table, const std::string& file, const scene::StudyError& error) {
  std::vector<std::string> metrics;
  for (const auto& row : table.rows) metrics.push_back(row.metric);
  const auto source = std::find(table.sources.begin(), table.sources.end(), error.source);
  if (source == table.sources.end())
    return file + " has no source '" + error.source + "'" + scene::suggestion(error.source, table.sources);
  const auto metric = std::find(metrics.begin(), metrics.end(), error.metric);
  if (metric == metrics.end()) return file + " has no metric '" + error.metric + "'" + scene::suggestion(error.metric, metrics);
  const auto& row = table.rows[std::size_t(metric - metrics.begin())];
  const double value = row.values[std::size_t(source - table.sources.begin())].value;
  if (std::isnan(value) || value == 0) return "source '" + error.source + "' of " + file + " has no value of " + error.metric;
  return "";
}

/// The first mistake that an error makes in any run; empty without one.
std::string mistake_of(const scene::StudyError& error, const scene::Study& study, References& tables) {
  for (const scene::StudyRun& run : study.runs) {
    if (run.reference.empty())
      return "'" + error.label + "' needs the scene's comparison.reference, and the scene of run " + run.name + " has none";
    const auto [table, fresh] = tables.try_emplace(run.reference);
    if (fresh) table->second = judge::read_reference_table(run.reference);
    if (const std::string lack = lacks(table->second, run.reference.string(), error); !lack.empty()) return lack;
  }
  return "";
}

/// Magnitudes of the study's errors of a run that is done (NaN: it does not have them). `reference` is its scene's table.
std::vector<double> study_errors(const scene::Study& study, const output::RunRecord& record,
                                 const judge::ReferenceTable* reference) {
  output::NamedNumbers numbers = record.metrics;
  const output::NamedNumbers ledgers = ledger_errors(record);
  numbers.insert(numbers.end(), ledgers.begin(), ledgers.end());
  std::vector<double> errors;
  for (const scene::StudyError& error : study.errors) {
    errors.push_back(nan);
    const double* value = output::find_number(numbers, error.metric);
    if (!value) continue;
    if (error.source.empty()) errors.back() = std::abs(*value);
    if (error.source.empty() || !reference) continue;
    for (const judge::ReferenceTable::Row& row : reference->rows)
      for (std::size_t s = 0; s < row.values.size(); ++s)
        if (row.metric == error.metric && reference->sources[s] == error.source)
          errors.back() = std::abs(*value * row.scale - row.values[s].value) / std::abs(row.values[s].value);
  }
  return errors;
}

}  // namespace

References read_references(const scene::Study& study) {
  References tables;
  std::vector<Finding> findings;
  for (const scene::StudyError& error : study.errors)
    if (!error.source.empty())
      if (const std::string mistake = mistake_of(error, study, tables); !mistake.empty())
        findings.push_back({error.where, "errors: " + mistake});
  if (!findings.empty()) throw SceneError(study.file.string(), findings);
  return tables;
}

output::NamedNumbers ledger_errors(const output::RunRecord& record) {
  return {{"mass_error", record.mass_error},
          {"momentum_error", record.momentum_error},
          {"energy_error", record.energy_error},
          {"interface_energy_error", record.interface_energy_error.value_or(nan)},
          {"interface_impulse_error", record.interface_impulse_error.value_or(nan)}};
}

StudyRow row_of(const scene::Study& study, const scene::StudyRun& run, const RunState& state, const References& references) {
  StudyRow row;
  row.name = run.name;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const scene::StudyValue& value = study.axes[a].values[run.values[a]];
    row.values.push_back(value.label);
    if (a == study.resolution) row.h = value.number;
    else row.curve += (row.curve.empty() ? "" : ", ") + value.label;
    if (study.axes[a].problem) row.problem += (row.problem.empty() ? "" : ", ") + value.label;
  }
  if (row.curve.empty()) row.curve = study.name;
  // Results of other settings are not this run's.
  const bool known = state.finished || state.status == "failed" || state.status == "refused" || state.status == "interrupted" ||
                     state.status == "limit";
  row.status = known ? state.status : "not run";
  row.message = known ? state.message : state.reason == "not there" ? "" : state.reason;
  row.record = state.record;
  row.cpu_times = state.cpu_times;
  row.wall_times = state.wall_times;
  const auto reference = references.find(run.reference);
  row.errors = state.status == "done"
                   ? study_errors(study, state.record, reference == references.end() ? nullptr : &reference->second)
                   : std::vector<double>(study.errors.size(), nan);
  return row;
}

}  // namespace undex::study
