// [comparison]: its keys. What a kind needs of the scene it checks itself.
#include <algorithm>
#include <cmath>

#include "scene/draft.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

bool has_key(const ComparisonKind& kind, const std::string& key) {
  return std::find(kind.keys.begin(), kind.keys.end(), key) != kind.keys.end();
}

const ComparisonKind* read_kind(const TableReader& table, const std::vector<ComparisonKind>& kinds, std::string& into) {
  Choices<std::string> choices{{"none", "none"}};
  for (const ComparisonKind& kind : kinds) choices.push_back({kind.name.c_str(), kind.name});
  table.read_choice<std::string>("kind", into, choices);
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const ComparisonKind& kind) { return kind.name == into; });
  return found == kinds.end() ? nullptr : &*found;
}

/// Keys that belong to another kind than the scene's.
void complain_of_foreign_keys(const TableReader& table, const ComparisonKind* own, const std::vector<ComparisonKind>& kinds) {
  for (const ComparisonKind& kind : kinds)
    for (const std::string& key : kind.keys)
      if (table.has(key.c_str()) && !(own && has_key(*own, key)))
        table.complain(key.c_str(), table.path_of(key.c_str()) + " belongs to kind = \"" + kind.name + "\"; leave it out");
}

void read_window(const TableReader& table, Comparison& comparison) {
  std::vector<double> window;
  if (!table.read("window", window)) return;
  if (window.size() == 2 && window[0] < window[1]) {
    comparison.window_low = window[0];
    comparison.window_high = window[1];
  } else {
    table.complain("window", table.path_of("window") + " must be [least, largest] coordinate in m, the first below the second");
  }
}

void read_solution(const TableReader& table, Comparison& comparison) {
  Solution solution{};
  Choices<Solution> choices;
  for (const Solution each : {Solution::riemann, Solution::taylor_wave, Solution::sedov, Solution::noh})
    choices.push_back({solution_name(each), each});
  if (table.need("solution", "name the exact solution, e.g. solution = \"riemann\"") &&
      table.read_choice<Solution>("solution", solution, choices))
    comparison.solution = solution;
}

void read_similitude(const TableReader& table, Similitude& similitude) {
  table.read("explosive", similitude.explosive);
  table.read("charge_mass", similitude.charge_mass);
  for (const auto& [key, into] : {std::pair{"peak", &similitude.peak},
                                  {"decay", &similitude.decay},
                                  {"impulse", &similitude.impulse},
                                  {"energy_flux", &similitude.energy_flux}}) {
    std::vector<double> law;
    if (!table.read(key, law)) continue;
    if (law.size() == 2 && law[0] > 0 && std::isfinite(law[0]) && std::abs(law[1]) < 10) *into = law;
    else
      table.complain(key, table.path_of(key) +
                              " must be [factor, exponent] of its law of similitude, in kg, m, s and Pa, the factor "
                              "above 0");
  }
}

void complain_of_unknown_probe(const TableReader& table, const Scene& scene) {
  std::vector<std::string> names;
  for (const Probe& probe : scene.probes) names.push_back(probe.name);
  const std::string& name = scene.comparison.probe;
  if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
    table.complain("probe", "comparison.probe: no probe '" + name + "'" + suggestion(name, names));
}

void read_reference(const TableReader& table, Scene& scene) {
  std::string reference;
  if (!table.read("reference", reference) || reference.empty()) return;
  const std::filesystem::path full = scene.file.parent_path() / reference;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(full, ignored))
    table.complain("reference", "comparison.reference: no file '" + full.string() + "'; give it relative to the scene file");
  scene.comparison.reference = std::filesystem::absolute(full).lexically_normal().string();
}

}  // namespace

void read_comparison(Draft& draft, const std::vector<ComparisonKind>& kinds) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  Comparison& comparison = draft.scene.comparison;
  comparison.kind = "none";
  const Node* node = top.table("comparison");
  if (!node) return;
  const TableReader table(*node, "comparison", "comparison", top.dimension(), draft.report);
  const ComparisonKind* kind = read_kind(table, kinds, comparison.kind);
  complain_of_foreign_keys(table, kind, kinds);
  if (kind && has_key(*kind, "window")) read_window(table, comparison);
  if (kind && has_key(*kind, "solution")) read_solution(table, comparison);
  if (kind && has_key(*kind, "core")) table.read("core", comparison.core);
  if (kind && has_key(*kind, "explosive")) read_similitude(table, comparison.similitude);
  table.read("probe", comparison.probe);
  if (kind && kind->check) kind->check(table, draft.scene);
  complain_of_unknown_probe(table, draft.scene);
  if (kind && kind->needs_probe) table.need("probe", "name the probe that is compared");
  read_reference(table, draft.scene);
}

}  // namespace undex::scene
