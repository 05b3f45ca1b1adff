// [structure] and [coupling].
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/numbers.hpp"
#include "scene/structure_shape.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

const std::vector<std::string> mesh_types{"tube", "ring", "plate", "rod", "gmsh"};

int cells_over(double length, double size, int least) {
  return static_cast<int>(std::clamp(std::ceil(length / size - 1e-9), static_cast<double>(least), 1e5));
}

int rounded_up(int cells, int multiple) { return (cells + multiple - 1) / multiple * multiple; }

std::optional<double> read_cell_size(const TableReader& table) {
  std::optional<double> size;
  table.read("cell_size", size);
  if (table.has("cell_size") && table.has("cells"))
    table.complain("cell_size", table.path_of("cell_size") + " and cells exclude each other; leave out one of them");
  return size;
}

/// Does a symmetry plane cut the extent in two? Counts of cells are those of the whole, so they must be even then.
bool is_halved(const Draft& draft, int axis, double low) { return draft.scene.fluid.symmetry.axis[axis] && low < 0; }

/// A count given in `cells`; a multiple of `divisor`.
void read_count(const TableReader& cells, const char* key, int divisor, const char* why, int& into) {
  if (cells.read(key, into) && into % divisor != 0)
    cells.complain(key, cells.path_of(key) + " = " + std::to_string(into) + " must be a multiple of " + std::to_string(divisor) +
                            why + "; e.g. " + std::to_string(rounded_up(into, divisor)));
}
const char* const halved = ": it counts the whole body, which a symmetry plane halves";

/// By default a cell is half the wall, a shell's the whole wall.
void read_cells(const TableReader& table, const Draft& draft, fem::ElementKind element, fem::TubeMesh& tube) {
  const double wall = tube.outer_radius - tube.inner_radius;
  const int halves = is_halved(draft, tube.axis, tube.low) ? 2 : 1;
  const bool shell = element == fem::ElementKind::shell;
  const double cell = read_cell_size(table).value_or(shell ? wall : 0.5 * wall);
  tube.cells_through = shell ? 1 : cells_over(wall, cell, 2);
  tube.cells_around = rounded_up(cells_over(std::numbers::pi * (tube.inner_radius + tube.outer_radius), cell, 8), 4);
  tube.cells_along = rounded_up(cells_over(tube.high - tube.low, cell, 1), halves);
  const Node* node = table.table("cells");
  if (!node) return;
  const TableReader cells(*node, table.path_of("cells"), "cells.tube", 3, table.report());
  cells.read("through", tube.cells_through);
  read_count(cells, "around", 4, ", so that quarters are alike", tube.cells_around);
  read_count(cells, "along", halves, halved, tube.cells_along);
}

/// By default a cell is a sixth of the radius.
void read_cells(const TableReader& table, const Draft& draft, fem::RodMesh& rod) {
  const int halves = is_halved(draft, rod.axis, rod.low) ? 2 : 1;
  const double cell = read_cell_size(table).value_or(rod.radius / 6);
  rod.cells_radial = cells_over(rod.radius, cell, 2);
  rod.cells_along = rounded_up(cells_over(rod.high - rod.low, cell, 1), halves);
  const Node* node = table.table("cells");
  if (!node) return;
  const TableReader cells(*node, table.path_of("cells"), "cells.rod", 3, table.report());
  cells.read("radial", rod.cells_radial);
  read_count(cells, "along", halves, halved, rod.cells_along);
}

/// By default a cell is half the thickness, a shell's all of it.
void read_cells(const TableReader& table, const Draft& draft, fem::ElementKind element, fem::PlateMesh& plate) {
  const Vec3 extent = plate.high - plate.low;
  const bool shell = element == fem::ElementKind::shell;
  const double cell = read_cell_size(table).value_or((shell ? 1.0 : 0.5) * extent.minCoeff());
  const auto halves = [&](int axis) { return is_halved(draft, axis, plate.low[axis]) ? 2 : 1; };
  for (int a = 0; a < 3; ++a) plate.cells[a] = rounded_up(cells_over(extent[a], cell, 1), halves(a));
  int thinnest = 0;
  extent.minCoeff(&thinnest);
  if (shell) plate.cells[thinnest] = halves(thinnest);
  const Node* node = table.table("cells");
  if (!node) return;
  const TableReader cells(*node, table.path_of("cells"), "cells.plate", 3, table.report());
  const char* names[3] = {"x", "y", "z"};
  for (int a = 0; a < 3; ++a) read_count(cells, names[a], halves(a), halved, plate.cells[a]);
}

