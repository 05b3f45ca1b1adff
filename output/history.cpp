#include "output/history.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/samples.hpp"

namespace undex::output {

History::History(std::filesystem::path path, std::vector<Column> columns) : path_(std::move(path)), columns_(columns.size()) {
  add_header(columns);
  open_file(O_CREAT | O_TRUNC);
  flush();
}

History History::continued(std::filesystem::path path, const Samples& so_far) {
  History history;
  history.path_ = std::move(path);
  history.columns_ = so_far.columns.size();
  history.add_header(so_far.columns);
  std::vector<double> row(history.columns_);
  for (std::size_t r = 0; r < so_far.rows(); ++r) {
    for (std::size_t c = 0; c < row.size(); ++c) row[c] = so_far.values[c][r];
    history.add(row);
  }
  put_in_place(write_temporary(history.path_, {history.waiting_}), history.path_);
  history.waiting_.clear();
  history.open_file(O_APPEND);
  return history;
}

void History::add_header(const std::vector<Column>& columns) {
  if (columns.empty()) throw std::invalid_argument("History: no columns for " + path_.string());
  for (const Column& column : columns) {
    if (column.name.empty() || (column.name + column.unit).find_first_of(",\"\n") != std::string::npos)
      throw std::invalid_argument("History: bad column name '" + column.name + "' [" + column.unit + "]");
    waiting_ += (waiting_.empty() ? "" : ",") + column.name + " [" + (column.unit.empty() ? "-" : column.unit) + "]";
  }
  waiting_ += '\n';
}

void History::open_file(int how) {
  // Of a pipe in its place nobody may read: that is an error, not a reason to wait.
  file_ = open(path_.c_str(), how | O_WRONLY | O_CLOEXEC | O_NONBLOCK, 0666);
  if (file_ < 0) throw_file_error("write", path_, errno);
}

History::History(History&& other) noexcept
    : path_(std::move(other.path_)),
      columns_(other.columns_),
      rows_(other.rows_),
      waiting_(std::exchange(other.waiting_, {})),
      file_(std::exchange(other.file_, -1)) {}

History::~History() {
  try {
    close();
  } catch (const FileError&) {
  }
}

void History::append(std::span<const double> row) {
  if (row.size() != columns_)
    throw std::invalid_argument("History " + path_.string() + ": " + std::to_string(row.size()) + " values for " +
                                std::to_string(columns_) + " columns");
  if (file_ < 0) throw std::logic_error("History " + path_.string() + ": written after it was closed");
  add(row);
}

void History::add(std::span<const double> row) {
  constexpr std::size_t widest = 40;
  waiting_.reserve(waiting_.size() + widest * row.size());  // where memory is short it ends before the row, not within it
  for (std::size_t i = 0; i < row.size(); ++i) {
    char value[widest];
    waiting_.append(value, static_cast<std::size_t>(std::snprintf(value, sizeof value, "%.9g", row[i])));
    waiting_ += i + 1 < row.size() ? ',' : '\n';
  }
  ++rows_;
}

void History::flush() {
  if (file_ < 0) return;
  for (std::size_t done = 0; done < waiting_.size();) {
    const ssize_t written = write(file_, waiting_.data() + done, waiting_.size() - done);
    if (written >= 0) {
      done += static_cast<std::size_t>(written);
    } else if (const int error = errno; error != EINTR) {  // a row that has begun goes
      const std::size_t row = done == 0 ? 0 : waiting_.rfind('\n', done - 1) + 1;
      const off_t end = lseek(file_, 0, SEEK_CUR);
      [[maybe_unused]] const int cut = end < 0 ? -1 : ftruncate(file_, end - static_cast<off_t>(done - row));
      fail(error);
    }
  }
  waiting_.clear();
}

void History::close() {
  if (file_ < 0) return;
  flush();
  if (::close(std::exchange(file_, -1)) != 0) throw_file_error("write", path_, errno);
}

void History::fail(int error) {
  waiting_.clear();
  ::close(std::exchange(file_, -1));
  throw_file_error("write", path_, error);
}

}  // namespace undex::output
