#include "output/files.hpp"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/errors.hpp"
#include "output/folder_lock.hpp"

namespace undex::output {

namespace {

const char* remedy(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT: return "free some space or choose another output folder with -o";
    case EACCES:
    case EPERM:
    case EROFS: return "choose an output folder that you may write to with -o";
    case ENOENT:
    case ENOTDIR: return "the output folder does not exist: make it, or choose another with -o";
    case EISDIR: return "a folder has the name of this file: remove it or choose another output folder with -o";
    case EMFILE:
    case ENFILE: return "too many files are open: raise the limit (ulimit -n)";
    default: return "choose another output folder with -o";
  }
}

}  // namespace

void throw_file_error(const std::string& action, const std::filesystem::path& path, int error_number) {
  throw FileError("cannot " + action + " " + path.string() + ": " +
                  (error_number != 0 ? std::strerror(error_number) : "unknown reason") + "; " + remedy(error_number));
}

void require_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (status.type() == std::filesystem::file_type::not_found)
    throw FileError("cannot read " + path.string() + ": No such file or directory; check the file's path");
  if (status.type() != std::filesystem::file_type::regular)
    throw FileError("cannot read " + path.string() + ": it is a folder, a pipe or a device; name a file");
}

std::optional<std::string> text_of(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  return file ? std::optional(text.str()) : std::nullopt;
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  std::string name(1, '.');
  name.append(path.filename().string()).append(1, '.').append(std::to_string(getpid())).append(".part");
  return path.parent_path() / name;
}

void put_in_place(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  if (std::rename(temporary.c_str(), path.c_str()) != 0) {
    const int error = errno;
    unlink(temporary.c_str());
    throw_file_error("write", path, error);
  }
  // The folder, too, must know of it before the power fails; where that cannot be asked for, it comes later by itself.
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); descriptor >= 0) {
    fsync(descriptor);
    close(descriptor);
  }
}

std::filesystem::path write_temporary(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  const std::filesystem::path temporary = temporary_name(path);
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) throw_file_error("write", path, errno);
  int error = 0;
  for (std::string_view text : parts)
    while (!text.empty() && error == 0) {
      const ssize_t written = write(file, text.data(), text.size());
      if (written >= 0) text.remove_prefix(static_cast<std::size_t>(written));
      else if (errno != EINTR) error = errno;
    }
  if (error == 0 && fsync(file) != 0 && errno != EINVAL && errno != ENOSYS) error = errno;
  if (close(file) != 0 && error == 0) error = errno;
  if (error != 0) {
    unlink(temporary.c_str());
    throw_file_error("write", path, error);
  }
  return temporary;
}

void write_text_atomically(const std::filesystem::path& path, const std::string& text) {
  put_in_place(write_temporary(path, {text}), path);
}

namespace {

void require_folder_if_any(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error))
    throw UsageError(folder.string() + " exists and is not a folder; name another one with -o");
}

}  // namespace

void require_unused_folder(const std::filesystem::path& folder, bool force) {
  require_folder_if_any(folder);
  if (force) return;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().filename() != folder_lock_name)
      throw UsageError("the output folder " + folder.string() +
                       " is not empty; name another one with -o, or write over it with --force");
}

void make_folder(const std::filesystem::path& folder) {
  require_folder_if_any(folder);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": cannot be made: " + error.message() + "; name another folder with -o");
}

void require_space(const std::filesystem::path& path, double bytes) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  struct statvfs state {};
  if (statvfs(folder.c_str(), &state) != 0) return;  // the write itself will say why
  const double available = static_cast<double>(state.f_bavail) * static_cast<double>(state.f_frsize);
  if (available < bytes) throw_file_error("write", path, ENOSPC);
}

}  // namespace undex::output
