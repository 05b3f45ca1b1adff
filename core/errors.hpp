// Two levels of failure: an assertion is a defect of this program; the exceptions here are what a user can mend,
// and each carries the exit code of the program.
#pragma once

#include <cassert>
#include <stdexcept>
#include <string>
#include <vector>

namespace undex {

enum ExitCode { exit_done = 0, exit_internal = 1, exit_usage = 2, exit_numerics = 3, exit_restart = 4 };

/// A place in a scene file; line 0 means "no particular place".
struct Where {
  int line = 0;
  int column = 0;
};

/// One mistake of a scene: where, what is wrong with which value, and the remedy.
struct Finding {
  Where where;
  std::string message;
};

/// The mistakes of a scene file, all of them at once. what() is one line each, "file:line:column: message".
class SceneError : public std::runtime_error {
 public:
  SceneError(std::string file, std::vector<Finding> findings);
  const std::string& file() const { return file_; }
  const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::string file_;
  std::vector<Finding> findings_;
};

/// A wrong command line, or a refused output folder.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be read or written; the message names the path, the reason and the remedy.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The numerics left their domain. The message names step, time, field, particle or cell, its position, and what set dt.
class NumericalStop : public std::runtime_error {
 public:
  /// `resumable`: the state that is left is whole, so that others may go on from it with new rates.
  explicit NumericalStop(const std::string& message, bool resumable = false)
      : std::runtime_error(message), resumable_(resumable) {}
  bool resumable() const { return resumable_; }

 private:
  bool resumable_;
};

/// A run cannot be gone on with from what is on disk; the message says what differs, and the remedy.
class RestartError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace undex
