// undex study: a grid of runs, computed where they are not there yet, and one table of all of them.
#include <fcntl.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <memory>

#include "judge/comparisons.hpp"
#include "study/child_process.hpp"
#include "study/study.hpp"
#include "study/study_progress.hpp"
#include "study/study_runs.hpp"
#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/text_table.hpp"
#include "scene/suggestion.hpp"

namespace undex::study {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

volatile std::sig_atomic_t first_signal = 0, signals = 0;
void count_signal(int number) {
  if (signals == 0) first_signal = number;
  signals = signals + 1;
}

/// SIGINT and SIGTERM end the runs under way, which then record what they have; a second one kills them.
void catch_signals() {
  struct sigaction action {};
  action.sa_handler = count_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

/// Held as long as a study is at work in its folder.
class Lock {
 public:
  explicit Lock(const fs::path& folder) : file_(open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0) output::throw_file_error("write", folder / ".lock", errno);
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      close(file_);
      throw UsageError("another undex study is at work in " + folder.string() +
                       "; wait for it, or choose another folder with -o");
    }
  }
  ~Lock() { close(file_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_;
};

using References = std::map<fs::path, judge::ReferenceTable>;

/// The reference tables of the scenes, where an error is a difference from one of their sources.
References read_references(const scene::Study& study) {
  References tables;
  std::vector<Finding> findings;
  for (const scene::StudyError& error : study.errors) {
    if (error.source.empty()) continue;
    for (const scene::StudyRun& run : study.runs) {
      if (run.reference.empty()) {
        findings.push_back({error.where, "errors: '" + error.label +
                                             "' needs the scene's comparison.reference, and the scene of run " + run.name +
                                             " has none"});
        break;
      }
      const auto [table, fresh] = tables.try_emplace(run.reference);
      if (fresh) table->second = judge::read_reference_table(run.reference);
      const std::vector<std::string>& sources = table->second.sources;
      std::vector<std::string> metrics;
      for (const auto& row : table->second.rows) metrics.push_back(row.metric);
      const std::string file = run.reference.string();
      if (const auto source = std::find(sources.begin(), sources.end(), error.source); source == sources.end())
        findings.push_back({error.where, "errors: " + file + " has no source '" + error.source + "'" +
                                             scene::suggestion(error.source, sources)});
      else if (const auto metric = std::find(metrics.begin(), metrics.end(), error.metric); metric == metrics.end())
        findings.push_back({error.where, "errors: " + file + " has no metric '" + error.metric + "'" +
                                             scene::suggestion(error.metric, metrics)});
      else if (const double value =
                   table->second.rows[std::size_t(metric - metrics.begin())].values[std::size_t(source - sources.begin())].value;
               std::isnan(value) || value == 0)
        findings.push_back(
            {error.where, "errors: source '" + error.source + "' of " + file + " has no value of " + error.metric});
      else continue;
      break;
    }
  }
  if (!findings.empty()) throw SceneError(study.file.string(), findings);
  return tables;
}

/// A folder that a study may write into: none yet, an empty one, or a study's.
void require_study_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) return;
  if (!fs::is_directory(folder, ignored))
    throw UsageError(folder.string() + " exists and is not a folder; name another one with -o");
  bool empty = true;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) empty = empty && entry.path().filename() == ".lock";
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

/// The row that says what is known of a run.
StudyRow row_of(const scene::Study& study, const scene::StudyRun& run, const RunState& state, const References& references) {
  StudyRow row;
  row.name = run.name;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const scene::StudyValue& value = study.axes[a].values[run.values[a]];
    row.values.push_back(value.label);
    if (a == study.resolution) row.h = value.number;
    else row.curve += (row.curve.empty() ? "" : ", ") + value.label;
    if (study.axes[a].problem) row.problem += (row.problem.empty() ? "" : ", ") + value.label;
  }
  if (row.curve.empty()) row.curve = study.name;
  // Results of other settings are not this run's.
  const bool known = state.finished || state.status == "failed" || state.status == "refused" || state.status == "interrupted" ||
                     state.status == "limit";
  row.status = known ? state.status : "not run";
  row.message = known ? state.message : state.reason == "not there" ? "" : state.reason;
  row.record = state.record;
  row.cpu_times = state.cpu_times;
  row.wall_times = state.wall_times;
  const auto reference = references.find(run.reference);
  row.errors =
      state.status == "done"
          ? study_errors(study, state.record, reference == references.end() ? std::nullopt : std::optional(reference->second))
          : std::vector<double>(study.errors.size(), nan);
  return row;
}

