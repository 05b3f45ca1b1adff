#include "study/study_table.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/constants.hpp"
#include "study/convergence.hpp"
#include "study/run_comparison.hpp"
#include "output/text_table.hpp"

namespace undex::study {

namespace {

using output::aligned;
using output::number;
using output::print;
using output::RunRecord;

double least(const std::vector<double>& times) { return times.empty() ? nan : *std::min_element(times.begin(), times.end()); }

double bytes_per_particle(const RunRecord& record) {
  const bool known = record.particles > 0 && record.solver_memory_bytes > 0;
  return known ? double(record.solver_memory_bytes) / double(record.particles) : nan;
}

bool computed(const StudyRow& row) { return row.record.steps > 0; }

std::string cell(double value) { return std::isnan(value) ? "" : print("%.9g", value); }

/// Names in the order in which rows bring them.
template <class Names>
std::vector<std::string> all_names(const std::vector<StudyRow>& rows, const Names& names_of) {
  std::vector<std::string> names;
  for (const StudyRow& row : rows)
    for (const auto& [name, ignored] : names_of(row))
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

/// Small errors as powers, so that columns of different size can be read.
std::string error_text(double value) { return std::isnan(value) ? "-" : print("%.3e", value); }

/// A column of study.csv on what a run cost and how well its ledgers close; empty where it was not computed.
struct CostColumn {
  const char* name;
  std::string (*cell)(const StudyRow& row);
};

template <std::int64_t RunRecord::*number>
std::string count(const StudyRow& row) {
  return computed(row) ? std::to_string(row.record.*number) : "";
}
template <double RunRecord::*number>
std::string ledger(const StudyRow& row) {
  return computed(row) ? cell(row.record.*number) : "";
}
template <std::optional<double> RunRecord::*number>
std::string optional_ledger(const StudyRow& row) {
  return computed(row) ? cell((row.record.*number).value_or(nan)) : "";
}
double largest(const std::vector<double>& times) { return times.empty() ? nan : *std::max_element(times.begin(), times.end()); }

const CostColumn cost_columns[] = {
    {"cpu_time_s", [](const StudyRow& row) { return cell(least(row.cpu_times)); }},
    {"cpu_time_largest_s", [](const StudyRow& row) { return cell(largest(row.cpu_times)); }},
    {"wall_time_s", [](const StudyRow& row) { return cell(least(row.wall_times)); }},
    {"timings", [](const StudyRow& row) { return row.cpu_times.empty() ? "" : std::to_string(row.cpu_times.size()); }},
    {"threads", [](const StudyRow& row) { return computed(row) ? std::to_string(row.record.threads) : ""; }},
    {"time_s", ledger<&RunRecord::time_s>},
    {"steps", count<&RunRecord::steps>},
    {"particles", count<&RunRecord::particles>},
    {"wall_particles", count<&RunRecord::wall_particles>},
    {"cells", count<&RunRecord::cells>},
    {"particle_updates", count<&RunRecord::particle_updates>},
    {"neighbour_interactions", count<&RunRecord::neighbour_interactions>},
    {"solver_memory_bytes", count<&RunRecord::solver_memory_bytes>},
    {"bytes_per_particle", [](const StudyRow& row) { return cell(bytes_per_particle(row.record)); }},
    {"peak_memory_bytes", count<&RunRecord::peak_memory_bytes>},
    {"mass_error", ledger<&RunRecord::mass_error>},
    {"momentum_error", ledger<&RunRecord::momentum_error>},
    {"energy_error", ledger<&RunRecord::energy_error>},
    {"interface_energy_error", optional_ledger<&RunRecord::interface_energy_error>},
    {"interface_impulse_error", optional_ledger<&RunRecord::interface_impulse_error>},
};

std::string clamp_cell(const RunRecord& record, const std::string& name) {
  const auto found =
      std::find_if(record.clamps.begin(), record.clamps.end(), [&](const auto& each) { return each.first == name; });
  return found == record.clamps.end() ? "" : std::to_string(found->second);
}

std::vector<std::string> study_head(const StudyTable& table, const std::vector<std::string>& clamps,
                                    const std::vector<std::string>& metrics) {
  std::vector<std::string> cells{"run"};
  cells.insert(cells.end(), table.axes.begin(), table.axes.end());
  for (const char* name : {"curve", "problem", "status", "message"}) cells.emplace_back(name);
  for (const std::string& error : table.errors) cells.push_back("error: " + error);
  for (const std::string& error : table.errors) cells.push_back("pareto: " + error);
  for (const CostColumn& column : cost_columns) cells.emplace_back(column.name);
  for (const std::string& name : clamps) cells.push_back("clamp_" + name);
  cells.insert(cells.end(), metrics.begin(), metrics.end());
  cells.emplace_back("program");
  return cells;
}

}  // namespace

std::vector<ObservedOrders> observed_orders(const StudyTable& table) {
  std::vector<ObservedOrders> result;
  if (table.resolution.empty()) return result;
  for (std::size_t e = 0; e < table.errors.size(); ++e) {
    std::vector<std::string> curves;
    for (const StudyRow& row : table.rows)
      if (std::find(curves.begin(), curves.end(), row.curve) == curves.end()) curves.push_back(row.curve);
    for (const std::string& curve : curves) {
      std::vector<std::pair<double, double>> points;
      for (const StudyRow& row : table.rows)
        if (row.curve == curve && !std::isnan(row.errors[e])) points.emplace_back(row.h, row.errors[e]);
      if (points.size() < 2) continue;
      std::sort(points.rbegin(), points.rend());
      ObservedOrders orders{table.errors[e], curve, {}, {}, {}, nan};
      for (const auto& [h, error] : points) {
        if (!orders.h.empty()) orders.between.push_back(observed_order(orders.h.back(), orders.errors.back(), h, error));
        orders.h.push_back(h);
        orders.errors.push_back(error);
      }
      orders.fitted = fitted_order(orders.h, orders.errors);
      result.push_back(std::move(orders));
    }
  }
  return result;
}

std::vector<std::vector<bool>> pareto_fronts(const StudyTable& table) {
  std::vector<std::vector<bool>> fronts(table.errors.size(), std::vector<bool>(table.rows.size(), false));
  std::vector<std::string> problems;
  for (const StudyRow& row : table.rows)
    if (std::find(problems.begin(), problems.end(), row.problem) == problems.end()) problems.push_back(row.problem);
  for (std::size_t e = 0; e < table.errors.size(); ++e)
    for (const std::string& problem : problems) {
      std::vector<double> costs, errors;
      for (const StudyRow& row : table.rows) {
        const bool counts = row.problem == problem;
        costs.push_back(counts ? least(row.cpu_times) : nan);
        errors.push_back(counts ? row.errors[e] : nan);
      }
      const std::vector<bool> front = pareto_front(costs, errors);
      for (std::size_t r = 0; r < front.size(); ++r) fronts[e][r] = fronts[e][r] || front[r];
    }
  return fronts;
}

std::string study_csv(const StudyTable& table) {
  const std::vector<std::vector<bool>> fronts = pareto_fronts(table);
  const auto clamps = all_names(
      table.rows, [](const StudyRow& row) -> const auto& { return row.record.clamps; });
  const auto metrics = all_names(
      table.rows, [](const StudyRow& row) -> const auto& { return row.record.metrics; });
  std::string text = csv_row(study_head(table, clamps, metrics));
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const StudyRow& row = table.rows[r];
    std::vector<std::string> cells{row.name};
    cells.insert(cells.end(), row.values.begin(), row.values.end());
    cells.insert(cells.end(), {row.curve, row.problem, row.status, row.message});
    for (const double error : row.errors) cells.push_back(cell(error));
    for (std::size_t e = 0; e < table.errors.size(); ++e)
      cells.emplace_back(std::isnan(row.errors[e]) ? "" : fronts[e][r] ? "1" : "0");
    for (const CostColumn& column : cost_columns) cells.push_back(column.cell(row));
    for (const std::string& name : clamps) cells.push_back(clamp_cell(row.record, name));
    for (const std::string& name : metrics) {
      const double* value = output::find_number(row.record.metrics, name);
      cells.push_back(value ? cell(*value) : "");
    }
    cells.push_back(row.record.program);
    text += csv_row(cells);
  }
  return text;
}

std::string order_csv(const std::vector<ObservedOrders>& orders) {
  std::string text = "error,curve,kind,coarse,fine,error coarse,error fine,order\n";
  for (const ObservedOrders& each : orders) {
    const auto add = [&](const char* kind, std::size_t from, std::size_t to, double order) {
      text += csv_row({each.error, each.curve, kind, cell(each.h[from]), cell(each.h[to]), cell(each.errors[from]),
                       cell(each.errors[to]), cell(order)});
    };
    for (std::size_t i = 0; i < each.between.size(); ++i) add("between", i, i + 1, each.between[i]);
    add("least squares", 0, each.h.size() - 1, each.fitted);
  }
  return text;
}

std::string study_json(const StudyTable& table) {
  const nlohmann::ordered_json json{
      {"title", table.title}, {"axes", table.axes}, {"resolution", table.resolution}, {"errors", table.errors}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string study_text(const StudyTable& table) {
  const std::vector<std::vector<bool>> fronts = pareto_fronts(table);
  std::vector<std::string> head = table.axes.empty() ? std::vector<std::string>{"run"} : table.axes;
  const std::size_t left = head.size() + 1;
  head.emplace_back("status");
  for (const std::string& error : table.errors) head.push_back(error + " ");
  const bool with_energy = std::find(table.errors.begin(), table.errors.end(), "energy_error") == table.errors.end();
  for (const char* name : {"CPU s", "particles", "steps", "bytes/particle"}) head.emplace_back(name);
  if (with_energy) head.emplace_back("energy error");
  std::vector<std::vector<std::string>> lines{head};
  std::size_t not_run = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const StudyRow& row = table.rows[r];
    if (row.status == "not run") {
      ++not_run;
      continue;
    }
    std::vector<std::string> line = table.axes.empty() ? std::vector<std::string>{row.name} : row.values;
    line.push_back(row.status);
    for (std::size_t e = 0; e < table.errors.size(); ++e) line.push_back(error_text(row.errors[e]) + (fronts[e][r] ? "*" : " "));
    const double time = least(row.cpu_times), particles = double(row.record.particles);
    line.push_back(std::isnan(time) ? "-" : print(time < 1 ? "%.3f" : time < 10 ? "%.2f" : "%.1f", time));
    const double bytes = bytes_per_particle(row.record);
    line.push_back(computed(row) ? number(particles, "") : "-");
    line.push_back(computed(row) ? number(double(row.record.steps), "") : "-");
    line.push_back(std::isnan(bytes) ? "-" : print("%.0f", bytes));
    const bool has_energy = computed(row) && !std::isnan(row.record.energy_error);
    if (with_energy) line.push_back(has_energy ? print("%.1e", row.record.energy_error) : "-");
    lines.push_back(std::move(line));
  }
  const bool any = std::any_of(fronts.begin(), fronts.end(),
                               [](const auto& front) { return std::find(front.begin(), front.end(), true) != front.end(); });
  return aligned(lines, left) + (any ? "* not beaten in both error and CPU time\n" : "") +
         (not_run > 0 ? std::to_string(not_run) + " more not run yet\n" : "");
}

std::string order_text(const std::vector<ObservedOrders>& orders) {
  std::string text;
  for (std::size_t i = 0; i < orders.size();) {
    std::size_t end = i;
    std::vector<std::pair<double, double>> steps;  // of any curve, from coarse to fine
    for (; end < orders.size() && orders[end].error == orders[i].error; ++end)
      for (std::size_t k = 0; k < orders[end].between.size(); ++k) steps.emplace_back(orders[end].h[k], orders[end].h[k + 1]);
    std::sort(steps.rbegin(), steps.rend());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    std::vector<std::vector<std::string>> lines{{"observed order of " + orders[i].error}};
    for (const auto& [coarse, fine] : steps) lines[0].push_back(print("%g", coarse) + " to " + print("%g", fine));
    lines[0].emplace_back("least squares");
    const auto order = [](double value) { return std::isnan(value) ? "-" : print("%.2f", value); };
    for (; i < end; ++i) {
      lines.push_back({"  " + orders[i].curve});
      for (const auto& step : steps) {
        std::string text_of = "-";
        for (std::size_t k = 0; k < orders[i].between.size(); ++k)
          if (std::pair(orders[i].h[k], orders[i].h[k + 1]) == step) text_of = order(orders[i].between[k]);
        lines.back().push_back(text_of);
      }
      lines.back().push_back(order(orders[i].fitted));
    }
    if (!text.empty()) text += '\n';
    text += aligned(lines, 1);
  }
  return text;
}

}  // namespace undex::study
