// Meshes through deal.II: triangulation, boundary ids, shape functions, quadrature and point location. This is the only
// file of the program that sees deal.II's headers; everything leaves it as plain arrays.
#include "fem_structure/grid.hpp"

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/grid_tools_cache.h>
#include <deal.II/grid/tria.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/gmsh_file.hpp"
#include "fem_structure/blocks.hpp"

namespace undex::fem {
namespace {

using Triangulation = dealii::Triangulation<3>;

// deal.II counts a cell's vertices lexicographically, VTK counter-clockwise: VTK's vertex i is deal.II's to_dealii[i].
constexpr std::array<unsigned, 8> to_dealii{0, 1, 3, 2, 4, 5, 7, 6};
constexpr std::array<unsigned, 4> around_face{0, 1, 3, 2};

dealii::Point<3> point(const Vec3& x) { return {x[0], x[1], x[2]}; }
Vec3 vector(const dealii::Point<3>& x) { return {x[0], x[1], x[2]}; }

/// Faces on the boundary are given the ids of `id_of`, by their vertices in order; others keep 0.
void name_faces(Triangulation& triangulation, const std::map<std::array<unsigned, 4>, unsigned>& id_of) {
  for (const auto& cell : triangulation.active_cell_iterators())
    for (const auto& face : cell->face_iterators())
      if (face->at_boundary()) {
        std::array<unsigned, 4> key;
        for (unsigned v = 0; v < 4; ++v) key[v] = face->vertex_index(v);
        std::sort(key.begin(), key.end());
        const auto found = id_of.find(key);
        if (found != id_of.end()) face->set_boundary_id(found->second);
      }
}

std::vector<dealii::Point<3>> points(const std::vector<Vec3>& places) {
  std::vector<dealii::Point<3>> vertices;
  vertices.reserve(places.size());
  for (const Vec3& x : places) vertices.push_back(point(x));
  return vertices;
}

/// Named faces have the boundary ids 1, 2, ...; what is left without a name keeps 0.
void create(Triangulation& triangulation, const Blocks& blocks) {
  std::vector<dealii::CellData<3>> cells(blocks.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c].vertices.assign(blocks.cells[c].begin(), blocks.cells[c].end());
  triangulation.create_triangulation(points(blocks.vertices), cells, dealii::SubCellData());
  std::map<std::array<unsigned, 4>, unsigned> id_of;
  for (const Blocks::Face& face : blocks.faces) {
    auto key = face.vertices;
    std::sort(key.begin(), key.end());
    id_of[key] = unsigned(face.name) + 1;
  }
  name_faces(triangulation, id_of);
}

/// A mesh that was checked when it was read: deal.II turns mirrored cells and orders them alike.
void create(Triangulation& triangulation, const HexahedralMesh& mesh) {
  std::vector<dealii::CellData<3>> cells(mesh.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (unsigned i = 0; i < 8; ++i) cells[c].vertices[dealii::GeometryInfo<3>::ucd_to_deal[i]] = unsigned(mesh.cells[c][i]);
  const std::vector<dealii::Point<3>> vertices = points(mesh.nodes);
  dealii::GridTools::invert_cells_with_negative_measure(vertices, cells);
  dealii::GridTools::consistently_order_cells(cells);
  triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
  std::map<std::array<unsigned, 4>, unsigned> id_of;
  for (const HexahedralMesh::Face& face : mesh.faces) {
    std::array<unsigned, 4> key;
    for (int v = 0; v < 4; ++v) key[v] = unsigned(face.nodes[v]);
    std::sort(key.begin(), key.end());
    id_of[key] = unsigned(face.id);
  }
  name_faces(triangulation, id_of);
}

HexahedralMesh read_mesh(const GmshMesh& mesh, const std::string& who) {
  try {
    return read_gmsh(mesh.path);
  } catch (const std::invalid_argument& mistake) {
    throw std::invalid_argument(who + ": " + mistake.what());
  }
}

void take_reference_cell(const dealii::FE_Q<3>& element, const dealii::QGauss<3>& rule, ReferenceCell& reference) {
  for (unsigned q = 0; q < rule.size(); ++q) {
    reference.weight[q] = rule.weight(q);
    for (unsigned d = 0; d < 3; ++d) reference.point[q][d] = rule.point(q)[d];
    for (unsigned i = 0; i < 8; ++i) {
      reference.value[i][q] = element.shape_value(to_dealii[i], rule.point(q));
      const auto gradient = element.shape_grad(to_dealii[i], rule.point(q));
      for (unsigned d = 0; d < 3; ++d) reference.gradient[d][i][q] = gradient[d];
    }
  }
}

/// The smallest Jacobian determinant over the cell's corners and quadrature points.
double smallest_jacobian(const Grid& grid, const std::array<int, 8>& cell) {
  const auto corner = [&](int i, int j, int k, int l) {
    const Vec3& x = grid.nodes[cell[i]];
    return (grid.nodes[cell[j]] - x).cross(grid.nodes[cell[k]] - x).dot(grid.nodes[cell[l]] - x);
  };
  double smallest = std::min({corner(0, 1, 3, 4), corner(1, 2, 0, 5), corner(2, 3, 1, 6), corner(3, 0, 2, 7), corner(4, 7, 5, 0),
                              corner(5, 4, 6, 1), corner(6, 5, 7, 2), corner(7, 6, 4, 3)});
  for (int q = 0; q < 8; ++q) {
    Mat3 jacobian = Mat3::Zero();
    for (int i = 0; i < 8; ++i)
      for (int d = 0; d < 3; ++d) jacobian.col(d) += grid.nodes[cell[i]] * grid.reference.gradient[d][i][q];
    smallest = std::min(smallest, jacobian.determinant());
  }
  return smallest;
}

}  // namespace

struct Mesher::Held {
  Triangulation triangulation;
  dealii::MappingQ1<3> mapping;
  std::unique_ptr<dealii::GridTools::Cache<3>> cache;  // costly, built at the first question
  Grid grid;
};

Mesher::Mesher(const Settings& settings) : held_(std::make_unique<Held>()) {
  const std::string who = "structure '" + settings.name + "'";
  dealii::MultithreadInfo::set_thread_limit(1);  // OpenMP has the cores
  Triangulation& triangulation = held_->triangulation;
  Grid& grid = held_->grid;
  std::vector<std::string> names;
  const auto build = [&](const auto& mesh) {
    if constexpr (std::is_same_v<std::decay_t<decltype(mesh)>, GmshMesh>) {
      create(triangulation, mesh.read ? *mesh.read : read_mesh(mesh, who));
    } else {
      const Blocks blocks = build_blocks(mesh, settings.symmetry_axes, who);
      create(triangulation, blocks);
      names = blocks.names;
    }
  };
  std::visit(build, settings.mesh);
  const bool named = !std::holds_alternative<GmshMesh>(settings.mesh);

  const dealii::FE_Q<3> element(1);
  const dealii::QGauss<3> rule(2);
  take_reference_cell(element, rule, grid.reference);

  grid.nodes.reserve(triangulation.n_vertices());
  for (const auto& x : triangulation.get_vertices()) grid.nodes.push_back(vector(x));
  grid.cells.resize(triangulation.n_active_cells());
  grid.nodal_volume.resize(grid.cells.size());
  dealii::FEValues<3> values(held_->mapping, element, rule, dealii::update_values | dealii::update_JxW_values);
  for (const auto& cell : triangulation.active_cell_iterators()) {
    const std::size_t c = cell->active_cell_index();
    Vec3 center = Vec3::Zero();
    for (unsigned i = 0; i < 8; ++i) {
      grid.cells[c][i] = static_cast<int>(cell->vertex_index(to_dealii[i]));
      center += grid.nodes[grid.cells[c][i]] / 8.0;
    }
    if (!(smallest_jacobian(grid, grid.cells[c]) > 0.0))
      throw std::invalid_argument(who + ": cell " + std::to_string(c) + " near (" + std::to_string(center[0]) + ", " +
                                  std::to_string(center[1]) + ", " + std::to_string(center[2]) +
                                  ") m is inverted or flat; repair the mesh there");
    values.reinit(cell);
    for (unsigned i = 0; i < 8; ++i) {
      grid.nodal_volume[c][i] = 0.0;
      for (unsigned q = 0; q < rule.size(); ++q) grid.nodal_volume[c][i] += values.shape_value(to_dealii[i], q) * values.JxW(q);
    }
    for (const auto& face : cell->face_iterators()) {
      if (!face->at_boundary()) continue;
      const unsigned id = face->boundary_id();
      if (named && id == 0) continue;
      std::array<int, 4> quad;
      for (unsigned v = 0; v < 4; ++v) quad[v] = static_cast<int>(face->vertex_index(around_face[v]));
      const Vec3& x0 = grid.nodes[quad[0]];
      const Vec3 normal = (grid.nodes[quad[1]] - x0).cross(grid.nodes[quad[3]] - x0);
      const Vec3 middle = (x0 + grid.nodes[quad[1]] + grid.nodes[quad[2]] + grid.nodes[quad[3]]) / 4.0;
      if (normal.dot(center - middle) < 0.0) std::swap(quad[1], quad[3]);
      grid.faces[named ? names[id - 1] : std::to_string(id)].push_back(quad);
    }
  }
}

Mesher::~Mesher() = default;
Mesher::Mesher(Mesher&&) noexcept = default;
Mesher& Mesher::operator=(Mesher&&) noexcept = default;

const Grid& Mesher::grid() const { return held_->grid; }

std::optional<Place> Mesher::containing_cell(const Vec3& reference_position) const {
  if (!held_->cache) held_->cache = std::make_unique<dealii::GridTools::Cache<3>>(held_->triangulation, held_->mapping);
  try {
    const auto [cell, unit] = dealii::GridTools::find_active_cell_around_point(*held_->cache, point(reference_position));
    if (cell.state() != dealii::IteratorState::valid) return std::nullopt;
    Place place{cell->active_cell_index(), {}, 0.0};
    for (unsigned d = 0; d < 3; ++d) {
      if (unit[d] < -1e-9 || unit[d] > 1.0 + 1e-9) return std::nullopt;
      place.unit[d] = std::clamp(unit[d], 0.0, 1.0);
    }
    return place;
  } catch (const dealii::ExceptionBase&) {
    return std::nullopt;
  }
}

}  // namespace undex::fem
