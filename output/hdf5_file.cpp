#include "output/hdf5_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/errors.hpp"
#include "output/files.hpp"

namespace undex::output::hdf5 {

namespace {

// HDF5 prints its error stack on stderr unless told otherwise; here the reason goes into the exception. Its clean-up at exit
// is not wanted either: every file is closed by then, and after a failed write (full disk) it crashes on what it cannot flush.
void silence() {
  static const herr_t no_clean_up = H5dont_atexit();
  static_cast<void>(no_clean_up);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

/// What is wrong with a file that is read, and the remedy.
[[noreturn]] void throw_damaged(const std::filesystem::path& path, const std::string& reason) {
  throw FileError("cannot read " + path.string() + ": " + reason +
                  "; the file is damaged or another program's: run the scene again, or take it from the run's original folder");
}

std::string innermost_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &reason);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

[[noreturn]] void throw_hdf5_error(const char* action, const std::filesystem::path& path) {
  const int error = errno;
  const std::string reason = innermost_reason();
  if (error != 0) throw_file_error(action, path, error);
  throw FileError(std::string("cannot ") + action + " " + path.string() + ": " + reason +
                  "; if the file is damaged or of another program, remove it, else choose another output folder with -o");
}

// A viewer that has the file open must not stop the run, so files are not locked.
Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_file_locking(access, false, true);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  return access;
}

/// The root group gets room for a thousand names at once: a heap that moved or a node that split while a program is killed
/// would leave a file that cannot be read.
Handle file_creation() {
  Handle creation(H5Pcreate(H5P_FILE_CREATE));
  H5Pset_local_heap_size_hint(creation, 32768);
  H5Pset_est_link_info(creation, 1000, 12);
  H5Pset_sym_k(creation, 16, 512);
  return creation;
}

}  // namespace

File File::create(const std::filesystem::path& path) {
  silence();
  errno = 0;
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, file_creation(), file_access()));
  if (file < 0) throw_hdf5_error("write", path);
  return File(path, std::move(file));
}

File File::open(const std::filesystem::path& path) {
  silence();
  errno = 0;
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, file_access()));
  if (file < 0) throw_hdf5_error("open", path);
  return File(path, std::move(file));
}

File File::create_in_memory(const std::filesystem::path& name) {
  silence();
  errno = 0;
  const Handle access = file_access();
  constexpr std::size_t growth = 1u << 24;  // bytes at a time
  H5Pset_fapl_core(access, growth, false);
  Handle file(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
  if (file < 0) throw_hdf5_error("write", name);
  return File(name, std::move(file));
}

File File::open_to_read(const std::filesystem::path& path) {
  silence();
  errno = 0;
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, file_access()));
  if (file < 0) throw_damaged(path, errno != 0 ? std::strerror(errno) : innermost_reason());
  return {path, std::move(file), true};
}

void File::fail(const char* action) const {
  if (reads_) throw_damaged(path_, innermost_reason());
  throw_hdf5_error(action, path_);
}

Handle File::group(hid_t parent, const char* name) const {
  errno = 0;
  return Handle(check(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "write"));
}

Handle File::ordered_group(hid_t parent, const std::string& name) const {
  errno = 0;
  Handle creation(H5Pcreate(H5P_GROUP_CREATE));
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return Handle(check(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), "write"));
}

Handle File::unnamed_group() const {
  errno = 0;
  return Handle(check(H5Gcreate_anon(file_, H5P_DEFAULT, H5P_DEFAULT), "write"));
}

void File::link(hid_t object, const std::string& name) const {
  errno = 0;
  check(H5Olink(object, file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), "write");
}

bool File::has(const std::string& name) const { return check(H5Lexists(file_, name.c_str(), H5P_DEFAULT), "read") > 0; }

void File::unlink(const std::string& name) const {
  errno = 0;
  check(H5Ldelete(file_, name.c_str(), H5P_DEFAULT), "write");
}

void File::attribute(hid_t object, const char* name, double value) const {
  errno = 0;
  Handle space(H5Screate(H5S_SCALAR));
  Handle attribute(check(H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), "write"));
  check(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), "write");
}

