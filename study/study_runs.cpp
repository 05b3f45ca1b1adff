#include "study/study_runs.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "study/run_settings.hpp"
#include "core/errors.hpp"
#include "output/checkpoint.hpp"
#include "output/files.hpp"
#include "output/folder_lock.hpp"
#include "study/run_labels.hpp"

namespace undex::study {
namespace {

namespace fs = std::filesystem;

/// A resolved scene without its title, which nothing computes with.
std::string settings_of(std::string resolved) {
  const auto at = resolved.find("title = ");
  if (at != std::string::npos && (at == 0 || resolved[at - 1] == '\n')) resolved.erase(at, resolved.find('\n', at) + 1 - at);
  return resolved;
}

/// "changed: scheme.alpha, resolution.spacing".
std::string what_changed(const std::string& before, const std::string& now, const std::string& file) {
  try {
    std::string keys;
    const auto differing = differing_settings({read_resolved(before, file).settings, read_resolved(now, file).settings});
    for (std::size_t k = 0; k < differing.size() && k < 3; ++k) keys += (k > 0 ? ", " : "") + differing[k].key;
    if (differing.size() > 3) keys += ", ...";
    return "changed: " + (keys.empty() ? "threads, probes, output or comparison" : keys);
  } catch (const SceneError&) {
    return "damaged: its resolved.toml cannot be read";
  }
}

/// Whether a limit that ended a run would end it again.
bool holds(const std::optional<double>& now, double then) { return then > 0 && now && *now <= then; }

}  // namespace

RunState run_state(const fs::path& folder, const scene::Study& study, const scene::StudyRun& run) {
  RunState state;
  state.folder = folder;
  std::error_code error;
  if (!fs::exists(folder, error)) {
    state.reason = "not there";
    return state;
  }
  const std::optional<StudyOutcome> outcome = read_outcome(folder / "outcome.json");
  const bool failed = outcome && (outcome->status == "failed" || outcome->status == "refused");
  if (failed) {
    state.status = outcome->status;
    state.message = outcome->message;
    state.reason = outcome->status + " before";
  }
  const std::optional<std::string> resolved = output::text_of(folder / "resolved.toml");
  if (!resolved) {
    if (!failed) state.reason = "half-finished";
    return state;
  }
  if (settings_of(*resolved) != settings_of(run.resolved)) {
    state = {};
    state.folder = folder;
    state.reason = what_changed(*resolved, run.resolved, (folder / "resolved.toml").string());
    return state;
  }
  if (failed) return state;
  if (fs::exists(folder / "summary.json", error)) try {
      state.record = output::read_summary(folder / "summary.json");
    } catch (const FileError&) {
      state.reason = "damaged: its summary.json cannot be read";
      return state;
    }
  const bool own_timing = outcome && !outcome->cpu_times_s.empty() &&
                          (state.record.status.empty() || outcome->cpu_times_s.front() == state.record.cpu_time_s);
  state.cpu_times = own_timing ? outcome->cpu_times_s : std::vector{state.record.cpu_time_s};
  state.wall_times = own_timing ? outcome->wall_times_s : std::vector{state.record.wall_time_s};
  state.status = state.record.status.empty() ? "interrupted" : state.record.status;
  state.message = state.record.message;
  state.finished = state.status == "done" || state.status == "stopped";
  if (outcome && outcome->status == "limit" && !state.finished) {
    state.status = outcome->status;
    state.message = outcome->message;
    state.finished = holds(study.cpu_limit, outcome->cpu_limit_s) || holds(study.wall_limit, outcome->wall_limit_s);
  }
  for (const char* name : output::checkpoint_names)
    state.resumable = state.resumable || (!state.finished && fs::exists(folder / name, error));
  if (!state.finished) state.reason = state.status == "limit" ? "the limit that ended it has been raised" : "half-finished";
  return state;
}

std::vector<RunState> run_states(const scene::Study& study, const fs::path& runs_folder) {
  std::vector<RunState> states;
  for (const scene::StudyRun& run : study.runs) states.push_back(run_state(runs_folder / run.name, study, run));
  std::map<std::string, fs::path> others;  // by settings
  for (const fs::path& folder : left_over(states, study, runs_folder))
    if (const auto resolved = output::text_of(folder / "resolved.toml")) others[settings_of(*resolved)] = folder;
  for (std::size_t r = 0; r < states.size(); ++r)
    if (const auto found = others.find(settings_of(study.runs[r].resolved));
        states[r].reason == "not there" && found != others.end())
      if (RunState there = run_state(found->second, study, study.runs[r]); there.finished) states[r] = std::move(there);
  return states;
}

std::vector<fs::path> left_over(const std::vector<RunState>& states, const scene::Study& study, const fs::path& runs_folder) {
  std::set<fs::path> known;
  for (const RunState& state : states) known.insert(state.folder);
  for (const scene::StudyRun& run : study.runs) known.insert(runs_folder / run.name);
  std::vector<fs::path> result;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(runs_folder, error))
    if (!known.contains(entry.path())) result.push_back(entry.path());
  std::sort(result.begin(), result.end());
  return result;
}

void clear_run_folder(const fs::path& folder) {
  std::error_code error;
  const auto has = [&](const char* name) { return fs::exists(folder / name, error); };
  if (fs::exists(folder, error)) {
    if (!has("log.txt") && !has("resolved.toml") && !fs::is_empty(folder, error))
      throw UsageError(folder.string() +
                       " is in the way: it is no run's folder, and a run of the study needs its name; move it away");
    const output::FolderLock not_in_use(folder, "undex study");
    fs::remove_all(folder, error);
    if (error)
      throw FileError(folder.string() + ": cannot be cleared: " + error.message() +
                      "; remove it, or choose another folder with -o");
  }
  output::make_folder(folder);
}

}  // namespace undex::study
