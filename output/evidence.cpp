#include "output/evidence.hpp"

#include <cmath>
#include <string_view>

#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/hdf5_file.hpp"
#include "output/seal.hpp"

namespace undex::output {
namespace {

namespace fs = std::filesystem;

constexpr double evidence_format = 2;  // raised when a reader must know of a change

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw FileError("cannot read " + path.string() + ": " + reason +
                  "; run the scene again, or take it from the run's original folder");
}

void write_samples(const hdf5::File& file, const hdf5::Handle& group, const Samples& samples) {
  for (std::size_t c = 0; c < samples.columns.size(); ++c) {
    const Column& column = samples.columns[c];
    file.dataset(group, column.name, std::span<const double>(samples.values[c]));
    const hdf5::Handle set = file.open_dataset(group, column.name);
    file.attribute(set, "unit", column.unit.empty() ? std::string("-") : column.unit);
  }
}

Samples read_samples(const hdf5::File& file, const hdf5::Handle& group, const fs::path& path, const std::string& name) {
  Samples samples;
  for (const std::string& column : file.members(group)) {
    const hdf5::Handle set = file.open_dataset(group, column);
    const std::string unit = file.text(set, "unit");
    samples.columns.push_back({column, unit == "-" ? "" : unit});
    samples.values.push_back(file.read(set).values);
    if (samples.values.back().size() != samples.rows()) refuse(path, "the columns of '" + name + "' differ in length");
  }
  if (samples.columns.empty() || samples.columns.front().name != "time") refuse(path, "'" + name + "' has no time");
  return samples;
}

void write_all(const hdf5::File& file, const Evidence& evidence) {
  file.attribute(file, "format", evidence_format);
  file.attribute(file, "time", evidence.time);
  const hdf5::Handle histories = file.ordered_group(file, "history"), energy = file.ordered_group(file, "energy"),
                     fields = file.ordered_group(file, "fields");
  for (const auto& [name, samples] : evidence.probes) write_samples(file, file.ordered_group(histories, name), samples);
  write_samples(file, energy, evidence.energy);
  if (!evidence.bodies.columns.empty()) write_samples(file, file.ordered_group(file, "bodies"), evidence.bodies);
  if (!evidence.forces.columns.empty()) write_samples(file, file.ordered_group(file, "forces"), evidence.forces);
  if (!evidence.lines.empty()) {
    const hdf5::Handle lines = file.ordered_group(file, "lines");
    for (const auto& [name, samples] : evidence.lines) write_samples(file, file.ordered_group(lines, name), samples);
  }
  for (const auto& [name, field] : evidence.fields)
    file.dataset(fields, name, std::span<const double>(field.values), static_cast<std::size_t>(field.components));
  file.flush();
}

}  // namespace

std::vector<Vec3> LastField::vectors() const {
  std::vector<Vec3> result(values.size() / 3);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return result;
}

Series Evidence::series(const std::string& probe, const std::string& column) const {
  const auto found = probes.find(probe);
  return found == probes.end() ? Series{} : found->second.series(column);
}

const LastField& Evidence::field(const std::string& name) const {
  const auto found = fields.find(name);
  if (found == fields.end())
    throw FileError("the run has not kept the field '" + name + "' of its last state; run the scene again");
  return found->second;
}

void write_evidence(const fs::path& path, const Evidence& evidence) {
  const hdf5::File file = hdf5::File::create_in_memory(path);
  write_all(file, evidence);
  const std::string_view image = file.image();
  put_in_place(write_temporary(path, {image, seal_of(image)}), path);
}

Evidence read_evidence(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    throw FileError(path.string() + ": no such file: an older program computed the run; run the scene again");
  if (!is_sealed(path)) refuse(path, "the file is damaged");
  const hdf5::File file = hdf5::File::open_to_read(path);
  if (file.number(file, "format") != evidence_format) refuse(path, "another version of the program wrote it");
  Evidence evidence;
  evidence.time = file.number(file, "time");
  if (!std::isfinite(evidence.time)) refuse(path, "its time is no number");
  const hdf5::Handle histories = file.open_group(file, "history"), fields = file.open_group(file, "fields");
  for (const std::string& name : file.members(histories))
    evidence.probes[name] = read_samples(file, file.open_group(histories, name), path, name);
  evidence.energy = read_samples(file, file.open_group(file, "energy"), path, "energy");
  // An older program's has none of the following.
  for (const auto& [name, samples] : {std::pair{"bodies", &evidence.bodies}, {"forces", &evidence.forces}})
    if (file.has(file, name)) *samples = read_samples(file, file.open_group(file, name), path, name);
  if (file.has(file, "lines")) {
    const hdf5::Handle lines = file.open_group(file, "lines");
    for (const std::string& name : file.members(lines))
      evidence.lines[name] = read_samples(file, file.open_group(lines, name), path, name);
  }
  for (const std::string& name : file.members(fields)) {
    hdf5::File::Values read = file.read(file.open_dataset(fields, name));
    evidence.fields[name] = {.components = static_cast<int>(read.columns), .values = std::move(read.values)};
  }
  return evidence;
}

}  // namespace undex::output