void File::attribute(hid_t object, const char* name, std::span<const std::int64_t> values) const {
  errno = 0;
  const hsize_t size = values.size();
  Handle space(H5Screate_simple(1, &size, nullptr));
  Handle attribute(check(H5Acreate2(object, name, H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT), "write"));
  check(H5Awrite(attribute, H5T_NATIVE_INT64, values.data()), "write");
}

void File::attribute(hid_t object, const char* name, const std::string& ascii) const {
  errno = 0;
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, ascii.size());
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  Handle space(H5Screate(H5S_SCALAR));
  Handle attribute(check(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), "write"));
  check(H5Awrite(attribute, type, ascii.data()), "write");
}

void File::write(hid_t parent, const std::string& name, hid_t type, const void* data, std::size_t rows, std::size_t columns,
                 std::size_t value_bytes) const {
  errno = 0;
  const hsize_t size[2] = {rows, columns};
  const int rank = columns == 1 ? 1 : 2;
  Handle space(H5Screate_simple(rank, size, nullptr));
  Handle layout(H5Pcreate(H5P_DATASET_CREATE));
  if (rows * columns * value_bytes > 4096) {  // small sets are smaller without chunks
    const hsize_t chunk[2] = {std::min<hsize_t>(rows, (1u << 18) / (columns * value_bytes)), columns};
    H5Pset_chunk(layout, rank, chunk);
    H5Pset_shuffle(layout);
    H5Pset_deflate(layout, 3);
  }
  Handle set(check(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT), "write"));
  if (rows > 0) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write");
}

void File::dataset(hid_t parent, const std::string& name, std::span<const float> values, std::size_t columns) const {
  write(parent, name, H5T_NATIVE_FLOAT, values.data(), values.size() / columns, columns, sizeof(float));
}

void File::dataset(hid_t parent, const std::string& name, std::span<const double> values, std::size_t columns) const {
  write(parent, name, H5T_NATIVE_DOUBLE, values.data(), values.size() / columns, columns, sizeof(double));
}

void File::dataset(hid_t parent, const std::string& name, std::span<const std::int64_t> values) const {
  write(parent, name, H5T_NATIVE_INT64, values.data(), values.size(), 1, sizeof(std::int64_t));
}

void File::dataset(hid_t parent, const std::string& name, std::span<const unsigned char> values) const {
  write(parent, name, H5T_NATIVE_UCHAR, values.data(), values.size(), 1, 1);
}

Handle File::open_group(hid_t parent, const std::string& name) const {
  return Handle(check(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), "read"));
}

Handle File::open_dataset(hid_t parent, const std::string& name) const {
  return Handle(check(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), "read"));
}

bool File::has(hid_t where, const std::string& name) const { return H5Lexists(where, name.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::string> File::members(hid_t group) const {
  H5G_info_t info{};
  check(H5Gget_info(group, &info), "read");
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto name = [&](char* into, std::size_t room) {
      return check(H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, into, room, H5P_DEFAULT), "read");
    };
    std::string text(static_cast<std::size_t>(name(nullptr, 0)), '\0');
    name(text.data(), text.size() + 1);
    names.push_back(std::move(text));
  }
  return names;
}

double File::number(hid_t object, const char* attribute) const {
  Handle found(check(H5Aopen(object, attribute, H5P_DEFAULT), "read"));
  Handle space(check(H5Aget_space(found), "read"));
  if (H5Sget_simple_extent_npoints(space) != 1) throw_damaged(path_, std::string("attribute ") + attribute + " is no number");
  double value = 0;
  check(H5Aread(found, H5T_NATIVE_DOUBLE, &value), "read");
  return value;
}

std::string File::text(hid_t object, const char* attribute) const {
  Handle found(check(H5Aopen(object, attribute, H5P_DEFAULT), "read"));
  Handle type(check(H5Aget_type(found), "read")), space(check(H5Aget_space(found), "read"));
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || H5Sget_simple_extent_npoints(space) != 1)
    throw_damaged(path_, std::string("attribute ") + attribute + " is no text");
  std::string value(H5Tget_size(type), '\0');
  check(H5Aread(found, type, value.data()), "read");
  return value.substr(0, value.find('\0'));
}

