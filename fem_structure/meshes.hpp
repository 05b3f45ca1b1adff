// Meshes of structures: geometry, counts of cells, and the counts that a size of cells gives. One mesh: a struct, its
// description, that of its counts, and its shape. SI units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "core/hexahedral_mesh.hpp"
#include "core/quadrangle_surface.hpp"
#include "core/record.hpp"
#include "core/shapes.hpp"
#include "core/vector.hpp"

namespace undex::fem {

enum class ElementKind {
  hexahedron,  ///< full integration, one pressure a cell: for solid bodies
  shell        ///< solid shell for thin walls, one cell through them (tube or plate)
};
constexpr auto words(ElementKind) {
  return std::to_array<Word<ElementKind>>({{"hexahedron", ElementKind::hexahedron}, {"shell", ElementKind::shell}});
}

/// Tube (or ring) about an axis. Every count is that of the full body: with symmetry planes that cut it, only the kept
/// part is meshed, with its share of the cells. Faces: "inner", "outer", "low", "high"; a face that a symmetry plane
/// cuts away has no name left.
struct TubeMesh {
  static constexpr const char* name = "tube";
  static constexpr const char* summary = "or \"ring\", as the [tube](#shapes); faces \"inner\", \"outer\", \"low\", \"high\"";
  static constexpr bool has_wall = true;  ///< is the direction through its wall known, as shells want it?
  int axis = 2;
  Vec3 center = Vec3::Zero();                                    ///< a point on the axis [m]
  double inner_radius = 0, outer_radius = 0, low = 0, high = 0;  ///< [m]
  int cells_through = 2, cells_around = 64, cells_along = 64;
};
/// Solid round bar about an axis, a square core of cells inside rings. `cells_radial` counts the cells from the axis to
/// the rim (at least 2; the full turn then has 4 cells per core cell side). Faces: "side", "low", "high".
struct RodMesh {
  static constexpr const char* name = "rod";
  static constexpr const char* summary = "as the [cylinder](#shapes); faces \"side\", \"low\", \"high\"";
  static constexpr bool has_wall = false;  ///< but in a meridian, where it is a disc
  int axis = 2;
  Vec3 center = Vec3::Zero();            ///< a point on the axis [m]
  double radius = 0, low = 0, high = 0;  ///< [m]
  int cells_radial = 6, cells_along = 32;
};
/// Box of cells. Faces: "x_low", "x_high", "y_low", ...
struct PlateMesh {
  static constexpr const char* name = "plate";
  static constexpr const char* summary = "as the [box](#shapes); faces \"x_low\", \"x_high\", ... \"z_high\"";
  static constexpr bool has_wall = true;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [m]
  std::array<int, 3> cells{1, 1, 1};
};
/// Mesh of gmsh's .msh, of hexahedra or of a meridian's quadrangles; faces are named by their physical groups, without a name by
/// the number as text, "1", "2", ... (without a group "0"). Of shells a surface of quadrangles (core/quadrangle_surface.hpp).
struct GmshMesh {
  static constexpr const char* name = "gmsh";
  static constexpr const char* summary =
      "a mesh with its own cells; its faces are called as its physical groups are (without a name: their numbers, \"1\", \"2\", "
      "...); of shells \"<group>.top\" and \"<group>.bottom\", and the groups of curves at their edges";
  static constexpr bool has_wall = true;
  std::string path;
  std::shared_ptr<const HexahedralMesh> read = nullptr;  ///< what the file holds, of shells as a layer; empty: not read yet
  std::optional<double> thickness = {};                  ///< of shells [m], of groups without one of their own
  ShellOffset offset = ShellOffset::mid;
  double scale = 1;  ///< times the file's lengths makes metres
};
using Mesh = std::variant<TubeMesh, PlateMesh, RodMesh, GmshMesh>;

inline TubeShape shape_of(const TubeMesh& mesh) {
  return {.axis = mesh.axis,
          .center = mesh.center,
          .inner = mesh.inner_radius,
          .outer = mesh.outer_radius,
          .low = mesh.low,
          .high = mesh.high};
}
inline Cylinder shape_of(const RodMesh& mesh) {
  return {.axis = mesh.axis, .center = mesh.center, .radius = mesh.radius, .low = mesh.low, .high = mesh.high};
}
inline Box shape_of(const PlateMesh& mesh) { return {mesh.low, mesh.high}; }

template <class Visit>
void describe(TubeMesh& mesh, Visit&& visit) {
  describe_axis(mesh.axis, mesh.center, visit);
  visit(mesh.inner_radius,
        {.name = "inner_radius", .unit = "m", .range = Range::length(), .needed = true, .remedy = "give it in m"});
  visit(mesh.outer_radius, {.name = "outer_radius",
                            .unit = "m",
                            .range = Range::length(),
                            .needed = true,
                            .remedy = "give it in m",
                            .greater = "inner_radius"});
  describe_ends(mesh.axis, mesh.low, mesh.high, visit);
}
template <class Visit>
void describe(RodMesh& mesh, Visit&& visit) {
  describe_axis(mesh.axis, mesh.center, visit);
  visit(mesh.radius, {.name = "radius", .unit = "m", .range = Range::length(), .needed = true, .remedy = "give it in m"});
  describe_ends(mesh.axis, mesh.low, mesh.high, visit);
}
template <class Visit>
void describe(PlateMesh& mesh, Visit&& visit) {
  describe_corners(mesh.low, mesh.high, visit);
}
template <class Visit>
void describe(GmshMesh& mesh, Visit&& visit) {
  visit(mesh.path, {.name = "path",
                    .needed = true,
                    .remedy = "give the .msh file, relative to the scene file",
                    .values = "a .msh file of hexahedra",
                    .meaning = "relative to the scene file; shells and meridians need quadrangles"});
  visit(mesh.scale, {.name = "scale",
                     .range = Range::above(0, 1e6),
                     .meaning = "times the file's lengths makes metres: 1e-3 for millimetres; `thickness` is in m"});
  visit(mesh.thickness, {.name = "thickness",
                         .unit = "m",
                         .range = Range::length(),
                         .rule = "that of `parts`",
                         .meaning = "of shells: that of every group which has none of its own in `parts`"});
  visit(
      mesh.offset,
      {.name = "offset",
       .meaning =
           "of shells: half to either side of the quadrangles, or all on the side of their normals (\"top\"), or on the other"});
}

/// The counts of a mesh's cells, all of the whole body: a second record of the same mesh.
template <class Type>
struct Cells {
  Type mesh;
  std::array<bool, 3> symmetric{false, false, false};  ///< by which planes through the origin it is cut

