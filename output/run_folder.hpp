// The folder of a run: begun anew, and what a finished run left in it, read back to be compared with others.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "output/series.hpp"

namespace undex::output {

struct RunFolder {
  std::filesystem::path path;                                ///< as given
  RunRecord record;                                          ///< summary.json
  std::string settings;                                      ///< text of resolved.toml
  std::vector<HistoryColumn> energies;                       ///< energy.csv
  std::map<std::string, std::vector<HistoryColumn>> probes;  ///< history/<probe>.csv by the probe's name
};

/// Makes the folder, which the caller has locked, that of a new run: the scene as it was given and as it was read, and nothing of
/// an older run; files of others stay. Throws UsageError where something that is no file has the name of one of a run's, and
/// FileError where the new run's first files cannot be written; the older run is then still whole.
void begin_run_folder(const std::filesystem::path& folder, const std::string& given, const std::string& resolved);

/// The run of the folder, which the caller has locked, goes on: what says that it has ended goes, and what was left half written;
/// resolved.toml says what is computed now. Throws FileError.
void continue_run_folder(const std::filesystem::path& folder, const std::string& resolved);

/// Does the folder hold a run that has not come to its end: killed, interrupted, failed?
bool is_unfinished_run(const std::filesystem::path& folder);

/// Throws FileError unless the folder is that of a run that has ended.
void require_finished_run(const std::filesystem::path& path);

/// Reads summary.json, resolved.toml, energy.csv and history/*.csv. Histories end before their first value that is not
/// finite (a run that the numerics stopped may have them). Throws FileError where the folder is not a run's, the run is
/// not finished (no summary.json yet), or a file cannot be understood; all mistakes of the folder in one message, a line
/// each.
RunFolder read_run_folder(const std::filesystem::path& path);

}  // namespace undex::output
