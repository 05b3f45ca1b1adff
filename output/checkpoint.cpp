#include "output/checkpoint.hpp"

#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/hdf5_file.hpp"
#include "output/seal.hpp"

namespace undex::output {
namespace {

namespace fs = std::filesystem;

constexpr long checkpoint_format = 1;  // raised when a reader must know of a change

/// Arrays into a HDF5 file.
class Writer : public StateVisitor {
 public:
  explicit Writer(const hdf5::File& file) : file_(file) {}
  bool restores() const override { return false; }

 protected:
  void visit(const std::string& path, const Array& array) override { file_.array(path, array.type, array.data, array.count); }

 private:
  const hdf5::File& file_;
};

/// And back.
class Reader : public StateVisitor {
 public:
  Reader(const hdf5::File& file, const fs::path& path) : file_(file), path_(path) {}
  bool restores() const override { return true; }

 protected:
  void visit(const std::string& path, const Array& array) override {
    file_.read_array(path, array.type, [&](std::size_t count) {
      if (array.resize) return array.resize(count);
      if (count == array.count) return array.data;
      throw FileError("cannot read " + path_.string() + ": '" + path + "' has " + std::to_string(count) + " items, not " +
                      std::to_string(array.count));
    });
  }

 private:
  const hdf5::File& file_;
  const fs::path& path_;
};

class Fingerprint : public StateVisitor {
 public:
  bool restores() const override { return false; }
  bool wants_cost() const override { return false; }
  std::string digits() const { return sum_.digits(); }

 protected:
  void visit(const std::string& path, const Array& array) override {
    sum_.add(path.data(), path.size());
    if (array.type.comparable()) sum_.add(array.data, array.count * array.type.bytes);
  }

 private:
  Checksum sum_;
};

}  // namespace

void CheckpointTitle::visit_state(StateVisitor& state) {
  state("time", time);
  state("steps", steps);
  state("scene", scene);
  state("numerics", numerics);
  state("start", start);
  state("whole step", whole_step);
}

namespace {

/// Writes a sealed file aside; `visit` names what it holds. Returns where it is, and its size.
std::pair<fs::path, std::size_t> written_aside(const fs::path& path, const std::function<void(Writer&)>& visit) {
  const hdf5::File file = hdf5::File::create_in_memory(path);
  Writer writer(file);
  long version = checkpoint_format;
  writer("format", version);
  visit(writer);
  const std::string_view image = file.image();
  const std::string seal = seal_of(image);
  return {write_temporary(path, {image, seal}), image.size() + seal.size()};
}

/// Throws FileError unless the file is there and whole.
void require_whole(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) throw FileError(path.string() + ": no such file");
  if (!is_sealed(path)) throw FileError(path.string() + ": the file is damaged");
}

void require_format(Reader& reader, const fs::path& path) {
  long version = 0;
  reader("format", version);
  if (version != checkpoint_format) throw FileError(path.string() + ": another version of the program wrote it");
}

}  // namespace

std::size_t write_checkpoint(const fs::path& folder, CheckpointTitle title, const VisitState& visit) {
  const fs::path path = folder / checkpoint_names[0], before = folder / checkpoint_names[1];
  const auto [temporary, size] = written_aside(path, [&](Writer& writer) {
    writer.part("title", [&] { title.visit_state(writer); });
    writer.part("state", [&] { visit(writer); });
  });
  std::error_code ignored;
  if (fs::exists(path, ignored)) put_in_place(path, before);
  put_in_place(temporary, path);
  return size;
}

void write_state(const fs::path& path, const VisitState& visit) {
  put_in_place(written_aside(path, [&](Writer& writer) { visit(writer); }).first, path);
}

void read_state(const fs::path& path, const VisitState& visit) {
  require_whole(path);
  const hdf5::File file = hdf5::File::open_to_read(path);
  Reader reader(file, path);
  require_format(reader, path);
  visit(reader);
}

Checkpoint::Checkpoint(const fs::path& path) : path_(path) {
  require_whole(path);
  const hdf5::File file = hdf5::File::open_to_read(path);
  Reader reader(file, path_);
  require_format(reader, path);
  reader.part("title", [&] { title_.visit_state(reader); });
}

void Checkpoint::restore(const VisitState& visit) const {
  const hdf5::File file = hdf5::File::open_to_read(path_);
  Reader reader(file, path_);
  reader.part("state", [&] { visit(reader); });
}

std::string fingerprint(const VisitState& visit) {
  Fingerprint fingerprint;
  visit(fingerprint);
  return fingerprint.digits();
}

}  // namespace undex::output
