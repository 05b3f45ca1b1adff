// Histories as CSV: one header row with names and units ("time [s],pressure [Pa]"), one row per sample.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace undex::output {

struct Samples;

/// One column: "pressure" in "Pa". An empty unit means a pure number, written "[-]".
struct Column {
  std::string name, unit;
};

/// A CSV file that grows by whole rows. Rows wait in memory until flush(), which hands all of them to the system in one write: a
/// killed program leaves whole rows, as many as were flushed. Every failed write throws FileError (path, reason, remedy), and the
/// file ends with the last row that is whole.
class History {
 public:
  /// Creates (or empties) the file and writes the header.
  History(std::filesystem::path path, std::vector<Column> columns);
  /// A file with these rows, whatever stood there before, to go on from: made aside, so that nothing is lost on the way.
  static History continued(std::filesystem::path path, const Samples& so_far);
  History(History&& other) noexcept;
  History& operator=(History&&) = delete;
  /// Flushes and closes; a failure here is silent, so call close() where it matters.
  ~History();

  /// One value per column, in order, nine significant digits. Throws std::invalid_argument on a wrong count.
  void append(std::span<const double> row);
  void append(std::initializer_list<double> row) { append(std::span<const double>(row.begin(), row.size())); }
  void flush();
  void close();

  const std::filesystem::path& path() const { return path_; }
  std::size_t rows() const { return rows_; }

 private:
  History() = default;
  void open_file(int how);
  void add_header(const std::vector<Column>& columns);
  void add(std::span<const double> row);
  [[noreturn]] void fail(int error);

  std::filesystem::path path_;
  std::size_t columns_ = 0, rows_ = 0;
  std::string waiting_;  ///< whole rows that are not in the file yet
  int file_ = -1;
};

}  // namespace undex::output
