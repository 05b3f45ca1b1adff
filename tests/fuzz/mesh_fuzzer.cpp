// A mesh of gmsh's is sound when it is read, or refused with std::invalid_argument that names the file.
#include <algorithm>
#include <stdexcept>

#include "core/gmsh_file.hpp"
#include "tests/fuzz/input.hpp"

using namespace undex;

namespace {

void read_or_refuse(const std::uint8_t* data, std::size_t size, GmshCells kind) {
  HexahedralMesh mesh;
  try {
    mesh = parse_gmsh(fuzz::text_of(data, size), "m.msh", kind);
  } catch (const std::invalid_argument& error) {
    fuzz::require(std::string(error.what()).starts_with("m.msh"), "a refusal names the file");
    return;
  }
  fuzz::require(!mesh.cells.empty(), "a mesh has cells");
  std::vector<char> used(mesh.nodes.size());
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
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const GmshCells kind : {GmshCells::hexahedra, GmshCells::quadrangles}) read_or_refuse(data, size, kind);
  return 0;
}