bool read_mesh(const TableReader& table, Draft& draft, fem::ElementKind element, fem::Mesh& into) {
  Report& report = draft.report;
  if (!table.need("shape", "e.g. shape = {type = \"tube\", inner_radius = 0.04, outer_radius = 0.05, low = -0.1, high = 0.1}"))
    return false;
  const Node& node = *table.find("shape");
  const std::string path = table.path_of("shape");
  const Node* type = node.find("type");
  if (node.kind != Node::Kind::table || !type || type->kind != Node::Kind::text ||
      std::find(mesh_types.begin(), mesh_types.end(), type->text) == mesh_types.end()) {
    const Node& at = type ? *type : node;
    report.add(at, path + (node.kind == Node::Kind::table ? ".type" : "") + " must be one of " + listed(mesh_types) +
                       (type ? ", not " + type->described() : "; e.g. {type = \"tube\", ...}"));
    return false;
  }
  if (element == fem::ElementKind::shell && (type->text == "gmsh" || type->text == "rod"))
    table.complain("element", table.path_of("element") +
                                  " = \"shell\" needs a wall whose thickness direction is known, that of "
                                  "a tube, ring or plate; use \"hexahedron\" for a " +
                                  type->text);
  if (type->text == "gmsh") {
    const TableReader shape(node, path, "structure.gmsh", 3, report);
    std::string file;
    if (!shape.need("path", "give the .msh file, relative to the scene file") || !shape.read("path", file)) return false;
    const std::filesystem::path full = draft.scene.file.parent_path() / file;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(full, ignored)) {
      shape.complain("path", path + ".path: no file '" + full.string() + "'; give it relative to the scene file");
      return false;
    }
    into = fem::GmshMesh{std::filesystem::absolute(full).lexically_normal().string()};
    if (table.has("cells")) table.complain("cells", table.path_of("cells") + ": a gmsh mesh has its own cells; leave it out");
    if (table.has("cell_size"))
      table.complain("cell_size", table.path_of("cell_size") + ": a gmsh mesh has its own cells; leave it out");
    return true;
  }
  // the geometry is that of a fluid shape of another name
  const char* kind = type->text == "plate" ? "box" : type->text == "rod" ? "cylinder" : "tube";
  Node as_shape = node;
  as_shape.find("type")->text = kind;
  Primitive shape = Box{Vec3::Zero(), Vec3::Zero()};
  if (!read_shape(as_shape, path, 3, {kind}, report, shape)) return false;
  if (const auto* box = std::get_if<Box>(&shape)) {
    fem::PlateMesh plate{box->low, box->high};
    read_cells(table, draft, element, plate);
    into = plate;
  } else if (const auto* c = std::get_if<Cylinder>(&shape)) {
    fem::RodMesh rod{.axis = c->axis, .center = c->center, .radius = c->radius, .low = c->low, .high = c->high};
    read_cells(table, draft, rod);
    into = rod;
  } else {
    const TubeShape& t = std::get<TubeShape>(shape);
    fem::TubeMesh tube{
        .axis = t.axis, .center = t.center, .inner_radius = t.inner, .outer_radius = t.outer, .low = t.low, .high = t.high};
    read_cells(table, draft, element, tube);
    into = tube;
  }
  return true;
}

/// None for a gmsh mesh, whose faces are the ids in its file.
std::vector<std::string> mesh_faces(const fem::Mesh& mesh, const std::array<bool, 3>& symmetric) {
  const std::optional<Primitive> shape = structure_shape(mesh);
  return shape ? shape_faces(*shape, 3, symmetric) : std::vector<std::string>{};
}

/// Is the face one of the mesh's? Gmsh faces are only known to the file.
void check_face(const TableReader& table, const char* key, const std::string& face, const std::vector<std::string>& known) {
  if (!known.empty() && std::find(known.begin(), known.end(), face) == known.end()) table.unknown_word(key, face, known);
}

