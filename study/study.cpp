#include "study/study.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "core/errors.hpp"
#include "judge/comparisons.hpp"
#include "output/files.hpp"
#include "output/folder_lock.hpp"
#include "output/text_table.hpp"
#include "scene/suggestion.hpp"
#include "study/study_notes.hpp"
#include "study/study_work.hpp"

namespace undex::study {
namespace {

namespace fs = std::filesystem;

/// A folder that a study may write into: none yet, an empty one, or a study's.
void require_study_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) return;
  if (!fs::is_directory(folder, ignored))
    throw UsageError(folder.string() + " exists and is not a folder; name another one with -o");
  bool empty = true;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    empty = empty && entry.path().filename() == output::folder_lock_name;
  if (!empty && !fs::exists(folder / "study.toml", ignored))
    throw UsageError(folder.string() + " holds something that is no study; name another folder with -o");
}

bool chosen(const std::string& name, const std::vector<std::string>& patterns) {
  return patterns.empty() || std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
           return name.find(pattern) != std::string::npos || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
         });
}

/// Every pattern of --only must be of use.
void require_match(const scene::Study& study, const std::vector<std::string>& patterns) {
  for (const std::string& pattern : patterns) {
    if (std::any_of(study.runs.begin(), study.runs.end(), [&](const auto& run) { return chosen(run.name, {pattern}); })) continue;
    std::vector<std::string> names;
    for (std::size_t r = 0; r < std::min<std::size_t>(study.runs.size(), 10); ++r) names.push_back(study.runs[r].name);
    throw UsageError("--only " + pattern + ": no run of the study matches; names are such as " + scene::listed(names));
  }
}

/// Which runs are to be computed, and what is said of each.
struct Plan {
  std::vector<std::size_t> to_compute;
  std::map<std::string, std::size_t> reasons;   ///< how many of them for which
  std::vector<std::vector<std::string>> lines;  ///< name, "to run" or status, why
};

Plan plan_of(const scene::Study& study, const std::vector<RunState>& states, const StudyOptions& options) {
  Plan plan;
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    if (!chosen(study.runs[r].name, options.only)) continue;
    const RunState& state = states[r];
    const bool repeat = state.status == "done" && state.cpu_times.size() < std::size_t(study.repeats);
    const bool wanted = !state.finished || repeat || options.again;
    const std::string reason = !state.finished ? state.reason : options.again ? "again" : "timed again";
    if (wanted) {
      plan.to_compute.push_back(r);
      ++plan.reasons[reason.substr(0, reason.find(':'))];
    }
    plan.lines.push_back({"  " + study.runs[r].name, wanted ? "to run" : state.status, wanted ? reason : state.message});
  }
  return plan;
}

std::string heading(const scene::Study& study, const fs::path& folder, const Plan& plan) {
  std::string text = study.name + ": " + study.title + "\n" + count_of(study.runs.size(), "run") + " in " +
                     (folder / "runs").string() + ": " + axes_text(study) + "\n";
  const std::size_t matched = plan.lines.size();
  if (matched < study.runs.size()) text += std::to_string(matched) + " chosen by --only; ";
  text += std::to_string(matched - plan.to_compute.size()) + " there, " + std::to_string(plan.to_compute.size()) + " to run";
  std::string why;
  for (const auto& [reason, count] : plan.reasons) why += (why.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
  return text + (why.empty() ? "" : " (" + why + ")") + "\n";
}

/// The study as it stands now, before any run is computed.
void begin_folder(StudyWork& work, const scene::Study& study, const fs::path& folder) {
  output::make_folder(folder / "runs");
  output::write_text_atomically(folder / "study.toml", output::text_of(study.file).value_or(""));
  output::write_text_atomically(folder / "study.json", study_json(work.table()));
  work.rename_folders();
  work.write_tables();
}

/// The tables and everything that is to be said about them.
void print_results(const scene::Study& study, const StudyTable& table, const std::string& program, const std::string& left_over,
                   const fs::path& folder) {
  std::printf("\n%s", study_text(table).c_str());
  if (const auto orders = observed_orders(table); !orders.empty()) std::printf("\n%s", order_text(orders).c_str());
  std::printf("\n");
  for (const StudyRow& row : table.rows)
    if (!row.message.empty() && row.status != "not run")
      std::printf("%s, %s: %s\n", row.name.c_str(), row.status.c_str(), row.message.c_str());
  std::printf("%s%s%s", missing_metrics(study, table).c_str(), other_programs(table, program).c_str(), left_over.c_str());
  std::printf("%s and order.csv are written. Report: undex report %s\n", (folder / "study.csv").c_str(), folder.c_str());
}

}  // namespace

int run_study(const StudyOptions& options) {
  const scene::Study study = scene::read_study(options.study, judge::comparison_kinds());
  const References references = read_references(study);
  const fs::path folder = options.output.empty() ? study.output : options.output;
  require_study_folder(folder);
  require_match(study, options.only);
  std::optional<output::FolderLock> lock;
  if (!options.list) lock.emplace(folder, "undex study");
  StudyWork work(study, references, folder, options.quiet);
  const auto left_over_now = [&] { return left_over_text(left_over(work.states(), study, folder / "runs")); };
  const Plan plan = plan_of(study, work.states(), options);
  const std::string text = heading(study, folder, plan);
  if (options.list) {
    std::printf("%s%s%s", text.c_str(), output::aligned(plan.lines, 3).c_str(), left_over_now().c_str());
    return exit_done;
  }
  if (!options.quiet) std::printf("%s", text.c_str());
  std::fflush(stdout);

  begin_folder(work, study, folder);
  if (options.again) work.forget(plan.to_compute);
  const int signal = work.compute(plan.to_compute, options.jobs);
  work.write_tables();
  const StudyTable table = work.table();
  if (!options.quiet) print_results(study, table, options.program, left_over_now(), folder);
  if (signal > 0) {
    if (!options.quiet) std::printf("interrupted; the same command goes on where this one ended\n");
    return 128 + signal;
  }
  const bool failed = std::any_of(table.rows.begin(), table.rows.end(),
                                  [](const StudyRow& row) { return row.status == "failed" || row.status == "refused"; });
  return failed ? exit_internal : exit_done;
}

}  // namespace undex::study
