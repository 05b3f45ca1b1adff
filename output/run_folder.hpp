// What a finished run left in its folder, read back to be compared with others.
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

/// Throws FileError unless the folder is that of a run that has ended.
void require_finished_run(const std::filesystem::path& path);

/// Reads summary.json, resolved.toml, energy.csv and history/*.csv. Histories end before their first value that is not
/// finite (a run that the numerics stopped may have them). Throws FileError where the folder is not a run's, the run is
/// not finished (no summary.json yet), or a file cannot be understood; all mistakes of the folder in one message, a line
/// each.
RunFolder read_run_folder(const std::filesystem::path& path);

}  // namespace undex::output