std::string quoted_for_shell(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \"'[]{}()$&;*?!<>|#~\\") == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::vector<std::string> run_arguments(const scene::StudyRun& run, const fs::path& folder) {
  std::vector<std::string> arguments{"run", run.scene.string(), "-o", folder.string(), "-q", "--force"};
  for (const scene::Override& setting : run.settings)
    arguments.insert(arguments.end(), {"-P", setting.key + "=" + setting.value});
  return arguments;
}

/// What a run that did not get as far as a summary said, on one line.
std::string said(const fs::path& log) {
  std::string text = output::text_of(log).value_or("");
  text.erase(0, std::min(text.size(), text.find('\n') + 1));  // the command
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() > 500 ? text.substr(0, 497) + "..." : text;
}

// ------------------------------------------------------------------------------------------------ the work

class Work {
 public:
  Work(const scene::Study& study, const References& references, const fs::path& folder, bool quiet)
      : study_(study), references_(references), folder_(folder), states_(run_states(study, folder / "runs")), quiet_(quiet) {
    for (std::size_t r = 0; r < study.runs.size(); ++r) rows_.push_back(row_of(study, study.runs[r], states_[r], references));
  }

  const std::vector<RunState>& states() const { return states_; }

  StudyTable table() const {
    StudyTable table{study_.title, {}, study_.resolution ? study_.axes[*study_.resolution].name : "", {}, rows_};
    for (const scene::StudyAxis& axis : study_.axes) table.axes.push_back(axis.name);
    for (const scene::StudyError& error : study_.errors) table.errors.push_back(error.label);
    return table;
  }

  void write_tables() const {
    const StudyTable table = this->table();
    output::write_text_atomically(folder_ / "study.csv", study_csv(table));
    const std::vector<ObservedOrders> orders = observed_orders(table);
    if (orders.empty()) fs::remove(folder_ / "order.csv");
    else output::write_text_atomically(folder_ / "order.csv", order_csv(orders));
  }

  /// Runs that are in folders of other names get their own.
  void rename_folders() {
    for (std::size_t r = 0; r < states_.size(); ++r) {
      const fs::path own = folder_ / "runs" / study_.runs[r].name;
      if (states_[r].folder == own) continue;
      std::error_code error;
      fs::rename(states_[r].folder, own, error);
      if (error)
        throw FileError(own.string() + ": " + states_[r].folder.string() + " cannot be renamed to it: " + error.message());
      states_[r].folder = own;
    }
  }

  /// What is there of these runs does not count.
  void forget(const std::vector<std::size_t>& runs) {
    for (const std::size_t run : runs) states_[run].finished = false;
  }

