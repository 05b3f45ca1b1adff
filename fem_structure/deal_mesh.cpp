// Meshes through deal.II: triangulation, boundary ids, shape functions, quadrature and point location. This is the only
// file that sees deal.II's headers; everything leaves it as plain arrays.
#include "fem_structure/deal_mesh.hpp"

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/grid_tools_cache.h>
#include <deal.II/grid/tria.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>

#include "core/surface.hpp"

namespace undex::fem {
namespace {

// deal.II counts a cell's vertices lexicographically, VTK counter-clockwise: VTK's vertex i is deal.II's to_dealii[i].
// Quadrangles (dim = 2) are as the first half of a hexahedron.
constexpr std::array<unsigned, 8> to_dealii{0, 1, 3, 2, 4, 5, 7, 6};
template <int dim>
constexpr std::array<unsigned, 4> around_face =
    dim == 3 ? std::array<unsigned, 4>{0, 1, 3, 2} : std::array<unsigned, 4>{0, 1, 1, 0};
template <int dim>
constexpr unsigned cell_nodes = 1u << dim;

template <int dim>
dealii::Point<dim> point(const Vec3& x) {
  dealii::Point<dim> p;
  for (unsigned d = 0; d < dim; ++d) p[d] = x[d];
  return p;
}
template <int dim>
Vec3 vector(const dealii::Point<dim>& p) {
  Vec3 x = Vec3::Zero();
  for (unsigned d = 0; d < dim; ++d) x[d] = p[d];
  return x;
}

/// Vertices of a face in order: by these it is found.
template <int dim>
using FaceKey = std::array<unsigned, cell_nodes<dim> / 2>;
template <int dim>
FaceKey<dim> key_of(const auto& vertices) {
  FaceKey<dim> key;
  for (std::size_t v = 0; v < key.size(); ++v) key[v] = unsigned(vertices[v]);
  std::sort(key.begin(), key.end());
  return key;
}

/// Faces on the boundary are given the ids of `id_of`; others keep 0.
template <int dim>
void name_faces(dealii::Triangulation<dim>& triangulation, const std::map<FaceKey<dim>, unsigned>& id_of) {
  for (const auto& cell : triangulation.active_cell_iterators())
    for (const auto& face : cell->face_iterators())
      if (face->at_boundary()) {
        FaceKey<dim> vertices;
        for (unsigned v = 0; v < vertices.size(); ++v) vertices[v] = face->vertex_index(v);
        const auto found = id_of.find(key_of<dim>(vertices));
        if (found != id_of.end()) face->set_boundary_id(found->second);
      }
}

template <int dim>
std::vector<dealii::Point<dim>> points(const std::vector<Vec3>& places) {
  std::vector<dealii::Point<dim>> vertices;
  vertices.reserve(places.size());
  for (const Vec3& x : places) vertices.push_back(point<dim>(x));
  return vertices;
}

/// Named faces have the boundary ids 1, 2, ...; what is left without a name keeps 0.
template <int dim>
void create(dealii::Triangulation<dim>& triangulation, const Blocks& blocks) {
  std::vector<dealii::CellData<dim>> cells(blocks.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells[c].vertices.assign(blocks.cells[c].begin(), blocks.cells[c].begin() + cell_nodes<dim>);
  triangulation.create_triangulation(points<dim>(blocks.vertices), cells, dealii::SubCellData());
  std::map<FaceKey<dim>, unsigned> id_of;
  for (const Blocks::Face& face : blocks.faces) id_of[key_of<dim>(face.vertices)] = unsigned(face.name) + 1;
  name_faces<dim>(triangulation, id_of);
}

/// A mesh that was checked when it was read: deal.II turns mirrored cells and orders them alike. Those of a shell keep their
/// directions.
template <int dim>
void create(dealii::Triangulation<dim>& triangulation, const HexahedralMesh& mesh) {
  std::vector<dealii::CellData<dim>> cells(mesh.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (unsigned i = 0; i < cell_nodes<dim>; ++i)
      cells[c].vertices[mesh.is_shell ? to_dealii[i] : dealii::GeometryInfo<dim>::ucd_to_deal[i]] = unsigned(mesh.cells[c][i]);
  const std::vector<dealii::Point<dim>> vertices = points<dim>(mesh.nodes);
  if (!mesh.is_shell) {
    dealii::GridTools::invert_cells_with_negative_measure(vertices, cells);
    dealii::GridTools::consistently_order_cells(cells);
  }
  triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
  std::map<FaceKey<dim>, unsigned> id_of;
  for (const HexahedralMesh::Face& face : mesh.faces) id_of[key_of<dim>(face.nodes)] = unsigned(face.id);
  name_faces<dim>(triangulation, id_of);
}

/// The same lanes for the points of each cell that fills them.
template <int dim>
void take_reference_cell(const dealii::FE_Q<dim>& element, const dealii::QGauss<dim>& rule, ReferenceCell& reference) {
  reference = {};
  for (unsigned q = 0; q < 8; ++q) {
    const unsigned at = q % rule.size();
    reference.weight[q] = rule.weight(at);
    for (unsigned d = 0; d < dim; ++d) reference.point[q][d] = rule.point(at)[d];
    for (unsigned i = 0; i < cell_nodes<dim>; ++i) {
      reference.value[i][q] = element.shape_value(to_dealii[i], rule.point(at));
      const auto gradient = element.shape_grad(to_dealii[i], rule.point(at));
      for (unsigned d = 0; d < dim; ++d) reference.gradient[d][i][q] = gradient[d];
    }
  }
}

/// Hexahedra (dim = 3), or the quadrangles of a meridian.
template <int dim>
struct Built final : DealMesh {
  dealii::Triangulation<dim> triangulation;
  dealii::MappingQ1<dim> mapping;
  std::unique_ptr<dealii::GridTools::Cache<dim>> cache;  // costly, built at the first question

  explicit Built(const MeshSource& source);
  /// `name_of` a face's id: nothing for one that is not named.
  void take_cells(const std::function<std::string(int)>& name_of);
  std::optional<Place> containing_cell(const Vec3& reference_position) override;
};

template <int dim>
Built<dim>::Built(const MeshSource& source) {
  if (source.blocks) {
    create<dim>(triangulation, *source.blocks);
    take_cells([&](int id) { return id == 0 ? std::string() : source.blocks->names[std::size_t(id) - 1]; });
  } else {
    const HexahedralMesh& mesh = *source.mesh;
    create<dim>(triangulation, mesh);
    take_cells([&](int id) { return mesh.face_names.of(id); });
    grid.ties = mesh.ties;
    grid.groups = mesh.groups;
    grid.group_names = mesh.group_names;
    grid.face_names = mesh.face_names;
  }
}

/// Cells, their volumes and their faces as plain arrays.
template <int dim>
void Built<dim>::take_cells(const std::function<std::string(int)>& name_of) {
  const dealii::FE_Q<dim> element(1);
  const dealii::QGauss<dim> rule(2);
  grid.axisymmetric = dim == 2;
  take_reference_cell<dim>(element, rule, grid.reference);

  grid.nodes.reserve(triangulation.n_vertices());
  for (const auto& x : triangulation.get_vertices()) grid.nodes.push_back(vector<dim>(x));
  grid.cells.resize(triangulation.n_active_cells());
  grid.nodal_volume.resize(grid.cells.size());
  dealii::FEValues<dim> values(mapping, element, rule,
                               dealii::update_values | dealii::update_JxW_values | dealii::update_quadrature_points);
  for (const auto& cell : triangulation.active_cell_iterators()) {
    const std::size_t c = cell->active_cell_index();
    Vec3 center = Vec3::Zero();
    for (unsigned i = 0; i < 8; ++i) {
      grid.cells[c][i] = static_cast<int>(cell->vertex_index(to_dealii[i % cell_nodes<dim>]));
      center += grid.nodes[grid.cells[c][i]] / 8.0;
    }
    values.reinit(cell);
    grid.nodal_volume[c].fill(0.0);
    for (unsigned i = 0; i < cell_nodes<dim>; ++i)
      for (unsigned q = 0; q < rule.size(); ++q) {
        const double turn = dim == 3 ? 1.0 : 2.0 * std::numbers::pi * values.quadrature_point(q)[0];
        grid.nodal_volume[c][i] += values.shape_value(to_dealii[i], q) * values.JxW(q) * turn;
      }
    for (const auto& face : cell->face_iterators()) {
      if (!face->at_boundary()) continue;
      const std::string name = name_of(int(face->boundary_id()));
      if (name.empty()) continue;
      std::array<int, 4> nodes;
      for (unsigned v = 0; v < 4; ++v) nodes[v] = static_cast<int>(face->vertex_index(around_face<dim>[v]));
      if (dim == 2 && grid.nodes[nodes[0]][0] == 0.0 && grid.nodes[nodes[1]][0] == 0.0) continue;  // the axis
      const std::array<Vec3, 4> x = corners_of(nodes, grid.nodes);
      const Vec3 normal = (x[1] - x[0]).cross(x[3] - x[0]);
      const Vec3 middle = (x[0] + x[1] + x[2] + x[3]) / 4.0;
      if (normal.dot(center - middle) < 0.0) {
        if (dim == 2) nodes = {nodes[1], nodes[0], nodes[0], nodes[1]};
        else std::swap(nodes[1], nodes[3]);
      }
      grid.faces[name].push_back(nodes);
    }
  }
}

template <int dim>
std::optional<Place> Built<dim>::containing_cell(const Vec3& reference_position) {
  if (dim == 2 && std::abs(reference_position[2]) > 0.0) return std::nullopt;
  if (!cache) cache = std::make_unique<dealii::GridTools::Cache<dim>>(triangulation, mapping);
  try {
    const auto [cell, unit] = dealii::GridTools::find_active_cell_around_point(*cache, point<dim>(reference_position));
    if (cell.state() != dealii::IteratorState::valid) return std::nullopt;
    Place place{cell->active_cell_index(), {0.5, 0.5, 0.5}, 0.0};
    for (unsigned d = 0; d < dim; ++d) {
      if (unit[d] < -1e-9 || unit[d] > 1.0 + 1e-9) return std::nullopt;
      place.unit[d] = std::clamp(unit[d], 0.0, 1.0);
    }
    return place;
  } catch (const dealii::ExceptionBase&) {
    return std::nullopt;
  }
}

}  // namespace
}  // namespace undex::fem

undex::fem::DealMesh* undex_deal_mesh(const undex::fem::MeshSource& source) {
  dealii::MultithreadInfo::set_thread_limit(1);  // OpenMP has the cores
  if (source.axisymmetric) return new undex::fem::Built<2>(source);
  return new undex::fem::Built<3>(source);
}
