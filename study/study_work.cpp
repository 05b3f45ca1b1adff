#include "study/study_work.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "core/errors.hpp"
#include "core/signals.hpp"
#include "output/files.hpp"
#include "output/folder_lock.hpp"
#include "output/text_table.hpp"
#include "study/shell.hpp"

namespace undex::study {
namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t first_signal = 0, signals = 0;
void count_signal(int number) {
  if (signals == 0) first_signal = number;
  if (signals == 0 || end_signal(number).insists) signals = signals + 1;
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

bool in_use(const fs::path& folder) {
  try {
    const output::FolderLock free(folder, "undex study");
    return false;
  } catch (const UsageError&) {
    return true;
  }
}

/// The run's own record; nothing where it did not come to one.
std::optional<output::RunRecord> summary_of(const fs::path& folder) {
  try {
    return output::read_summary(folder / "summary.json");
  } catch (const FileError&) {
    return std::nullopt;
  }
}

}  // namespace

StudyWork::StudyWork(const scene::Study& study, const References& references, const fs::path& folder, bool quiet)
    : study_(study), references_(references), folder_(folder), states_(run_states(study, folder / "runs")), quiet_(quiet) {
  for (std::size_t r = 0; r < study.runs.size(); ++r) rows_.push_back(row_of(study, study.runs[r], states_[r], references));
}

StudyTable StudyWork::table() const {
  StudyTable table{study_.title, {}, study_.resolution ? study_.axes[*study_.resolution].name : "", {}, rows_};
  for (const scene::StudyAxis& axis : study_.axes) table.axes.push_back(axis.name);
  for (const scene::StudyError& error : study_.errors) table.errors.push_back(error.label);
  return table;
}

void StudyWork::write_tables() const {
  if (shared_) return;
  const StudyTable table = this->table();
  output::write_text_atomically(folder_ / "study.csv", study_csv(table));
  const std::vector<ObservedOrders> orders = observed_orders(table);
  if (orders.empty()) fs::remove(folder_ / "order.csv");
  else output::write_text_atomically(folder_ / "order.csv", order_csv(orders));
}

void StudyWork::rename_folders(const std::vector<std::size_t>& runs) {
  for (const std::size_t r : runs) {
    const fs::path own = folder_ / "runs" / study_.runs[r].name;
    if (states_[r].folder == own) continue;
    { const output::FolderLock not_in_use(states_[r].folder, "undex study"); }
    std::error_code error;
    fs::rename(states_[r].folder, own, error);
    if (error) throw FileError(own.string() + ": " + states_[r].folder.string() + " cannot be renamed to it: " + error.message());
    states_[r].folder = own;
  }
}

void StudyWork::forget(const std::vector<std::size_t>& runs) {
  for (const std::size_t run : runs) states_[run].finished = states_[run].resumable = false;
}

int StudyWork::compute(std::vector<std::size_t> runs, int jobs) {
  std::stable_sort(runs.begin(), runs.end(), [&](std::size_t a, std::size_t b) { return rows_[a].h > rows_[b].h; });
  pending_.assign(runs.rbegin(), runs.rend());
  StudyProgress progress(runs.size(), quiet_);
  catch_end_signals(count_signal, /*second_kills=*/false);
  while (!active_.empty() || (!pending_.empty() && signals == 0)) {
    start_waiting(jobs);
    pass_on_signals(progress);
    take_in_ended(progress, jobs);
    show_bar(progress, jobs);
    usleep(20000);
  }
  progress.clear();
  return signals > 0 ? first_signal : 0;
}

void StudyWork::start_waiting(int jobs) {
  while (active_.size() < std::size_t(jobs) && !pending_.empty() && signals == 0) {
    const std::size_t run = pending_.back();
    pending_.pop_back();
    start(run);
  }
}

void StudyWork::start(std::size_t run) {
  RunState& state = states_[run];
  const fs::path own = folder_ / "runs" / study_.runs[run].name;
  if (shared_ && in_use(own)) {
    if (!quiet_) std::printf("%s is computed by another process: left to it\n", study_.runs[run].name.c_str());
    return;
  }
  Job job{.run = run, .repetition = state.finished, .resumes = state.resumable && state.folder == own, .child = nullptr};
  if (job.resumes) {
    job.cpu_before = state.record.cpu_time_s;
    job.wall_before = state.record.wall_time_s;
    state.resumable = false;  // where it cannot, it begins anew
  } else if (!job.repetition) {
    state.folder = own;
    clear_run_folder(state.folder);
  }
  if (!job.repetition) {
    state.cpu_times.clear();
    state.wall_times.clear();
  }
  const auto arguments = job.resumes ? std::vector<std::string>{"resume", state.folder.string(), "-q"}
                                     : run_arguments(study_.runs[run], job.repetition ? repetition_folder(run) : state.folder);
  std::string command = "undex";
  for (const std::string& argument : arguments) command.append(" ").append(quoted_for_shell(argument));
  const fs::path log = state.folder / (job.repetition ? "repetition.txt" : "log.txt");
  output::write_text_atomically(log, command + "\n");
  job.child = std::make_unique<ChildProcess>(arguments, log);
  active_.push_back(std::make_unique<Job>(std::move(job)));
}

/// The first signal ends the runs under way, a further one kills them.
void StudyWork::pass_on_signals(StudyProgress& progress) {
  if (signals <= passed_on_) return;
  passed_on_ = signals;
  if (!quiet_ && passed_on_ == 1) {
    progress.clear();
    std::printf("interrupted: the runs under way are ended; once more kills them\n");
    std::fflush(stdout);
  }
  for (const auto& job : active_) job->child->send(passed_on_ == 1 ? SIGTERM : SIGKILL);
}

void StudyWork::enforce_limits(Job& job) const {
  constexpr double patience = 30;  // [s] from SIGTERM, which a run obeys after its present step, to SIGKILL
  if (job.ended_at > 0) {
    if (job.child->wall_time() > job.ended_at + patience) job.child->send(SIGKILL);
    return;
  }
  if (study_.cpu_limit && job.cpu_before + job.child->cpu_time() > *study_.cpu_limit) job.cpu_limit = *study_.cpu_limit;
  if (study_.wall_limit && job.wall_before + job.child->wall_time() > *study_.wall_limit) job.wall_limit = *study_.wall_limit;
  if (job.cpu_limit == 0 && job.wall_limit == 0) return;
  job.ended_at = job.child->wall_time();
  job.child->send(SIGTERM);
}

void StudyWork::take_in_ended(StudyProgress& progress, int jobs) {
  for (std::size_t j = 0; j < active_.size();) {
    Job& job = *active_[j];
    enforce_limits(job);
    const auto end = job.child->ended();
    if (!end) {
      ++j;
      continue;
    }
    const std::size_t run = job.run;
    const bool more = take_in(job, *end);
    active_.erase(active_.begin() + std::ptrdiff_t(j));
    write_tables();
    if (more) start(run);
    else progress.line(rows_[run], table().errors, seconds_left(jobs));
  }
}

/// What a process left becomes the state of its run. Returns whether the run is to be repeated for its time.
bool StudyWork::take_in(const Job& job, const ChildProcess::End& end) {
  const scene::StudyRun& run = study_.runs[job.run];
  RunState& state = states_[job.run];
  if (job.repetition) {
    if (!take_in_repetition(job)) return false;  // not repeated again: the times so far are what there is
  } else if (job.resumes && end.exit_code == exit_restart) {
    return signals == 0;  // another program or machine, or a damaged checkpoint: the run begins anew
  } else {
    write_outcome(state.folder / "outcome.json", outcome_of(job, end));
    state = run_state(state.folder, study_, run);
    if (state.reason.starts_with("changed")) {  // also what is found next time
      state.status = "failed";
      state.message = "the scene file was changed while the study ran; start the study again";
    }
  }
  rows_[job.run] = row_of(study_, run, state, references_);
  return signals == 0 && state.status == "done" && state.cpu_times.size() < std::size_t(study_.repeats);
}

/// Its times, and nothing else of it. Returns whether it has any.
bool StudyWork::take_in_repetition(const Job& job) {
  RunState& state = states_[job.run];
  const std::optional<output::RunRecord> record = summary_of(repetition_folder(job.run));
  std::error_code ignored;
  fs::remove_all(repetition_folder(job.run), ignored);
  if (!record || record->status != "done") return false;
  state.cpu_times.push_back(record->cpu_time_s);
  state.wall_times.push_back(record->wall_time_s);
  fs::remove(state.folder / "repetition.txt", ignored);
  write_outcome(
      state.folder / "outcome.json",
      {.status = state.status, .message = state.message, .cpu_times_s = state.cpu_times, .wall_times_s = state.wall_times});
  return true;
}

/// How a run ended, by its process and by its own record.
StudyOutcome StudyWork::outcome_of(const Job& job, const ChildProcess::End& end) const {
  const fs::path& folder = states_[job.run].folder;
  StudyOutcome outcome{.status = "", .message = "", .cpu_times_s = {end.cpu_time_s}, .wall_times_s = {end.wall_time_s}};
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
    outcome.message = said(folder / "log.txt");
  }
  if (const std::optional<output::RunRecord> summary = summary_of(folder)) {
    outcome.cpu_times_s = {summary->cpu_time_s};
    outcome.wall_times_s = {summary->wall_time_s};
    if (outcome.status.empty()) outcome.status = summary->status;
    if (outcome.message.empty()) outcome.message = summary->message;
  }
  if (outcome.status.empty()) outcome.status = "interrupted";
  return outcome;
}

void StudyWork::show_bar(StudyProgress& progress, int jobs) const {
  if (!progress.bar_is_due()) return;
  std::vector<std::string> names;
  for (const auto& job : active_) names.push_back(study_.runs[job->run].name + " " + output::duration(job->child->wall_time()));
  progress.bar(names, seconds_left(jobs));
}

double StudyWork::seconds_left(int jobs) const {
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

}  // namespace undex::study
