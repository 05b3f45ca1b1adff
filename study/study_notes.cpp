#include "study/study_notes.hpp"

#include <algorithm>
#include <cmath>

#include "scene/suggestion.hpp"
#include "study/study_rows.hpp"

namespace undex::study {

std::string count_of(std::size_t number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

std::string axes_text(const scene::Study& study) {
  std::string text;
  std::size_t all = 1;
  for (const scene::StudyAxis& axis : study.axes) {
    text += (text.empty() ? "" : " x ") + axis.name + " (" + std::to_string(axis.values.size()) + ")";
    all *= axis.values.size();
  }
  if (all > study.runs.size()) text += ", " + std::to_string(all - study.runs.size()) + " excluded";
  return text.empty() ? "no axes" : text;
}

std::string missing_metrics(const scene::Study& study, const StudyTable& table) {
  std::vector<std::string> names;
  for (const auto& [name, ignored] : ledger_errors({})) names.push_back(name);
  const std::size_t ledgers = names.size();
  std::size_t done = 0;
  for (const StudyRow& row : table.rows) {
    done += row.status == "done";
    for (const auto& [name, ignored] : row.record.metrics)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  std::string nowhere, some;
  for (std::size_t e = 0; e < study.errors.size() && done > 0; ++e) {
    std::vector<std::string> missing;
    for (const StudyRow& row : table.rows)
      if (row.status == "done" && std::isnan(row.errors[e])) missing.push_back(row.name);
    const std::string& metric = study.errors[e].metric;
    if (std::find(names.begin(), names.end(), metric) == names.end())
      nowhere += (nowhere.empty() ? "" : ", ") + metric + (names.size() > ledgers ? scene::suggestion(metric, names) : "");
    else if (!missing.empty())
      some += "note: " + study.errors[e].label + " is blank in " + std::to_string(missing.size()) + " of " +
              std::to_string(done) + " runs, which have not come to it: " + missing[0] + (missing.size() > 1 ? ", ..." : "") +
              "\n";
  }
  if (!nowhere.empty())
    nowhere = "note: no run has the metric " + nowhere +
              (names.size() > ledgers ? "" : "; the scene has no [comparison] that gives any") + "\n";
  return nowhere + some;
}

std::string other_programs(const StudyTable& table, const std::string& program) {
  std::size_t others = 0;
  for (const StudyRow& row : table.rows) others += !row.record.program.empty() && row.record.program != program;
  return others == 0 ? ""
                     : "note: " + count_of(others, "run") + (others == 1 ? " is" : " are") +
                           " of another build of the program (column program); --again computes them again\n";
}

std::string left_over_text(const std::vector<std::filesystem::path>& folders) {
  if (folders.empty()) return "";
  std::string text = "note: " + count_of(folders.size(), "folder") + " of runs that the study no longer has:";
  for (std::size_t i = 0; i < std::min<std::size_t>(folders.size(), 3); ++i) text.append(" ").append(folders[i].string());
  return text + (folders.size() > 3 ? " ...\n" : "\n");
}

}  // namespace undex::study
