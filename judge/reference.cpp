#include "judge/reference.hpp"

#include <fstream>
#include <stdexcept>

#include "core/errors.hpp"

namespace undex::judge {

std::vector<output::HistoryColumn> read_reference_history(const std::filesystem::path& path) {
  std::vector<output::HistoryColumn> history = output::read_history(path);
  if (history.front().series.t.size() < 2)
    throw FileError(path.string() + ": fewer than two samples, so no history; mend the file");
  for (const output::HistoryColumn& column : history) try {
      output::require_valid(column.series);
    } catch (const std::invalid_argument& error) {
      throw FileError(path.string() + ": column '" + column.name + "': " + error.what() + "; mend the file");
    }
  return history;
}

Reference read_reference(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream file;
  if (std::filesystem::is_regular_file(path, ignored)) file.open(path);  // of a pipe there is no second reading
  std::string header;
  while (file.is_open() && std::getline(file, header) && (header.empty() || header[0] == '#')) {
  }
  if (!file.is_open() || !file)
    throw FileError(path.string() + ": cannot be read as a reference; give a CSV file, such as those in cases/*/reference");
  if (header.starts_with("metric,")) return {.table = read_reference_table(path), .history = {}};
  if (header.starts_with("time")) return {.table = {}, .history = read_reference_history(path)};
  throw FileError(path.string() +
                  ": neither a table of metrics (header metric,label,unit,scale,<source>,...) nor a history "
                  "(header time [s],pressure [Pa],...); its first line is '" +
                  header + "'");
}

}  // namespace undex::judge
