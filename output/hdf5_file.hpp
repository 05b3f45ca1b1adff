// The little of HDF5 that fields and evidence need, with handles that close themselves and errors that throw.
// Private to this folder: the HDF5 headers do not leave it.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/state.hpp"

namespace undex::output::hdf5 {

/// Owns one HDF5 identifier of any kind.
class Handle {
 public:
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
};

/// An open file. Reports failures as FileError with the path, HDF5's own innermost reason and a remedy.
class File {
 public:
  static File create(const std::filesystem::path& path);            ///< empties an existing file; with room for many snapshots
  static File create_in_memory(const std::filesystem::path& name);  ///< never on disk; `name` is what messages call it
  static File open(const std::filesystem::path& path);              ///< to read and write
  static File open_to_read(const std::filesystem::path& path);
  /// Throws if `result` (of any HDF5 call on this file) tells of a failure; returns it otherwise.
  template <class Result>
  Result check(Result result, const char* action) const {
    if (result < 0) fail(action);
    return result;
  }
  Handle group(hid_t parent, const char* name) const;
  /// A group that knows in which order its members were made.
  Handle ordered_group(hid_t parent, const std::string& name) const;
  /// A group without a name yet: a killed run leaves nothing visible of it. link() publishes it.
  Handle unnamed_group() const;
  void link(hid_t object, const std::string& name) const;
  bool has(const std::string& name) const;
  void unlink(const std::string& name) const;

  void attribute(hid_t object, const char* name, double value) const;
  void attribute(hid_t object, const char* name, std::span<const std::int64_t> values) const;
  void attribute(hid_t object, const char* name, const std::string& ascii) const;  ///< fixed length, as VTK wants it

  /// Datasets of `values.size()/columns` rows; float32 with shuffle and gzip. columns = 1 gives a one-dimensional set.
  void dataset(hid_t parent, const std::string& name, std::span<const float> values, std::size_t columns = 1) const;
  void dataset(hid_t parent, const std::string& name, std::span<const double> values, std::size_t columns = 1) const;
  void dataset(hid_t parent, const std::string& name, std::span<const std::int64_t> values) const;
  void dataset(hid_t parent, const std::string& name, std::span<const unsigned char> values) const;

  // Of a file that is read; a failure says that the file is damaged.
  Handle open_group(hid_t parent, const std::string& name) const;
  Handle open_dataset(hid_t parent, const std::string& name) const;
  /// Is there a group of that name?
  bool has(hid_t where, const std::string& name) const;
  /// Names of the members of an ordered group, as they were made.
  std::vector<std::string> members(hid_t group) const;
  double number(hid_t object, const char* attribute) const;
  std::string text(hid_t object, const char* attribute) const;
  struct Values {
    std::vector<double> values;  ///< row by row
    std::size_t columns = 1;
  };
  Values read(hid_t dataset) const;

  /// An array of any kind, not compressed, under a path of groups that are made where they do not exist; and read back, where
  /// `resize` is asked for the memory of as many items as there are. Throws where the file holds another kind.
  void array(const std::string& path, const ItemType& type, const void* data, std::size_t count) const;
  void read_array(const std::string& path, const ItemType& type, const std::function<void*(std::size_t)>& resize) const;
  /// The bytes of a file in memory; valid until the file changes.
  std::string_view image() const;

  /// Puts everything on disk. The file closes itself at the end of its scope.
  void flush() const;
  operator hid_t() const { return file_; }

 private:
  File(std::filesystem::path path, Handle file, bool reads = false)
      : path_(std::move(path)), file_(std::move(file)), reads_(reads) {}
  [[noreturn]] void fail(const char* action) const;
  void write(hid_t parent, const std::string& name, hid_t type, const void* data, std::size_t rows, std::size_t columns,
             std::size_t value_bytes) const;

  std::filesystem::path path_;
  Handle file_;
  bool reads_;
};

/// Every `stride`-th value from `first` on, as float32. Values beyond float32's range become its largest.
std::vector<float> to_float(std::span<const double> values, std::size_t first = 0, std::size_t stride = 1);

}  // namespace undex::output::hdf5
