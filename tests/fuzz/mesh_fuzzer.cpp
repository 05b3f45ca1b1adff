// A mesh of gmsh's is sound when it is read, or refused with std::invalid_argument that names the file.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/gmsh_file.hpp"
#include "tests/fuzz/input.hpp"

using namespace undex;

namespace {

/// What holds of every mesh that is not refused.
void expect_sound(const HexahedralMesh& mesh) {
  fuzz::require(!mesh.cells.empty(), "a mesh has cells");
  std::vector<char> used(mesh.nodes.size()), tied(mesh.nodes.size());
  for (const auto& cell : mesh.cells) {
    for (const int node : cell) used.at(static_cast<std::size_t>(node)) = 1;
    const auto volumes = corner_volumes(mesh.nodes, cell);
    fuzz::require(std::all_of(volumes.begin(), volumes.end(), [](double v) { return v > 0; }) ||
                      std::all_of(volumes.begin(), volumes.end(), [](double v) { return v < 0; }),
                  "the corners of a cell have one sign");
  }
  fuzz::require(std::find(used.begin(), used.end(), 0) == used.end(), "every node is of a cell");
  for (const Vec3& node : mesh.nodes) fuzz::require(node.allFinite(), "nodes are finite");
  for (const HexahedralMesh::Face& face : mesh.faces)
    for (const int node : face.nodes)
      fuzz::require(node >= 0 && std::size_t(node) < mesh.nodes.size(), "faces have nodes of the mesh");
  fuzz::require(mesh.groups.size() == mesh.cells.size(), "every cell has a group");
  for (const HexahedralMesh::Tie& tie : mesh.ties) tied.at(static_cast<std::size_t>(tie.node)) = 1;
  for (const HexahedralMesh::Tie& tie : mesh.ties) {
    double sum = 0;
    Vec3 place = Vec3::Zero();
    for (const auto& [node, weight] : tie.to) {
      fuzz::require(!tied.at(static_cast<std::size_t>(node)), "nodes are tied to free ones");
      fuzz::require(weight >= 0 && weight <= 1 + 1e-12, "weights are shares");
      sum += weight;
      place += weight * mesh.nodes[static_cast<std::size_t>(node)];
    }
    fuzz::require(std::abs(sum - 1) < 1e-12, "the weights of a tie are 1 in all");
    fuzz::require((place - mesh.nodes[static_cast<std::size_t>(tie.node)]).norm() <= 1e-9 * (1 + place.norm()),
                  "tied nodes lie where they are tied");
  }
}

/// Calls make(), which reads and may refuse.
void read_or_refuse(auto&& make) {
  HexahedralMesh mesh;
  try {
    mesh = make();
  } catch (const std::invalid_argument& error) {
    fuzz::require(std::string(error.what()).starts_with("m.msh"), "a refusal names the file");
    return;
  }
  expect_sound(mesh);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto text = fuzz::text_of(data, size);
  for (const GmshCells kind : {GmshCells::hexahedra, GmshCells::quadrangles})
    read_or_refuse([&] { return parse_gmsh(text, "m.msh", kind); });
  // As shells, of a thickness and with planes that the input chooses.
  const unsigned choice = size > 0 ? data[size - 1] : 0;
  constexpr double thickness[4] = {0.01, 0.2, 1e-7, 0.6};
  std::vector<int> planes;
  for (int axis = 0; axis < 3; ++axis)
    if (choice >> (2 + axis) & 1) planes.push_back(axis);
  read_or_refuse([&] {
    const auto layer_of = [&](int group) {
      return Layer{thickness[(choice + unsigned(group % 2)) & 3], ShellOffset((choice >> 5) % 3)};
    };
    return thickened(parse_gmsh_surface(text, "m.msh"), layer_of, planes, "m.msh");
  });
  return 0;
}
