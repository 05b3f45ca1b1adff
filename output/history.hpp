// Histories as CSV: one header row with names and units ("time [s],pressure [Pa]"), one row per sample.
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace undex::output {

/// One column: "pressure" in "Pa". An empty unit means a pure number, written "[-]".
struct Column {
  std::string name, unit;
};

/// A CSV file that grows row by row. Rows reach the disk about once a second, on flush() and at the end, so a killed run
/// keeps what it had. Every failed write throws FileError (path, reason, remedy).
class History {
 public:
  /// Creates (or empties) the file and writes the header.
  History(std::filesystem::path path, std::vector<Column> columns);
  History(History&&) noexcept = default;
  History& operator=(History&&) noexcept = default;
  /// Closes; a failure here is silent, so call close() where it matters.
  ~History() = default;

  /// One value per column, in order, nine significant digits. Throws std::invalid_argument on a wrong count.
  void append(std::span<const double> row);
  void append(std::initializer_list<double> row) { append(std::span<const double>(row.begin(), row.size())); }
  void flush();
  void close();

  const std::filesystem::path& path() const { return path_; }
  std::size_t rows() const { return rows_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void check(bool good);

  std::filesystem::path path_;
  std::size_t columns_ = 0, rows_ = 0;
  std::unique_ptr<std::FILE, Close> file_;
  std::chrono::steady_clock::time_point last_flush_;
};

}  // namespace undex::output
