#include "output/structure_fields.hpp"

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include "output/files.hpp"
#include "output/hdf5_file.hpp"

namespace undex::output {

namespace {

constexpr unsigned char vtk_hexahedron = 12;

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
  const std::int64_t connections = 8 * cells;

  const hdf5::Handle root = file.group(file, "VTKHDF");
  file.attribute(root, "Version", version);
  file.attribute(root, "Type", "UnstructuredGrid");
  file.dataset(root, "NumberOfPoints", {&points, 1});
  file.dataset(root, "NumberOfCells", {&cells, 1});
  file.dataset(root, "NumberOfConnectivityIds", {&connections, 1});

  std::vector<std::int64_t> connectivity, offsets{0};
  connectivity.reserve(snapshot.cells.size() * 8);
  offsets.reserve(snapshot.cells.size() + 1);
  for (const auto& cell : snapshot.cells) {
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  file.dataset(root, "Points", hdf5::to_float(as_components(snapshot.positions)), 3);
  file.dataset(root, "Connectivity", connectivity);
  file.dataset(root, "Offsets", offsets);
  file.dataset(root, "Types", std::vector<unsigned char>(snapshot.cells.size(), vtk_hexahedron));

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

  char number[16];
  std::snprintf(number, sizeof number, "_%05zu", files_.size());
  const std::string name = stem_ + number + ".hdf";
  const std::filesystem::path path = folder_ / name;
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

  files_.emplace_back(name, time);
  std::string index = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [";
  for (std::size_t i = 0; i < files_.size(); ++i) {
    char when[32];
    std::snprintf(when, sizeof when, "%.12g", files_[i].second);
    index += (i == 0 ? "\n    {\"name\": \"" : ",\n    {\"name\": \"") + files_[i].first + "\", \"time\": " + when + "}";
  }
  index += "\n  ]\n}\n";
  write_text_atomically(folder_ / (stem_ + ".hdf.series"), index);
}

}  // namespace undex::output
