// Meshes of structures: what they are made from, the library that makes them, and what is asked of their cells.
#include <dlfcn.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/gmsh_file.hpp"
#include "fem_structure/deal_mesh.hpp"
#include "fem_structure/structure.hpp"

namespace undex::fem {
namespace {

/// undex_deal_mesh of the library undex_meshes, loaded at the first call; it lies beside the program, or in a folder of its
/// run-time search path.
decltype(&undex_deal_mesh) deal_mesh() {
  static const auto function = [] {
    void* const library = dlopen("libundex_meshes.so", RTLD_NOW | RTLD_LOCAL);
    void* const found = library ? dlsym(library, "undex_deal_mesh") : nullptr;
    if (!found)
      throw FileError(std::string("the library of meshes cannot be loaded: ") + dlerror() +
                      "; it is built with the program and must stay beside it, or in lib/undex of an installed one");
    return reinterpret_cast<decltype(&undex_deal_mesh)>(found);
  }();
  return function;
}

HexahedralMesh read_mesh(const GmshMesh& mesh, const Settings& settings, const std::string& who) {
  try {
    if (settings.element == ElementKind::shell && !settings.axisymmetric)
      return shells_on(read_gmsh_surface(mesh.path, mesh.scale), mesh, settings.parts, settings.symmetry_axes);
    return read_gmsh(mesh.path, settings.axisymmetric ? GmshCells::quadrangles : GmshCells::hexahedra, mesh.scale);
  } catch (const std::invalid_argument& mistake) {
    throw std::invalid_argument(who + ": " + mistake.what());
  }
}

/// The smallest Jacobian determinant over the cell's corners and quadrature points; of a ring, that of its section.
double smallest_jacobian(const Grid& grid, const std::array<int, 8>& cell) {
  const std::array<Vec3, 8> at = corners_of(cell, grid.nodes);
  const auto corner = [&](int i, int j, int k, int l) { return (at[j] - at[i]).cross(at[k] - at[i]).dot(at[l] - at[i]); };
  double smallest = std::min({corner(0, 1, 3, 4), corner(1, 2, 0, 5), corner(2, 3, 1, 6), corner(3, 0, 2, 7), corner(4, 7, 5, 0),
                              corner(5, 4, 6, 1), corner(6, 5, 7, 2), corner(7, 6, 4, 3)});
  for (int q = 0; q < 8; ++q) {
    Mat3 jacobian = Mat3::Zero();
    for (int i = 0; i < 8; ++i)
      for (int d = 0; d < 3; ++d) jacobian.col(d) += grid.nodes[cell[i]] * grid.reference.gradient[d][i][q];
    if (grid.axisymmetric) jacobian(2, 2) = 1.0;
    smallest = std::min(smallest, jacobian.determinant());
  }
  return smallest;
}

/// Throws std::invalid_argument where a cell is inverted or flat.
void require_sound_cells(const Grid& grid, const std::string& who) {
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    if (smallest_jacobian(grid, grid.cells[c]) > 0.0) continue;
    Vec3 center = Vec3::Zero();
    for (const int node : grid.cells[c]) center += grid.nodes[node] / 8.0;
    throw std::invalid_argument(who + ": cell " + std::to_string(c) + " near (" + std::to_string(center[0]) + ", " +
                                std::to_string(center[1]) + ", " + std::to_string(center[2]) +
                                ") m is inverted or flat; repair the mesh there");
  }
}

std::unique_ptr<DealMesh> build(const Settings& settings, const std::string& who) {
  const auto from = [&](MeshSource source) {
    source.axisymmetric = settings.axisymmetric;
    return std::unique_ptr<DealMesh>(deal_mesh()(source));
  };
  const auto build_from = [&](const auto& mesh) {
    if constexpr (std::is_same_v<std::decay_t<decltype(mesh)>, GmshMesh>) {
      if (mesh.read) return from({.mesh = mesh.read.get()});
      const HexahedralMesh read = read_mesh(mesh, settings, who);
      return from({.mesh = &read});
    } else {
      const Blocks blocks = settings.axisymmetric ? build_meridian(mesh, settings.symmetry_axes, who)
                                                  : build_blocks(mesh, settings.symmetry_axes, who);
      return from({.blocks = &blocks});
    }
  };
  return std::visit(build_from, settings.mesh);
}

}  // namespace

void load_meshes() { deal_mesh(); }

Mesher::Mesher(const Settings& settings) {
  const std::string who = "structure '" + settings.name + "'";
  held_ = build(settings, who);
  require_sound_cells(held_->grid, who);
}
Mesher::~Mesher() = default;
Mesher::Mesher(Mesher&&) noexcept = default;
Mesher& Mesher::operator=(Mesher&&) noexcept = default;

const Grid& Mesher::grid() const { return held_->grid; }

std::optional<Place> Mesher::containing_cell(const Vec3& reference_position) const {
  return held_->containing_cell(reference_position);
}

}  // namespace undex::fem
