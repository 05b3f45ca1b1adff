#include "judge/judge.hpp"

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

}  // namespace

Judge::Judge(const scene::Scene& scene, const Reference& instead)
    : scene_(scene), comparison_(comparison_of(scene)), reference_(reference_of(scene, comparison_, instead)) {}

std::vector<std::string> Judge::last_fields() const {
  return comparison_ && comparison_->last_fields ? comparison_->last_fields(scene_) : std::vector<std::string>{};
}

Verdict Judge::verdict(const output::Evidence& evidence) const {
  if (comparison_ == nullptr) return {};
  try {
    return comparison_->judge(scene_, evidence, reference_);
  } catch (const std::invalid_argument&) {
    return {};  // histories that end in values that are no numbers have no results
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

void write_tables(const fs::path& folder, const Verdict& verdict) {
  for (const auto& [name, table] : verdict.tables) output::write_history(folder / name, table);
}

}  // namespace undex::judge
