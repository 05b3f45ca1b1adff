#include "output/structure_fields.hpp"

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/hexahedral_mesh.hpp"
#include "output/files.hpp"
#include "output/hdf5_file.hpp"

namespace undex::output {

namespace {

constexpr unsigned char vtk_line = 3, vtk_quad = 9, vtk_hexahedron = 12;

/// Nodes of a cell: a quadrangle has each twice, a segment {a, b, b, a, a, b, b, a}.
std::span<const int> nodes_of(const std::array<int, 8>& cell) {
  const bool flat = is_quadrangle(cell), segment = flat && cell[1] == cell[2] && cell[0] == cell[3];
  return {cell.data(), segment ? 2u : flat ? 4u : 8u};
}

void check_fields(std::span<const Field> fields, std::size_t count, const char* place) {
  for (const Field& field : fields)
    if (field.name.empty() || field.components < 1 || field.values.size() != count * static_cast<std::size_t>(field.components))
      throw std::invalid_argument("structure field '" + field.name + "': " + std::to_string(field.values.size()) + " values of " +
                                  std::to_string(field.components) + " components for " + std::to_string(count) + " " + place);
}

void write_grid(const hdf5::File& file, const StructureSnapshot& snapshot) {
  const std::int64_t version[2] = {1, 0};
  const std::int64_t points = static_cast<std::int64_t>(snapshot.positions.size());
  const std::int64_t cells = static_cast<std::int64_t>(snapshot.cells.size());

  const hdf5::Handle root = file.group(file, "VTKHDF");
  file.attribute(root, "Version", version);
  file.attribute(root, "Type", "UnstructuredGrid");
  file.dataset(root, "NumberOfPoints", {&points, 1});
  file.dataset(root, "NumberOfCells", {&cells, 1});
  std::vector<std::int64_t> connectivity, offsets{0};
  std::vector<unsigned char> types;
  connectivity.reserve(snapshot.cells.size() * 8);
  offsets.reserve(snapshot.cells.size() + 1);
  for (const auto& cell : snapshot.cells) {
    const std::span<const int> nodes = nodes_of(cell);
    connectivity.insert(connectivity.end(), nodes.begin(), nodes.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(nodes.size() == 2 ? vtk_line : nodes.size() == 4 ? vtk_quad : vtk_hexahedron);
  }
  const std::int64_t connections = static_cast<std::int64_t>(connectivity.size());
  file.dataset(root, "NumberOfConnectivityIds", {&connections, 1});
  file.dataset(root, "Points", hdf5::to_float(as_components(snapshot.positions)), 3);
  file.dataset(root, "Connectivity", connectivity);
  file.dataset(root, "Offsets", offsets);
  file.dataset(root, "Types", types);

  const hdf5::Handle point_data = file.group(root, "PointData");
  for (const Field& field : snapshot.point_data)
    file.dataset(point_data, field.name, hdf5::to_float(field.values), static_cast<std::size_t>(field.components));
  const hdf5::Handle cell_data = file.group(root, "CellData");
  for (const Field& field : snapshot.cell_data)
    file.dataset(cell_data, field.name, hdf5::to_float(field.values), static_cast<std::size_t>(field.components));
  file.flush();
}

}  // namespace

StructureFields::StructureFields(std::filesystem::path folder, std::string stem)
    : folder_(std::move(folder)), stem_(std::move(stem)) {}

void StructureFields::write(double time, const StructureSnapshot& snapshot) {
  check_fields(snapshot.point_data, snapshot.positions.size(), "nodes");
  check_fields(snapshot.cell_data, snapshot.cells.size(), "cells");
  for (const auto& cell : snapshot.cells)
    for (const int node : cell)
      if (node < 0 || static_cast<std::size_t>(node) >= snapshot.positions.size())
        throw std::invalid_argument("structure cell names node " + std::to_string(node) + " of " +
                                    std::to_string(snapshot.positions.size()));

  const std::filesystem::path path = folder_ / name_of(times_.size());
  const std::filesystem::path temporary = temporary_name(path);
  std::size_t bytes = 12 * snapshot.positions.size() + 73 * snapshot.cells.size() + 65536;
  for (const auto* fields : {&snapshot.point_data, &snapshot.cell_data})
    for (const Field& field : *fields) bytes += 4 * field.values.size();
  require_space(path, static_cast<double>(bytes));
  try {
    const hdf5::File file = hdf5::File::create(temporary);
    write_grid(file, snapshot);
  } catch (...) {
    unlink(temporary.c_str());
    throw;
  }
  put_in_place(temporary, path);

  times_.push_back(time);
  write_index();
}

std::string StructureFields::name_of(std::size_t number) const {
  char digits[16];
  std::snprintf(digits, sizeof digits, "_%05zu", number);
  return stem_ + digits + ".hdf";
}

void StructureFields::write_index() const {
  std::string index = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [";
  for (std::size_t i = 0; i < times_.size(); ++i) {
    char when[32];
    std::snprintf(when, sizeof when, "%.12g", times_[i]);
    index += (i == 0 ? "\n    {\"name\": \"" : ",\n    {\"name\": \"") + name_of(i) + "\", \"time\": " + when + "}";
  }
  index += "\n  ]\n}\n";
  write_text_atomically(folder_ / (stem_ + ".hdf.series"), index);
}

void StructureFields::visit_state(StateVisitor& state) {
  state("times", times_);
  if (state.restores()) cut();
}

void StructureFields::cut() const {
  std::error_code error;
  for (std::size_t k = 0; k < times_.size(); ++k)
    if (!std::filesystem::is_regular_file(folder_ / name_of(k), error))
      throw FileError((folder_ / name_of(k)).string() + ": a snapshot that belongs to the checkpoint is missing; bring it back");
  for (std::size_t k = times_.size(); std::filesystem::remove(folder_ / name_of(k), error); ++k) {
  }
  if (!times_.empty()) write_index();
  else std::filesystem::remove(folder_ / (stem_ + ".hdf.series"), error);
}

}  // namespace undex::output
