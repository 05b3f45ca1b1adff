#include "study/study.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>

#include "core/errors.hpp"
#include "judge/comparisons.hpp"
#include "output/files.hpp"
#include "output/folder_lock.hpp"
#include "output/text_table.hpp"
#include "scene/suggestion.hpp"
#include "study/slurm.hpp"
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
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    empty = empty && (name == output::folder_lock_name ||
                      name.find("study.toml") != std::string::npos);  // another shard is just writing it
  }
  if (!empty && !fs::exists(folder / "study.toml", ignored))
    throw UsageError(folder.string() + " holds something that is no study; name another folder with -o");
}

bool chosen(const std::string& name, const std::vector<std::string>& patterns) {
  return patterns.empty() || std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
           return name.find(pattern) != std::string::npos || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
         });
}

/// The runs of a shard, from the coarsest on, so that each has some of each size.
std::set<std::size_t> runs_of(const Shard& shard, const scene::Study& study, const StudyTable& table) {
  std::vector<std::size_t> order(study.runs.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return table.rows[a].h > table.rows[b].h; });
  std::set<std::size_t> mine;
  for (std::size_t k = std::size_t(shard.index - 1); k < order.size(); k += std::size_t(shard.count)) mine.insert(order[k]);
  return mine;
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

Plan plan_of(const scene::Study& study, const std::vector<RunState>& states, const StudyTable& table,
             const StudyOptions& options) {
  Plan plan;
  std::set<std::size_t> mine;
  if (options.shard) mine = runs_of(*options.shard, study, table);
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    if (!chosen(study.runs[r].name, options.only) || (options.shard && !mine.contains(r))) continue;
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

std::string heading(const scene::Study& study, const fs::path& folder, const Plan& plan, const StudyOptions& options) {
  std::string text = study.name + ": " + study.title + "\n" + count_of(study.runs.size(), "run") + " in " +
                     (folder / "runs").string() + ": " + axes_text(study) + "\n";
  const std::size_t matched = plan.lines.size();
  if (options.shard)
    text += "shard " + std::to_string(options.shard->index) + " of " + std::to_string(options.shard->count) + ": " +
            std::to_string(matched) + " of them; ";
  else if (matched < study.runs.size()) text += std::to_string(matched) + " chosen by --only; ";
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
  std::vector<std::size_t> all(study.runs.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  work.rename_folders(all);
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
  std::printf("%s and order.csv are written. A page of it: undex report %s\n", (folder / "study.csv").c_str(), folder.c_str());
}

/// A share of the runs, beside other shares in the same folder. The tables are nobody's until all have ended.
int compute_shard(StudyWork& work, const scene::Study& study, const fs::path& folder, const Plan& plan,
                  const StudyOptions& options) {
  const Shard& shard = *options.shard;
  output::write_text_atomically(folder / "study.toml", output::text_of(study.file).value_or(""));  // first: it marks the folder
  const output::FolderLock own(folder / "shards" / (std::to_string(shard.index) + "_of_" + std::to_string(shard.count)),
                               "undex study --shard");
  output::make_folder(folder / "runs");
  work.share_the_folder();
  work.rename_folders(plan.to_compute);
  if (options.again) work.forget(plan.to_compute);
  const int signal = work.compute(plan.to_compute, options.jobs);
  bool failed = false;
  const StudyTable table = work.table();
  for (const std::size_t run : plan.to_compute)
    failed = failed || table.rows[run].status == "failed" || table.rows[run].status == "refused";
  if (!options.quiet)
    std::printf("%s; the tables of all shards: undex study %s -o %s --table\n",
                signal > 0 ? "interrupted; the same command goes on where this one ended" : "this shard has ended",
                options.study.c_str(), folder.c_str());
  return signal > 0 ? 128 + signal : failed ? exit_internal : exit_done;
}

/// Writes the job array, and says how it is used.
int write_slurm(const scene::Study& study, const fs::path& folder, const Plan& plan, const StudyOptions& options) {
  const int shards = *options.slurm > 0 ? *options.slurm : std::clamp(int(plan.to_compute.size()), 1, 1000);
  output::make_folder(folder / "shards");
  output::write_text_atomically(folder / "study.toml", output::text_of(study.file).value_or(""));
  output::write_text_atomically(folder / "study.slurm", slurm_script(study, folder, shards));
  std::printf(
      "%s is written: %d shards for %zu runs that are not there. Submit it with the time that one may take:\n"
      "  sbatch --time=4:00:00 %s\nWhen all have ended, the tables: undex study %s -o %s --table\n",
      (folder / "study.slurm").c_str(), shards, plan.to_compute.size(), (folder / "study.slurm").c_str(), options.study.c_str(),
      folder.c_str());
  return exit_done;
}

}  // namespace

Shard shard_of(const std::string& text) {
  Shard shard;
  char slash = 0;
  std::istringstream words(text);
  if (!(words >> shard.index >> slash >> shard.count) || slash != '/' || !words.eof() || shard.index < 1 || shard.count < 1 ||
      shard.index > shard.count)
    throw UsageError("--shard " + text + ": say which of how many, such as 2/8: the second of eight");
  return shard;
}

int run_study(const StudyOptions& options) {
  const scene::Study study = scene::read_study(options.study, judge::comparison_kinds());
  const References references = read_references(study);
  const fs::path folder = options.output.empty() ? study.output : options.output;
  require_study_folder(folder);
  require_match(study, options.only);
  std::optional<output::FolderLock> lock;
  if (!options.list) lock.emplace(folder, "undex study", options.shard ? output::Holding::shared : output::Holding::alone);
  StudyWork work(study, references, folder, options.quiet);
  const auto left_over_now = [&] { return left_over_text(left_over(work.states(), study, folder / "runs")); };
  const Plan plan = plan_of(study, work.states(), work.table(), options);
  const std::string text = heading(study, folder, plan, options);
  if (options.list) {
    std::printf("%s%s%s", text.c_str(), output::aligned(plan.lines, 3).c_str(), left_over_now().c_str());
    return exit_done;
  }
  if (!options.quiet) std::printf("%s", text.c_str());
  std::fflush(stdout);

  if (options.slurm) return write_slurm(study, folder, plan, options);
  if (options.shard) return compute_shard(work, study, folder, plan, options);
  begin_folder(work, study, folder);
  if (options.again && !options.table) work.forget(plan.to_compute);
  const int signal = work.compute(options.table ? std::vector<std::size_t>{} : plan.to_compute, options.jobs);
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
