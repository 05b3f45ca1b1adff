#include "output/run_folder.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <fstream>
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

/// Everything that a run ever writes, or is made from what it wrote: names as in a shell, those of a folder in the folder's line.
/// What a run without them must not be taken for comes first.
const struct {
  const char* folder;
  std::vector<const char*> names;
} files_of_runs[] = {
    {"",
     {"summary.json", "evidence.h5", "checkpoint*.h5", "start.h5", "outcome.json", "energy.csv", "bodies.csv", "forces.csv",
      "profile.csv", "profile_exact.csv", "comparison.csv", "curves.csv", "report.html", "scene.toml", "resolved.toml",
      ".*.part"}},
    {"history", {"*.csv"}},
    {"lines", {"*.csv"}},
    {"fields",
     {"particles.h5part", "solids.h5part", "solids[0-9]*.h5part", "structure_[0-9]*.hdf", "structure_*_[0-9]*.hdf",
      "structure.hdf.series", "structure_*.hdf.series", "obstacles_[0-9]*.hdf", "obstacles.hdf.series", ".*.part"}},
    {"pictures",
     {"histories.png", "references.png", "profile.png", "energy.png", "bodies.png", "lines.png", "fields.png", "mid_plane.png",
      "solids_*.png", "motion.png", "pressure.png", "other.png", "cost.png"}},
};

/// A table of somebody else's among the histories is not the run's: its first column is not the time, or has another name.
bool is_foreign_history(const fs::path& path) {
  if (const fs::path folder = path.parent_path().filename(); folder != "history" && folder != "lines") return false;
  std::ifstream file(path);
  std::string header;
  return std::getline(file, header) && !header.starts_with("time [s]");
}

[[noreturn]] void refuse(const fs::path& path, const char* what) {
  throw UsageError(path.string() + " is no " + what +
                   ", and a run needs one of that name: move it away, or name another folder with -o");
}

[[noreturn]] void throw_not_cleared(const fs::path& path, const std::error_code& error) {
  throw FileError(path.string() + ": of an older run, cannot be removed: " + error.message() + "; name another folder with -o");
}

/// What of the list is there, in the list's order. A link counts as itself: nothing is looked for behind it.
std::vector<fs::path> results_in(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& [place, names] : files_of_runs) {
    const fs::path where = folder / place;
    const fs::file_type type = *place ? fs::symlink_status(where).type() : fs::file_type::directory;
    if (type == fs::file_type::not_found) continue;
    if (type == fs::file_type::symlink) {
      found.push_back(where);
      continue;
    }
    if (type != fs::file_type::directory) refuse(where, "folder");
    std::error_code error;
    std::vector<fs::directory_entry> entries;
    for (const auto& entry : fs::directory_iterator(where, error)) entries.push_back(entry);
    if (error) throw_not_cleared(where, error);
    for (const char* name : names)
      for (const fs::directory_entry& entry : entries) {
        if (fnmatch(name, entry.path().filename().c_str(), FNM_PERIOD) != 0) continue;
        const bool link = entry.is_symlink();
        if (!link && !entry.is_regular_file()) refuse(entry.path(), "file");
        if (link || !is_foreign_history(entry.path())) found.push_back(entry.path());
      }
  }
  return found;
}

void remove_results(const std::vector<fs::path>& results, const fs::path& folder) {
  std::error_code error;
  for (const fs::path& path : results)
    if (fs::remove(path, error); error) throw_not_cleared(path, error);
  for (const auto& [place, names] : files_of_runs)
    if (*place) fs::remove(folder / place, error);  // where nothing is left in it
}

std::vector<HistoryColumn> finite_history(const fs::path& path) {
  std::vector<HistoryColumn> columns = read_history(path, /*may_be_cut=*/true);
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

void begin_run_folder(const fs::path& folder, const std::string& given, const std::string& resolved) {
  const std::vector<fs::path> older = results_in(folder);
  const fs::path scene = folder / "scene.toml", read = folder / "resolved.toml";
  std::vector<fs::path> temporary;
  try {
    temporary.push_back(write_temporary(scene, {given}));
    temporary.push_back(write_temporary(read, {resolved}));
    remove_results(older, folder);
  } catch (...) {
    std::error_code ignored;
    for (const fs::path& path : temporary) fs::remove(path, ignored);
    throw;
  }
  put_in_place(temporary[0], scene);
  put_in_place(temporary[1], read);
}

void continue_run_folder(const fs::path& folder, const std::string& resolved) {
  std::error_code error;
  for (const fs::path& path : results_in(folder))  // what a kill left half written
    if (path.extension() == ".part" && !fs::remove(path, error) && error) throw_not_cleared(path, error);
  if (text_of(folder / "resolved.toml") != resolved) write_text_atomically(folder / "resolved.toml", resolved);
  for (const char* name : {"summary.json", "evidence.h5"})
    if (fs::remove(folder / name, error); error) throw_not_cleared(folder / name, error);
}

bool is_unfinished_run(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder / "resolved.toml", ignored)) return false;
  if (!fs::exists(folder / "summary.json", ignored)) return true;
  try {
    const std::string status = read_summary(folder / "summary.json").status;
    return status != "done" && status != "stopped";
  } catch (const FileError&) {
    return false;
  }
}

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
