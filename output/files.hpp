// Files that are either whole or absent, and failures that say what to do.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace undex::output {

/// Throws FileError "cannot <action> <path>: <reason>; <remedy>" for the given errno value.
[[noreturn]] void throw_file_error(const std::string& action, const std::filesystem::path& path, int error_number);

/// Throws FileError unless there is a file: not a folder, nor a pipe or a device, from which reading might wait for ever.
void require_file(const std::filesystem::path& path);

/// The whole of a file, or nothing where it is none or cannot be read.
std::optional<std::string> text_of(const std::filesystem::path& path);

/// Writes `text` beside `path`, then renames it there: a reader (or a kill) sees the old file or the new one, never a
/// part. Throws FileError.
void write_text_atomically(const std::filesystem::path& path, const std::string& text);

/// The first half of it, of bytes that lie in several places: they are on disk one after another under temporary_name(path),
/// which is returned, and `path` is as it was.
std::filesystem::path write_temporary(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

/// The second half: renames a finished temporary file to its place. Throws FileError.
void put_in_place(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// The name under which `path` is written until it is finished (same folder, so that the rename is atomic).
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Refuses (UsageError) a folder in which something but its lock is already, unless `force`, and a path that is something else.
void require_unused_folder(const std::filesystem::path& folder, bool force);

/// Makes the folder and those above it. Throws FileError, UsageError where the path is something else.
void make_folder(const std::filesystem::path& folder);

/// Throws FileError unless the file system that holds `path` has room for `bytes` more: a disk that fills in the middle
/// of an HDF5 write would leave a damaged file behind.
void require_space(const std::filesystem::path& path, double bytes);

}  // namespace undex::output
