// undex study: a grid of runs, computed where they are not there yet, and one table of all of them (docs/reference/studies.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace undex::study {

/// One of `count` shares of a study's runs, counted from 1: every count-th of them from the coarsest on.
struct Shard {
  int index = 1, count = 1;
};
/// "2/8". Throws UsageError.
Shard shard_of(const std::string& text);

struct StudyOptions {
  std::filesystem::path study;    ///< study file, or a folder with study.toml
  std::filesystem::path output;   ///< empty: the study's own choice
  std::vector<std::string> only;  ///< parts of names, or patterns with * and ?; empty: all runs
  int jobs = 1;                   ///< runs at a time
  bool list = false;              ///< say what would be done, and do nothing
  bool again = false;             ///< also what is there
  bool table = false;             ///< the tables of what is there, and no run
  std::optional<Shard> shard;     ///< only this share of the runs; others compute theirs in the same folder
  std::optional<int> slurm;       ///< write a job array of so many shards, and do nothing else; 0: one a run that is not there
  bool quiet = false;
  std::string program;  ///< version text of this program: runs of another are named
};

/// Each run is a process of this very program, `undex run`. Returns the exit code: 0, 1 where a run failed, 130 or 143 after a
/// signal. Throws SceneError, UsageError, FileError.
int run_study(const StudyOptions& options);

}  // namespace undex::study