  /// Computes the runs, `jobs` at a time, coarse ones first. Returns when all have ended, or after a signal.
  void compute(std::vector<std::size_t> runs, int jobs) {
    std::stable_sort(runs.begin(), runs.end(), [&](std::size_t a, std::size_t b) { return rows_[a].h > rows_[b].h; });
    pending_.assign(runs.rbegin(), runs.rend());
    StudyProgress progress(runs.size(), quiet_);
    catch_signals();
    int passed_on = 0;
    while (!active_.empty() || (!pending_.empty() && signals == 0)) {
      while (active_.size() < std::size_t(jobs) && !pending_.empty() && signals == 0) {
        const std::size_t run = pending_.back();
        pending_.pop_back();
        start(run);
      }
      if (signals > passed_on) {
        passed_on = signals;
        if (!quiet_ && passed_on == 1) {
          progress.clear();
          std::printf("interrupted: the runs under way are ended; once more kills them\n");
          std::fflush(stdout);
        }
        for (const auto& job : active_) job->child->send(passed_on == 1 ? SIGTERM : SIGKILL);
      }
      for (std::size_t j = 0; j < active_.size();) {
        Job& job = *active_[j];
        enforce_limits(job);
        if (const auto end = job.child->ended()) {
          const std::size_t run = job.run;
          const bool more = take_in(job, *end);
          active_.erase(active_.begin() + std::ptrdiff_t(j));
          write_tables();
          if (more) start(run);
          else progress.line(rows_[run], table().errors, seconds_left(jobs));
        } else {
          ++j;
        }
      }
      if (progress.bar_is_due()) {
        std::vector<std::string> names;
        for (const auto& job : active_)
          names.push_back(study_.runs[job->run].name + " " + output::duration(job->child->wall_time()));
        progress.bar(names, seconds_left(jobs));
      }
      usleep(20000);
    }
    progress.clear();
  }

 private:
  struct Job {
    std::size_t run;
    bool repetition;  ///< in a folder of its own, for the time only
    std::unique_ptr<ChildProcess> child;
    double cpu_limit = 0, wall_limit = 0;  ///< the one that it passed
    double ended_at = 0;                   ///< wall time at which it was told to end
  };

  fs::path repetition_folder(std::size_t run) const { return states_[run].folder / "repetition"; }

  void start(std::size_t run) {
    RunState& state = states_[run];
    Job job{run, state.finished, nullptr};
    if (!job.repetition) {
      state.folder = folder_ / "runs" / study_.runs[run].name;
      clear_run_folder(state.folder);
      state.cpu_times.clear();
      state.wall_times.clear();
    }
    const auto arguments = run_arguments(study_.runs[run], job.repetition ? repetition_folder(run) : state.folder);
    std::string command = "undex";
    for (const std::string& argument : arguments) command += " " + quoted_for_shell(argument);
    const fs::path log = state.folder / (job.repetition ? "repetition.txt" : "log.txt");
    output::write_text_atomically(log, command + "\n");
    job.child = std::make_unique<ChildProcess>(arguments, log);
    active_.push_back(std::make_unique<Job>(std::move(job)));
  }

  void enforce_limits(Job& job) const {
    constexpr double patience = 30;  // [s] from SIGTERM, which a run obeys after its present step, to SIGKILL
    if (job.ended_at > 0) {
      if (job.child->wall_time() > job.ended_at + patience) job.child->send(SIGKILL);
      return;
    }
    if (study_.cpu_limit && job.child->cpu_time() > *study_.cpu_limit) job.cpu_limit = *study_.cpu_limit;
    if (study_.wall_limit && job.child->wall_time() > *study_.wall_limit) job.wall_limit = *study_.wall_limit;
    if (job.cpu_limit == 0 && job.wall_limit == 0) return;
    job.ended_at = job.child->wall_time();
    job.child->send(SIGTERM);
  }

