#include "study/compared.hpp"

#include <algorithm>
#include <set>

#include "core/errors.hpp"
#include "judge/metric_names.hpp"
#include "judge/radial.hpp"

namespace undex::study {
namespace {

using judge::spoken;
using output::HistoryColumn;
using output::Series;

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
std::string common_name(const ComparedRun& run, const std::string& name, const ComparedRun& first) {
  const std::string& primary = first.scene.compared_probe;
  if (name != run.scene.compared_probe || name == primary || run.scene.probes.contains(primary)) return name;
  const auto theirs = first.scene.probes.find(primary), mine = run.scene.probes.find(name);
  const bool same =
      theirs != first.scene.probes.end() && mine != run.scene.probes.end() && theirs->second.kind == mine->second.kind;
  return same ? primary : name;
}

/// The place of a quantity of that probe and column among all; made where there is none.
Series& place(std::vector<Compared>& all, std::size_t runs, std::size_t run, const std::string& probe, const std::string& kind,
              const HistoryColumn& column) {
  const std::string name = spoken(column.name);
  const auto found = std::find_if(all.begin(), all.end(), [&](const Compared& each) {
    return each.quantity.probe == probe && each.quantity.name == name && each.kind == kind && each.quantity.unit == column.unit;
  });
  if (found != all.end()) return found->quantity.runs[run];
  Compared& fresh = all.emplace_back();
  fresh.quantity.probe = probe;
  fresh.quantity.name = name;
  fresh.quantity.unit = column.unit;
  fresh.quantity.runs.resize(runs);
  fresh.kind = kind;
  fresh.column = column.name.starts_with("radial ") ? column.name.substr(7) : column.name;
  return fresh.quantity.runs[run];
}

/// Histories of one run's probes. Names those that do not stand where the first run's do.
void add_probes(const std::vector<ComparedRun>& runs, std::size_t r, std::vector<Compared>& all,
                std::set<std::string>& displaced) {
  const ComparedRun &run = runs[r], &first = runs.front();
  for (const std::string& name : run.scene.probe_order) {
    const auto history = run.folder.probes.find(name);
    if (history == run.folder.probes.end()) continue;
    const RunProbe& probe = run.scene.probes.at(name);
    const std::string common = common_name(run, name, first);
    for (HistoryColumn& column : radial_columns(history->second, probe, run.scene.axis))
      place(all, runs.size(), r, common, probe.kind, column) = std::move(column.series);
    const auto other = first.scene.probes.find(common);
    if (r > 0 && other != first.scene.probes.end() && other->second.kind == probe.kind &&
        (other->second.point - probe.point).norm() > 1e-9 * (1 + probe.point.norm()))
      displaced.insert(common);
  }
}

void add_energies(const std::vector<ComparedRun>& runs, std::size_t r, std::vector<Compared>& all) {
  for (const HistoryColumn& column : runs[r].folder.energies) {
    // What a run does not have at all is zero in its ledger.
    const auto& y = column.series.y;
    if (column.name == "total" || std::all_of(y.begin(), y.end(), [](double value) { return value == 0; })) continue;
    place(all, runs.size(), r, "energy", "energy", column) = column.series;
  }
}

}  // namespace

std::vector<Compared> gather(const std::vector<ComparedRun>& runs, std::vector<std::string>& notes) {
  std::vector<Compared> all;
  std::set<std::string> displaced;
  for (std::size_t r = 0; r < runs.size(); ++r) add_probes(runs, r, all, displaced);
  for (const std::string& name : displaced) notes.push_back("probe " + name + " does not stand at the same point in all runs");
  const std::string& primary = runs.front().scene.compared_probe;
  std::stable_partition(all.begin(), all.end(), [&](const Compared& each) { return each.quantity.probe == primary; });
  for (std::size_t r = 0; r < runs.size(); ++r) add_energies(runs, r, all);
  return all;
}

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

}  // namespace undex::study