File::Values File::read(hid_t dataset) const {
  Handle space(check(H5Dget_space(dataset), "read"));
  const int rank = H5Sget_simple_extent_ndims(space);
  hsize_t size[2] = {0, 1};
  if (rank != 1 && rank != 2) throw_damaged(path_, "a table has " + std::to_string(rank) + " dimensions");
  check(H5Sget_simple_extent_dims(space, size, nullptr), "read");
  // Compression gains a factor of a thousand at most: more is claimed by a damaged file, and would take all memory.
  hsize_t bytes = 0;
  check(H5Fget_filesize(file_, &bytes), "read");
  if (size[1] == 0 || static_cast<double>(size[0]) * static_cast<double>(size[1]) > 200.0 * static_cast<double>(bytes))
    throw_damaged(path_, "a table is larger than the file can hold");
  Values result{std::vector<double>(size[0] * size[1]), size[1]};
  if (!result.values.empty())
    check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()), "read");
  return result;
}

namespace {

hid_t native(ItemType::Number number) {
  switch (number) {
    case ItemType::Number::byte: return H5T_NATIVE_UINT8;
    case ItemType::Number::int32: return H5T_NATIVE_INT32;
    case ItemType::Number::uint32: return H5T_NATIVE_UINT32;
    case ItemType::Number::int64: return H5T_NATIVE_INT64;
    case ItemType::Number::uint64: return H5T_NATIVE_UINT64;
    case ItemType::Number::float32: return H5T_NATIVE_FLOAT;
    case ItemType::Number::float64: break;
  }
  return H5T_NATIVE_DOUBLE;
}

}  // namespace

void File::array(const std::string& path, const ItemType& type, const void* data, std::size_t count) const {
  errno = 0;
  const hsize_t size[2] = {count, type.count};
  Handle space(H5Screate_simple(type.count == 1 ? 1 : 2, size, nullptr));
  Handle links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  Handle set(check(H5Dcreate2(file_, path.c_str(), native(type.number), space, links, H5P_DEFAULT, H5P_DEFAULT), "write"));
  if (count > 0) check(H5Dwrite(set, native(type.number), H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write");
}

void File::read_array(const std::string& path, const ItemType& type, const std::function<void*(std::size_t)>& resize) const {
  const Handle set = open_dataset(file_, path);
  Handle space(check(H5Dget_space(set), "read")), kind(check(H5Dget_type(set), "read"));
  hsize_t size[2] = {0, 1};
  const int rank = type.count == 1 ? 1 : 2;
  if (H5Sget_simple_extent_ndims(space) != rank || H5Tequal(kind, native(type.number)) <= 0)
    throw_damaged(path_, "'" + path + "' is of another kind");
  check(H5Sget_simple_extent_dims(space, size, nullptr), "read");
  if (size[1] != type.count) throw_damaged(path_, "'" + path + "' is of another kind");
  void* data = resize(size[0]);
  if (size[0] > 0) check(H5Dread(set, native(type.number), H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "read");
}

std::string_view File::image() const {
  flush();
  void* memory = nullptr;
  check(H5Fget_vfd_handle(file_, H5P_DEFAULT, &memory), "write");
  const ssize_t bytes = check(H5Fget_file_image(file_, nullptr, 0), "write");
  return {*static_cast<const char**>(memory), static_cast<std::size_t>(bytes)};
}

void File::flush() const {
  errno = 0;
  check(H5Fflush(file_, H5F_SCOPE_LOCAL), "write");
}

std::vector<float> to_float(std::span<const double> values, std::size_t first, std::size_t stride) {
  std::vector<float> result;
  result.reserve(values.size() / stride + 1);
  constexpr double largest = std::numeric_limits<float>::max();
  for (std::size_t i = first; i < values.size(); i += stride)
    result.push_back(static_cast<float>(std::isfinite(values[i]) ? std::clamp(values[i], -largest, largest) : values[i]));
  return result;
}

}  // namespace undex::output::hdf5
