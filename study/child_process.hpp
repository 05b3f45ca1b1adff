// This program once more, as a child: what happens to it does not happen to us, and its time and memory are its own.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace undex::study {

class ChildProcess {
 public:
  struct End {
    int exit_code = 0;  ///< -1 where a signal ended it
    int signal = 0;
    double cpu_time_s = 0;  ///< of all its threads
    double wall_time_s = 0;
  };

  /// Starts this very program (also when its file has been replaced since) with the arguments; what it prints goes to the end
  /// of the log. It has a process group of its own, so that a Ctrl-C is ours to pass on, and is terminated when we die.
  /// Throws FileError.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log);

  /// Whether it has ended, and how. Does not wait.
  std::optional<End> ended();
  void send(int signal) const;
  double cpu_time() const;   ///< [s] so far
  double wall_time() const;  ///< [s] since its start

 private:
  pid_t process_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace undex::study