void read_supports(const TableReader& table, const std::vector<std::string>& faces, fem::Settings& structure) {
  const auto nodes = table.tables("supports");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const TableReader one(*nodes[i], table.path_of("supports") + '.' + std::to_string(i), "supports", 3, table.report());
    fem::Support support;
    std::vector<int> fixed{0, 1, 2};
    if (one.need("face", "name the face that is held") && one.read("face", support.face))
      check_face(one, "face", support.face, faces);
    one.read_axes("fixed", fixed);
    support.fixed = {false, false, false};
    for (const int axis : fixed) support.fixed[axis] = true;
    structure.supports.push_back(support);
  }
}

void read_loads(const TableReader& table, const std::vector<std::string>& faces, fem::Settings& structure) {
  const auto nodes = table.tables("loads");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const TableReader one(*nodes[i], table.path_of("loads") + '.' + std::to_string(i), "loads", 3, table.report());
    fem::PressureLoad load;
    if (one.need("face", "name the loaded face") && one.read("face", load.face)) check_face(one, "face", load.face, faces);
    const bool both = one.need("time", "give the times in s") & one.need("pressure", "give the pressures in Pa");
    if (both && (one.read("time", load.time) & one.read("pressure", load.pressure))) {
      if (load.time.empty() || load.time.size() != load.pressure.size())
        one.complain("pressure", one.path() + ": time has " + std::to_string(load.time.size()) + " values and pressure " +
                                     std::to_string(load.pressure.size()) + "; give as many of each, at least one");
      for (std::size_t k = 1; k < load.time.size(); ++k)
        if (!(load.time[k - 1] < load.time[k])) {
          one.complain("time", one.path_of("time") + " must increase: " + shortest(load.time[k]) + " follows " +
                                   shortest(load.time[k - 1]));
          break;
        }
    }
    structure.loads.push_back(load);
  }
}

}  // namespace

void read_structure(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  if (const Node* node = top.table("coupling")) {
    const TableReader table(*node, "coupling", "coupling", 3, draft.report);
    table.read("slip", draft.scene.coupling.free_slip);
    table.read("window", draft.scene.coupling.window);
    table.read_choice<coupling::SolidContact>(
        "solids", draft.scene.coupling.solids,
        {{"particles", coupling::SolidContact::particles}, {"surface", coupling::SolidContact::surface}});
    if (!top.has("structure") && !top.has("solids"))
      draft.report.add(*node,
                       "[coupling] has nothing to couple: the scene has no [structure] and no [[solids]]; remove it or add one");
  }
  const Node* node = top.table("structure");
  if (!node) return;
  draft.structure_node = node;
  if (draft.dimension_good && draft.scene.fluid.dimension != 3) {
    draft.report.add(
        *node, "[structure] needs dimension = 3, but the scene has dimension = " + std::to_string(draft.scene.fluid.dimension));
  }
  const TableReader table(*node, "structure", "structure", 3, draft.report);
  fem::Settings structure;
  table.read_name("name", structure.name);
  table.read_choice<fem::ElementKind>("element", structure.element,
                                      {{"hexahedron", fem::ElementKind::hexahedron}, {"shell", fem::ElementKind::shell}});
  table.read("points_through", structure.points_through);
  draft.structure_shape_good = read_mesh(table, draft, structure.element, structure.mesh);
  if (table.need("material", "e.g. material = \"al-5083-h116\" ('undex materials' lists them)"))
    read_solid_material(*table.find("material"), "structure.material", draft, structure.material);
  for (int a = 0; a < 3; ++a)
    if (draft.scene.fluid.symmetry.axis[a]) structure.symmetry_axes.push_back(a);

  const std::vector<std::string> faces =
      draft.structure_shape_good ? mesh_faces(structure.mesh, draft.scene.fluid.symmetry.axis) : std::vector<std::string>{};
  read_supports(table, faces, structure);
  read_loads(table, faces, structure);
  structure.planes = draft.scene.solids.planes;
  structure.gravity = draft.scene.fluid.gravity;
  if (table.read("wet", structure.wet_faces))
    for (const std::string& face : structure.wet_faces) check_face(table, "wet", face, faces);
  table.read("velocity", structure.initial_velocity);
  table.read("courant", structure.courant);
  table.read("linear_viscosity", structure.linear_viscosity);
  table.read("quadratic_viscosity", structure.quadratic_viscosity);
  draft.scene.structure = structure;
}

}  // namespace undex::scene
