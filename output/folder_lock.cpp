#include "output/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "core/errors.hpp"
#include "output/files.hpp"

namespace undex::output {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> missing_folders(fs::path folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (; !folder.empty() && !fs::exists(folder, error); folder = folder.parent_path()) missing.push_back(folder);
  return missing;
}

/// "undex run, process 1234 on node17".
std::string holder_text(const std::string& who) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  return who + ", process " + std::to_string(getpid()) + (*host ? std::string(" on ") + host : "");
}

std::string holder_in(int file) {
  char text[400];
  const ssize_t length = pread(file, text, sizeof text, 0);
  return length > 0 ? std::string(text, static_cast<std::size_t>(length)) : "another undex";
}

/// Is the open file still the one of that name? Whoever held it before has taken its name away.
bool is_named(int file, const fs::path& path) {
  struct stat open_one {
  }, named{};
  return fstat(file, &open_one) == 0 && lstat(path.c_str(), &named) == 0 && open_one.st_dev == named.st_dev &&
         open_one.st_ino == named.st_ino;
}

/// Makes the folder, opens the file and locks it. A file system without locks does without.
int locked_file(const fs::path& folder, const fs::path& path, Holding holding) {
  for (;;) {
    make_folder(folder);
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (file < 0 && errno == ENOENT) continue;  // somebody who had made the folder has just left it
    if (file < 0) throw_file_error("write", path, errno);
    if (flock(file, (holding == Holding::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) {
        std::fprintf(stderr, "warning: %s is on a file system without locks: see to it that no other undex writes there\n",
                     folder.c_str());
        return file;
      }
      const std::string holder = holder_in(file);
      close(file);
      throw UsageError(folder.string() + " is in use by " + holder + ": wait for it, end it, or name another folder with -o");
    }
    if (is_named(file, path)) return file;
    close(file);
  }
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::string& who, Holding holding)
    : path_(folder / folder_lock_name), made_(missing_folders(folder)) {
  file_ = locked_file(folder, path_, holding);
  const std::string holder = holder_text(who);
  // On a full disk the file stays empty: it binds all the same.
  if (ftruncate(file_, 0) != 0 || pwrite(file_, holder.data(), holder.size(), 0) < 0) return;
}

FolderLock::~FolderLock() {
  const bool last = flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  if (last && is_named(file_, path_)) unlink(path_.c_str());
  close(file_);
  for (const fs::path& folder : made_) rmdir(folder.c_str());
}

}  // namespace undex::output
