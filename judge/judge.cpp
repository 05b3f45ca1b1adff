#include "judge/judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "core/errors.hpp"

namespace undex::judge {
namespace {

namespace fs = std::filesystem;

void require_use(const Comparison* comparison, const Reference& instead) {
  if (!instead.table && instead.history.empty()) return;
  if (comparison == nullptr)
    throw UsageError("the scene has no comparison, and no use for a reference; name one by comparison.kind and run it again");
  const std::string kind = "comparison.kind = \"" + comparison->kind.name + "\"";
  if (instead.table && !comparison->beside_table)
    throw UsageError(kind + " is judged beside an exact solution and has no use for a reference; leave it out");
  if (!instead.history.empty() && !*comparison->history)
    throw UsageError(kind + " has no use for a reference history; give a table of metrics");
}

Reference reference_of(const scene::Scene& scene, const Comparison* comparison, const Reference& instead) {
  require_use(comparison, instead);
  Reference reference = instead;
  if (comparison == nullptr || !comparison->beside_table || scene.comparison.reference.empty()) return reference;
  const fs::path table = scene.file.parent_path() / scene.comparison.reference;
  if (!reference.table) reference.table = read_reference_table(table);
  if (!*comparison->history || !reference.history.empty()) return reference;
  if (const fs::path history = table.parent_path() / comparison->history; fs::exists(history))
    reference.history = read_reference_history(history);
  return reference;
}

/// A reason for every metric that has no value, in the metrics' order.
void give_reasons(Verdict& verdict, const char* otherwise) {
  output::Reasons all;
  for (const auto& one : verdict.missing)
    if (one.first == "all") all.push_back(one);
  for (const auto& [name, value] : verdict.metrics) {
    if (!std::isnan(value)) continue;
    const auto given =
        std::find_if(verdict.missing.begin(), verdict.missing.end(), [&](const auto& one) { return one.first == name; });
    all.emplace_back(name, given == verdict.missing.end() ? otherwise : given->second);
  }
  verdict.missing = std::move(all);
}

}  // namespace

Judge::Judge(const scene::Scene& scene, const Reference& instead)
    : scene_(scene), comparison_(comparison_of(scene)), reference_(reference_of(scene, comparison_, instead)) {}

std::vector<std::string> Judge::last_fields() const {
  return comparison_ && comparison_->last_fields ? comparison_->last_fields(scene_) : std::vector<std::string>{};
}

Verdict Judge::verdict(const output::Evidence& evidence) const {
  if (comparison_ == nullptr) return {};
  try {
    Verdict verdict = comparison_->judge(scene_, evidence, reference_);
    give_reasons(verdict, comparison_->without_value);
    return verdict;
  } catch (const std::logic_error& mistake) {  // of arguments or domains
    return {.metrics = {}, .missing = {{"all", mistake.what()}}};
  } catch (const NumericalStop& stop) {
    return {.metrics = {}, .missing = {{"all", std::string("the solution to compare with: ") + stop.what()}}};
  }
}

std::string Judge::table(const output::NamedNumbers& metrics) const {
  if (comparison_ && !comparison_->beside_table) return metrics_text(metrics);
  return metrics.empty() || !reference_.table ? "" : format_comparison(metrics, *reference_.table);
}

std::string metrics_text(const output::NamedNumbers& metrics) {
  std::string text;
  char line[120];
  for (const auto& [name, value] : metrics) {
    std::snprintf(line, sizeof line, "%-34s %.5g\n", name.c_str(), value);
    text += line;
  }
  return text;
}

std::string missing_text(const output::Reasons& missing) {
  std::vector<std::pair<std::string, std::string>> lines;  // reason, and the metrics that it is the reason of
  for (const auto& [name, reason] : missing) {
    const auto same = [&](const auto& line) { return line.first == reason; };
    const auto line = std::find_if(lines.begin(), lines.end(), same);
    if (line == lines.end()) lines.emplace_back(reason, name);
    else line->second += ", " + name;
  }
  std::string text;
  for (const auto& [reason, names] : lines) text += "no value: " + names + ": " + reason + "\n";
  return text;
}

void write_tables(const fs::path& folder, const Verdict& verdict) {
  for (const auto& [name, table] : verdict.tables) output::write_history(folder / name, table);
}

}  // namespace undex::judge
