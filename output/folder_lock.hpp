// One process at a time writes into an output folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace undex::output {

/// The name of its file in the folder. A folder in which there is nothing else counts as empty.
inline constexpr const char* folder_lock_name = ".lock";

enum class Holding {
  alone,   ///< nobody else works in the folder
  shared,  ///< others that share it may, as the shards of a study do
};

/// Held as long as this process works in the folder. The kernel lets go of it when the process ends, however it ends, so that
/// what a killed one leaves behind binds nobody.
class FolderLock {
 public:
  /// Makes the folder where there is none. `who`, such as "undex run", is told to those who come later. Throws UsageError where
  /// another process holds the folder (this one included), FileError where it cannot be made or written to.
  FolderLock(const std::filesystem::path& folder, const std::string& who, Holding holding = Holding::alone);
  /// Takes its file away, unless others hold it too, and the folders that it has made and that nobody has put anything into.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< the deepest first
  int file_ = -1;
};

}  // namespace undex::output