  /// Does a symmetry plane across the axis halve a body that begins at `low`?
  bool is_halved(int axis, double low) const { return symmetric[static_cast<std::size_t>(axis)] && low < 0; }
  /// Counts must then be even.
  Multiple halves(int axis, double low) const {
    if (!is_halved(axis, low)) return {};
    return {.of = 2, .because = ": it counts the whole body, which a symmetry plane halves"};
  }
};

/// Cells of at most `size` over a length; a whole number of `multiple` of them.
inline int cells_over(double length, double size, int least, Multiple multiple = {}) {
  const int cells = static_cast<int>(std::clamp(std::ceil(length / size - 1e-9), static_cast<double>(least), 1e5));
  return multiple.next(cells);
}

template <class Visit>
void describe(Cells<TubeMesh>& cells, Visit&& visit) {
  TubeMesh& tube = cells.mesh;
  visit(tube.cells_through,
        {.name = "through", .range = Range::between(1, 1000), .rule = "from `cell_size`", .meaning = "through the wall"});
  visit(tube.cells_around, {.name = "around",
                            .range = Range::between(8, 100000),
                            .rule = "from `cell_size`",
                            .multiple = {.of = 4, .because = ", so that quarters are alike"},
                            .meaning = "the full turn"});
  visit(tube.cells_along, {.name = "along",
                           .range = Range::between(1, 100000),
                           .rule = "from `cell_size`",
                           .multiple = cells.halves(tube.axis, tube.low),
                           .meaning = "along the axis"});
}
/// Sets the counts to cells of `size` [m]; by default half the wall, a shell's the whole wall.
inline void choose(Cells<TubeMesh>& cells, std::optional<double> size, ElementKind element) {
  TubeMesh& tube = cells.mesh;
  const double wall = tube.outer_radius - tube.inner_radius;
  const bool shell = element == ElementKind::shell;
  const double cell = size.value_or(shell ? wall : 0.5 * wall);
  tube.cells_through = shell ? 1 : cells_over(wall, cell, 2);
  tube.cells_around = cells_over(std::numbers::pi * (tube.inner_radius + tube.outer_radius), cell, 8, {.of = 4});
  tube.cells_along = cells_over(tube.high - tube.low, cell, 1, cells.halves(tube.axis, tube.low));
}

template <class Visit>
void describe(Cells<RodMesh>& cells, Visit&& visit) {
  RodMesh& rod = cells.mesh;
  visit(rod.cells_radial,
        {.name = "radial", .range = Range::between(2, 1000), .rule = "from `cell_size`", .meaning = "from the axis to the rim"});
  visit(rod.cells_along, {.name = "along",
                          .range = Range::between(1, 100000),
                          .rule = "from `cell_size`",
                          .multiple = cells.halves(rod.axis, rod.low),
                          .meaning = "along the axis"});
}
/// By default a cell is a sixth of the radius, a shell's (a disc of revolution) as wide as it is thick.
inline void choose(Cells<RodMesh>& cells, std::optional<double> size, ElementKind element) {
  RodMesh& rod = cells.mesh;
  const bool shell = element == ElementKind::shell;
  const double cell = size.value_or(shell ? rod.high - rod.low : rod.radius / 6);
  const Multiple halves = cells.halves(rod.axis, rod.low);
  rod.cells_radial = cells_over(rod.radius, cell, 2);
  rod.cells_along = shell ? halves.of : cells_over(rod.high - rod.low, cell, 1, halves);
}

template <class Visit>
void describe(Cells<PlateMesh>& cells, Visit&& visit) {
  constexpr const char* names[3] = {"x", "y", "z"};
  for (int a = 0; a < 3; ++a)
    visit(cells.mesh.cells[static_cast<std::size_t>(a)], {.name = names[a],
                                                          .range = Range::between(1, 100000),
                                                          .rule = "from `cell_size`",
                                                          .multiple = cells.halves(a, cells.mesh.low[a]),
                                                          .meaning = "along this axis"});
}
/// By default a cell is half the thickness, a shell's all of it.
inline void choose(Cells<PlateMesh>& cells, std::optional<double> size, ElementKind element) {
  PlateMesh& plate = cells.mesh;
  const Vec3 extent = plate.high - plate.low;
  const bool shell = element == ElementKind::shell;
  const double cell = size.value_or((shell ? 1.0 : 0.5) * extent.minCoeff());
  for (int a = 0; a < 3; ++a)
    plate.cells[static_cast<std::size_t>(a)] = cells_over(extent[a], cell, 1, cells.halves(a, plate.low[a]));
  Eigen::Index thinnest = 0;
  extent.minCoeff(&thinnest);
  if (shell) plate.cells[static_cast<std::size_t>(thinnest)] = cells.halves(static_cast<int>(thinnest), plate.low[thinnest]).of;
}

}  // namespace undex::fem
