// undex study: a grid of runs, computed where they are not there yet, and one table of all of them (docs/reference/studies.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace undex::study {

struct StudyOptions {
  std::filesystem::path study;    ///< study file, or a folder with study.toml
  std::filesystem::path output;   ///< empty: the study's own choice
  std::vector<std::string> only;  ///< parts of names, or patterns with * and ?; empty: all runs
  int jobs = 1;                   ///< runs at a time
  bool list = false;              ///< say what would be done, and do nothing
  bool again = false;             ///< also what is there
  bool quiet = false;
  std::string program;  ///< version text of this program: runs of another are named
};

/// Each run is a process of this very program, `undex run`. Returns the exit code: 0, 1 where a run failed, 130 or 143 after a
/// signal. Throws SceneError, UsageError, FileError.
int run_study(const StudyOptions& options);

}  // namespace undex::study
