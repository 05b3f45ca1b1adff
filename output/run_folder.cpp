#include "output/run_folder.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/errors.hpp"
#include "output/files.hpp"

namespace undex::output {

namespace {

namespace fs = std::filesystem;

std::string whole_text(const fs::path& path) {
  if (const auto text = text_of(path)) return *text;
  throw FileError(path.string() + ": cannot be read; run the scene again, or take it from the run's original folder");
}

std::vector<HistoryColumn> finite_history(const fs::path& path) {
  std::vector<HistoryColumn> columns = read_history(path);
  for (HistoryColumn& column : columns) {
    Series& s = column.series;
    const auto good = [](double value) { return std::isfinite(value); };
    const auto length = std::min(std::find_if_not(s.t.begin(), s.t.end(), good) - s.t.begin(),
                                 std::find_if_not(s.y.begin(), s.y.end(), good) - s.y.begin());
    s.t.resize(static_cast<std::size_t>(length));
    s.y.resize(static_cast<std::size_t>(length));
    if (!std::is_sorted(s.t.begin(), s.t.end()))
      throw FileError("cannot read " + path.string() + ": its times go back; the file is damaged, run the scene again");
  }
  return columns;
}

}  // namespace

void require_finished_run(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error))
    throw FileError(path.string() + ": no such folder; give the output folder of a run (undex run SCENE -o DIR)");
  const auto has = [&](const char* name) { return fs::is_regular_file(path / name, error); };
  if (has("summary.json")) return;
  if (has("resolved.toml") && has("energy.csv"))
    throw FileError(path.string() +
                    ": the run is not finished (no summary.json); wait for it, or run the scene again if it was killed");
  throw FileError(path.string() +
                  ": not the folder of a run (no summary.json, resolved.toml, energy.csv); give what undex run wrote to with -o");
}

RunFolder read_run_folder(const fs::path& path) {
  require_finished_run(path);
  RunFolder run;
  run.path = path;
  std::string mistakes;
  const auto attempt = [&](const auto& read) {
    try {
      read();
    } catch (const FileError& error) {
      mistakes += (mistakes.empty() ? "" : "\n") + std::string(error.what());
    }
  };
  attempt([&] { run.record = read_summary(path / "summary.json"); });
  attempt([&] { run.settings = whole_text(path / "resolved.toml"); });
  attempt([&] { run.energies = finite_history(path / "energy.csv"); });
  std::error_code error;
  std::set<fs::path> histories;
  for (const auto& entry : fs::directory_iterator(path / "history", error))
    if (entry.path().extension() == ".csv") histories.insert(entry.path());
  for (const fs::path& history : histories) attempt([&] { run.probes[history.stem().string()] = finite_history(history); });
  if (!mistakes.empty()) throw FileError(mistakes);
  return run;
}

}  // namespace undex::output
