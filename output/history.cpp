#include "output/history.hpp"

#include <cerrno>
#include <stdexcept>

#include "output/files.hpp"

namespace undex::output {

History::History(std::filesystem::path path, std::vector<Column> columns)
    : path_(std::move(path)), columns_(columns.size()), last_flush_(std::chrono::steady_clock::now()) {
  if (columns.empty()) throw std::invalid_argument("History: no columns for " + path_.string());
  std::string header;
  for (const Column& column : columns) {
    if (column.name.empty() || (column.name + column.unit).find_first_of(",\"\n") != std::string::npos)
      throw std::invalid_argument("History: bad column name '" + column.name + "' [" + column.unit + "]");
    header += (header.empty() ? "" : ",") + column.name + " [" + (column.unit.empty() ? "-" : column.unit) + "]";
  }
  errno = 0;
  file_.reset(std::fopen(path_.c_str(), "we"));
  check(file_ != nullptr);
  check(std::fprintf(file_.get(), "%s\n", header.c_str()) > 0);
  flush();
}

void History::check(bool good) {
  if (good) return;
  const int error = errno;
  file_.reset();
  throw_file_error("write", path_, error);
}

void History::append(std::span<const double> row) {
  if (row.size() != columns_)
    throw std::invalid_argument("History " + path_.string() + ": " + std::to_string(row.size()) + " values for " +
                                std::to_string(columns_) + " columns");
  if (!file_) throw std::logic_error("History " + path_.string() + ": written after it was closed");
  errno = 0;
  for (std::size_t i = 0; i < row.size(); ++i)
    check(std::fprintf(file_.get(), i + 1 < row.size() ? "%.9g," : "%.9g\n", row[i]) > 0);
  ++rows_;
  // Looking at the clock costs more than a row: every sixteenth row is often enough.
  if (rows_ % 16 == 0 && std::chrono::steady_clock::now() - last_flush_ > std::chrono::seconds(1)) flush();
}

void History::flush() {
  if (!file_) return;
  errno = 0;
  check(std::fflush(file_.get()) == 0);
  last_flush_ = std::chrono::steady_clock::now();
}

void History::close() {
  if (!file_) return;
  flush();
  errno = 0;
  const bool good = std::fclose(file_.release()) == 0;
  if (!good) throw_file_error("write", path_, errno);
}

}  // namespace undex::output
