#include "output/particle_fields.hpp"

#include <cctype>
#include <cerrno>
#include <stdexcept>
#include <string>

#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/hdf5_file.hpp"

namespace undex::output {

namespace {

// "name_1" would be taken for the second component of a vector "name".
bool looks_like_a_component(const std::string& name) {
  const std::size_t bar = name.rfind('_');
  if (bar == std::string::npos || bar + 1 == name.size()) return false;
  for (std::size_t i = bar + 1; i < name.size(); ++i)
    if (std::isdigit(static_cast<unsigned char>(name[i])) == 0) return false;
  return true;
}

}  // namespace

ParticleFields::ParticleFields(std::filesystem::path path) : path_(std::move(path)) { create(); }

ParticleFields ParticleFields::continued(std::filesystem::path path) {
  ParticleFields fields;
  fields.path_ = std::move(path);
  return fields;
}

void ParticleFields::visit_state(StateVisitor& state) {
  state("snapshots", snapshots_);
  if (state.restores()) cut();
}

void ParticleFields::cut() {
  if (snapshots_ == 0) return create();
  const hdf5::File file = hdf5::File::open(path_);
  const auto name = [](int number) { return "Step#" + std::to_string(number); };
  for (int k = 0; k < snapshots_; ++k)
    if (!file.has(name(k)))
      throw FileError(path_.string() + ": has only " + std::to_string(k) + " of the " + std::to_string(snapshots_) +
                      " snapshots that belong to the checkpoint; take the file from where it is whole");
  for (int k = snapshots_; file.has(name(k)); ++k) file.unlink(name(k));
  file.flush();
}

void ParticleFields::create() {
  // Made elsewhere and moved to its place: a program killed here leaves what was there before, not an empty file.
  const std::filesystem::path temporary = temporary_name(path_);
  try {
    hdf5::File::create(temporary).flush();
  } catch (const FileError&) {
    const int error = errno;
    std::error_code none;
    std::filesystem::remove(temporary, none);
    throw_file_error("write", path_, error);  // under the name that the user knows
  }
  put_in_place(temporary, path_);
}

void ParticleFields::write(double time, std::span<const Vec3> positions, std::span<const Field> fields,
                           std::span<const std::int64_t> ids) {
  std::size_t bytes = positions.size() * 12 + ids.size() * 8 + 65536;
  for (const Field& field : fields) {
    if (field.components < 1 || field.values.size() != positions.size() * static_cast<std::size_t>(field.components))
      throw std::invalid_argument("particle field '" + field.name + "': " + std::to_string(field.values.size()) + " values for " +
                                  std::to_string(positions.size()) + " particles of " + std::to_string(field.components) +
                                  " components");
    if (field.name.empty() || field.name.find('/') != std::string::npos || looks_like_a_component(field.name))
      throw std::invalid_argument("particle field '" + field.name + "': not a usable name");
    bytes += field.values.size() * 4;
  }
  if (!ids.empty() && ids.size() != positions.size())
    throw std::invalid_argument("particle ids: " + std::to_string(ids.size()) + " for " + std::to_string(positions.size()) +
                                " particles");
  require_space(path_, static_cast<double>(bytes));

  const hdf5::File file = hdf5::File::open(path_);
  {
    const hdf5::Handle step = file.unnamed_group();
    file.attribute(step, "TimeValue", time);
    const auto coordinates = as_components(positions);
    const char* axis[] = {"x", "y", "z"};
    for (std::size_t d = 0; d < 3; ++d) file.dataset(step, axis[d], hdf5::to_float(coordinates, d, 3));
    for (const Field& field : fields) {
      const auto components = static_cast<std::size_t>(field.components);
      for (std::size_t c = 0; c < components; ++c)
        file.dataset(step, components == 1 ? field.name : field.name + "_" + std::to_string(c),
                     hdf5::to_float(field.values, c, components));
    }
    if (!ids.empty()) file.dataset(step, "id", ids);
    file.flush();
    file.link(step, "Step#" + std::to_string(snapshots_));
    file.flush();
  }
  ++snapshots_;
}

}  // namespace undex::output
