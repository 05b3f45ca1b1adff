#include "study/compared_blocks.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "judge/metric_names.hpp"

namespace undex::study {
namespace {

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

template <class Value>
void add_row(ComparedBlock& block, const std::vector<ComparedRun>& runs, const char* label, const char* unit,
             const Value& value) {
  std::vector<double> values;
  for (const ComparedRun& run : runs) values.push_back(value(run.folder.record));
  if (!std::all_of(values.begin(), values.end(), [](double each) { return std::isnan(each); }))
    block.rows.push_back(compared(label, unit, std::move(values)));
}

}  // namespace

std::vector<ComparedBlock> history_blocks(const std::vector<Compared>& all, const std::vector<double>& times) {
  std::vector<ComparedBlock> blocks;
  for (const Compared& each : all) {
    if (each.quantity.count() < 2) continue;
    if (each.is_pressure()) {
      blocks.push_back(largest_value(each.quantity));
      for (const Compared& more : derived(each))
        blocks.push_back(values_at(more.quantity, times, more.quantity.name != "impulse"));
    } else if (shown_at_times(each)) {
      blocks.push_back(values_at(each.quantity, times, each.kind == "structure"));
      if (each.is_error()) drop_differences(blocks.back());
    }
  }
  return blocks;
}

ComparedBlock result_block(const std::vector<ComparedRun>& runs) {
  ComparedBlock block{"results", {}};
  std::vector<std::string> names;
  for (const ComparedRun& run : runs)
    for (const auto& [name, ignored] : run.folder.record.metrics) {
      if (!judge::is_at_time(name) && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  for (const std::string& name : names) {
    const judge::ShownMetric metric = judge::shown(name);
    std::vector<double> values;
    for (const ComparedRun& run : runs) {
      const double* value = output::find_number(run.folder.record.metrics, name);
      values.push_back(value ? metric.factor * *value : nan);
    }
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
      block.rows.push_back(compared(metric.label, metric.unit, std::move(values)));
  }
  return block;
}

ComparedBlock cost_block(const std::vector<ComparedRun>& runs) {
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

ComparedBlock error_block(const std::vector<ComparedRun>& runs) {
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
    if (each.quantity.count() >= 2 && !each.is_error()) {
      quantities.push_back(each.quantity);
      if (each.is_pressure()) quantities.push_back(derived(each).back().quantity);  // the impulse, which no spike disturbs
    }
  return difference_norms(quantities);
}

std::vector<ComparedBlock> reference_blocks(const std::vector<ComparedRun>& runs, const judge::ReferenceTable& table) {
  std::vector<ComparedBlock> blocks;
  for (std::size_t s = 0; s < table.sources.size(); ++s) {
    blocks.push_back({"reference " + table.sources[s], {}});
    for (const judge::ReferenceTable::Row& row : table.rows) {
      std::vector<double> values;
      for (const ComparedRun& run : runs) {
        const double* value = output::find_number(run.folder.record.metrics, row.metric);
        values.push_back(value ? row.scale * *value : nan);
      }
      if (!std::isnan(row.values[s].value))
        blocks.back().rows.push_back(compared(row.label, row.unit, std::move(values), 0, row.values[s].value));
    }
  }
  return blocks;
}

}  // namespace undex::study