  /// What a process left becomes the state of its run. Returns whether the run is to be repeated for its time.
  bool take_in(const Job& job, const ChildProcess::End& end) {
    const scene::StudyRun& run = study_.runs[job.run];
    RunState& state = states_[job.run];
    if (job.repetition) {
      std::error_code ignored;
      try {
        const output::RunRecord record = output::read_summary(repetition_folder(job.run) / "summary.json");
        if (record.status != "done") throw FileError(record.status);
        state.cpu_times.push_back(record.cpu_time_s);
        state.wall_times.push_back(record.wall_time_s);
      } catch (const FileError&) {  // not repeated again: the times so far are what there is
        fs::remove_all(repetition_folder(job.run), ignored);
        return false;
      }
      fs::remove_all(repetition_folder(job.run), ignored);
      fs::remove(state.folder / "repetition.txt", ignored);
    } else {
      StudyOutcome outcome{"", "", {end.cpu_time_s}, {end.wall_time_s}};
      if (job.ended_at > 0 && end.exit_code != 0) {
        outcome.status = "limit";
        outcome.message = job.cpu_limit > 0 ? "ended at cpu_limit = " + output::print("%g", job.cpu_limit) + " s"
                                            : "ended at wall_limit = " + output::print("%g", job.wall_limit) + " s";
        outcome.cpu_limit_s = job.cpu_limit;
        outcome.wall_limit_s = job.wall_limit;
      } else if (end.signal != 0 && signals == 0) {
        outcome.status = "failed";
        outcome.message = "killed by signal " + std::to_string(end.signal) + " (" + strsignal(end.signal) + ")" +
                          (end.signal == SIGKILL ? "; out of memory?" : "");
      } else if (end.exit_code == exit_usage || end.exit_code == exit_internal) {
        outcome.status = end.exit_code == exit_usage ? "refused" : "failed";
        outcome.message = said(state.folder / "log.txt");
      }
      const auto summary = [&]() -> std::optional<output::RunRecord> {
        try {
          return output::read_summary(state.folder / "summary.json");
        } catch (const FileError&) {
          return std::nullopt;
        }
      }();
      if (summary) {
        outcome.cpu_times_s = {summary->cpu_time_s};
        outcome.wall_times_s = {summary->wall_time_s};
        if (outcome.status.empty()) outcome.status = summary->status;
        if (outcome.message.empty()) outcome.message = summary->message;
      }
      if (outcome.status.empty()) outcome.status = "interrupted";
      write_outcome(state.folder / "outcome.json", outcome);
      state = run_state(state.folder, study_, run);
      if (state.reason.starts_with("changed")) {  // also what is found next time
        state.status = "failed";
        state.message = "the scene file was changed while the study ran; start the study again";
      }
    }
    if (job.repetition)
      write_outcome(state.folder / "outcome.json", {state.status, state.message, state.cpu_times, state.wall_times});
    rows_[job.run] = row_of(study_, run, state, references_);
    return signals == 0 && state.status == "done" && state.cpu_times.size() < std::size_t(study_.repeats);
  }

  double seconds_left(int jobs) const {
    const RunTimes times(study_, rows_);
    double sum = 0, longest = 0;
    const auto add = [&](double seconds) {
      sum += seconds;
      longest = std::max(longest, seconds);
    };
    for (const std::size_t run : pending_) add(study_.repeats * times.expected(run));
    for (const auto& job : active_) {
      const double repeats = study_.repeats - (job->repetition ? double(states_[job->run].cpu_times.size()) : 0.0);
      add(std::max(0.0, repeats * times.expected(job->run) - job->child->wall_time()));
    }
    return std::max(sum / jobs, longest);
  }

  const scene::Study& study_;
  const References& references_;
  fs::path folder_;
  std::vector<RunState> states_;
  std::vector<StudyRow> rows_;
  bool quiet_;
  std::vector<std::size_t> pending_;  ///< the next one last
  std::vector<std::unique_ptr<Job>> active_;
};

// ------------------------------------------------------------------------------------------------ what is said

