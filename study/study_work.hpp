// The work of a study: its runs as processes, some at a time, with limits, repetitions and signals; the tables after each.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "scene/study.hpp"
#include "study/child_process.hpp"
#include "study/study_outcome.hpp"
#include "study/study_progress.hpp"
#include "study/study_rows.hpp"
#include "study/study_runs.hpp"
#include "study/study_table.hpp"

namespace undex::study {

class StudyWork {
 public:
  /// Looks which runs of the study are in its folder. The study and the references must outlive it.
  StudyWork(const scene::Study& study, const References& references, const std::filesystem::path& folder, bool quiet);

  const std::vector<RunState>& states() const { return states_; }
  StudyTable table() const;
  /// study.csv and, where there is something in it, order.csv. Throws FileError.
  void write_tables() const;
  /// Those of the runs that are in folders of other names get their own. Throws FileError.
  void rename_folders(const std::vector<std::size_t>& runs);
  /// Others compute other runs in the same folder: they write no table, and leave alone what one of them computes.
  void share_the_folder() { shared_ = true; }
  /// What is there of these runs does not count.
  void forget(const std::vector<std::size_t>& runs);
  /// Computes the runs, `jobs` at a time, coarse ones first. Returns when all have ended, or after a signal: that, else 0.
  int compute(std::vector<std::size_t> runs, int jobs);

 private:
  struct Job {
    std::size_t run;
    bool repetition;  ///< in a folder of its own, for the time only
    bool resumes;     ///< from its checkpoint
    std::unique_ptr<ChildProcess> child;
    double cpu_limit = 0, wall_limit = 0;    ///< the one that it passed
    double ended_at = 0;                     ///< wall time at which it was told to end
    double cpu_before = 0, wall_before = 0;  ///< of the same run until its checkpoint
  };

  std::filesystem::path repetition_folder(std::size_t run) const { return states_[run].folder / "repetition"; }
  void start_waiting(int jobs);
  void start(std::size_t run);
  void pass_on_signals(StudyProgress& progress);
  void enforce_limits(Job& job) const;
  void take_in_ended(StudyProgress& progress, int jobs);
  bool take_in(const Job& job, const ChildProcess::End& end);
  bool take_in_repetition(const Job& job);
  StudyOutcome outcome_of(const Job& job, const ChildProcess::End& end) const;
  void show_bar(StudyProgress& progress, int jobs) const;
  double seconds_left(int jobs) const;

  const scene::Study& study_;
  const References& references_;
  std::filesystem::path folder_;
  std::vector<RunState> states_;
  std::vector<StudyRow> rows_;
  bool quiet_, shared_ = false;
  int passed_on_ = 0;                 ///< signals that the runs have been sent
  std::vector<std::size_t> pending_;  ///< the next one last
  std::vector<std::unique_ptr<Job>> active_;
};

}  // namespace undex::study