std::string count_of(std::size_t number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

/// "spacing (4) x scheme (3)".
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

/// Errors that runs do not have though they are done: one note.
std::string missing_metrics(const scene::Study& study, const StudyTable& table) {
  std::vector<std::string> names{"mass_error", "momentum_error", "energy_error", "interface_energy_error",
                                 "interface_impulse_error"};
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

/// Runs that another program computed.
std::string other_programs(const StudyTable& table, const std::string& program) {
  std::size_t others = 0;
  for (const StudyRow& row : table.rows) others += !row.record.program.empty() && row.record.program != program;
  return others == 0 ? ""
                     : "note: " + count_of(others, "run") + (others == 1 ? " is" : " are") +
                           " of another build of the program (column program); --again computes them again\n";
}

std::string left_over_text(const std::vector<fs::path>& folders) {
  if (folders.empty()) return "";
  std::string text = "note: " + count_of(folders.size(), "folder") + " of runs that the study no longer has:";
  for (std::size_t i = 0; i < std::min<std::size_t>(folders.size(), 3); ++i) text += " " + folders[i].string();
  return text + (folders.size() > 3 ? " ...\n" : "\n");
}

}  // namespace

int run_study(const StudyOptions& options) {
  const scene::Study study = scene::read_study(options.study, judge::comparison_kinds());
  const References references = read_references(study);
  const fs::path folder = options.output.empty() ? study.output : options.output;
  require_study_folder(folder);
  require_match(study, options.only);
  std::unique_ptr<Lock> lock;
  if (!options.list) {
    output::make_folder(folder);
    lock = std::make_unique<Lock>(folder);
  }

  Work work(study, references, folder, options.quiet);
  std::vector<std::size_t> to_compute;
  std::map<std::string, std::size_t> reasons;
  std::vector<std::vector<std::string>> plan;
  std::size_t matched = 0;
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    const RunState& state = work.states()[r];
    const bool repeat = state.status == "done" && state.cpu_times.size() < std::size_t(study.repeats);
    if (!chosen(study.runs[r].name, options.only)) continue;
    ++matched;
    const bool wanted = !state.finished || repeat || options.again;
    const std::string reason = !state.finished ? state.reason : options.again ? "again" : "timed again";
    if (wanted) {
      to_compute.push_back(r);
      ++reasons[reason.substr(0, reason.find(':'))];
    }
    plan.push_back({"  " + study.runs[r].name, wanted ? "to run" : state.status, wanted ? reason : state.message});
  }
  std::string text = study.name + ": " + study.title + "\n" + count_of(study.runs.size(), "run") + " in " +
                     (folder / "runs").string() + ": " + axes_text(study) + "\n";
  if (matched < study.runs.size()) text += std::to_string(matched) + " chosen by --only; ";
  text += std::to_string(matched - to_compute.size()) + " there, " + std::to_string(to_compute.size()) + " to run";
  std::string why;
  for (const auto& [reason, count] : reasons) why += (why.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
  text += (why.empty() ? "" : " (" + why + ")") + "\n";
  if (options.list) {
    std::printf("%s%s%s", text.c_str(), output::aligned(plan, 3).c_str(),
                left_over_text(left_over(work.states(), study, folder / "runs")).c_str());
    return exit_done;
  }
  if (!options.quiet) std::printf("%s", text.c_str());
  std::fflush(stdout);

  output::make_folder(folder / "runs");
  output::write_text_atomically(folder / "study.toml", output::text_of(study.file).value_or(""));
  output::write_text_atomically(folder / "study.json", study_json(work.table()));
  work.rename_folders();
  work.write_tables();
  if (options.again) work.forget(to_compute);
  work.compute(to_compute, options.jobs);
  work.write_tables();

  const StudyTable table = work.table();
  std::size_t failed = 0;
  for (const StudyRow& row : table.rows) failed += row.status == "failed" || row.status == "refused";
  if (!options.quiet) {
    std::printf("\n%s", study_text(table).c_str());
    if (const auto orders = observed_orders(table); !orders.empty()) std::printf("\n%s", order_text(orders).c_str());
    std::printf("\n");
    for (const StudyRow& row : table.rows)
      if (!row.message.empty() && row.status != "not run")
        std::printf("%s, %s: %s\n", row.name.c_str(), row.status.c_str(), row.message.c_str());
    std::printf("%s%s%s", missing_metrics(study, table).c_str(), other_programs(table, options.program).c_str(),
                left_over_text(left_over(work.states(), study, folder / "runs")).c_str());
    std::printf("%s and order.csv are written. Pictures: /usr/bin/python3 scripts/plot_study.py %s\n",
                (folder / "study.csv").c_str(), folder.c_str());
  }
  if (signals > 0) {
    if (!options.quiet) std::printf("interrupted; the same command goes on where this one ended\n");
    return 128 + first_signal;
  }
  return failed > 0 ? exit_internal : exit_done;
}

}  // namespace undex::study
