// [structure], [[structures]] and [coupling].
#include <algorithm>

#include "core/gmsh_file.hpp"
#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/numbers.hpp"
#include "scene/record_reader.hpp"
#include "scene/structure_shape.hpp"
#include "scene/suggestion.hpp"

namespace undex::scene {
namespace {

/// The words of `shape.type`: a ring is a short tube.
std::vector<std::string> mesh_types() {
  std::vector<std::string> names = Alternatives<fem::Mesh>::names();
  names.insert(std::find(names.begin(), names.end(), fem::TubeMesh::name) + 1, "ring");
  return names;
}

/// The file of a gmsh mesh, which has cells of its own.
bool find_file(const TableReader& table, const TableReader& shape, const Draft& draft, fem::GmshMesh& mesh) {
  const std::filesystem::path full = draft.scene.file.parent_path() / mesh.path;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(full, ignored)) {
    shape.complain("path", shape.path_of("path") + ": no file '" + full.string() + "'; give it relative to the scene file");
    return false;
  }
  mesh.path = std::filesystem::absolute(full).lexically_normal().string();
  for (const char* key : {"cells", "cell_size"})
    if (table.has(key)) table.complain(key, table.path_of(key) + ": a gmsh mesh has its own cells; leave it out");
  try {
    const bool meridian = draft.scene.geometry == Geometry::axisymmetric;
    mesh.read =
        std::make_shared<const HexahedralMesh>(read_gmsh(mesh.path, meridian ? GmshCells::quadrangles : GmshCells::hexahedra));
  } catch (const std::invalid_argument& mistake) {
    shape.complain("path", shape.path_of("path") + ": " + mistake.what());
    return false;
  }
  return true;
}

/// The counts of cells: those named, else those that the size of a cell gives.
template <class Type>
void read_cells(const TableReader& table, const Draft& draft, fem::ElementKind element, Type& mesh) {
  std::optional<double> size;
  table.read("cell_size", size);
  if (table.has("cell_size") && table.has("cells"))
    table.complain("cell_size", table.path_of("cell_size") + " and cells exclude each other; leave out one of them");
  fem::Cells<Type> cells{mesh, draft.scene.fluid.symmetry.axis};
  choose(cells, size, element);
  if (const Node* node = table.table("cells"))
    read_fields(TableReader(*node, table.path_of("cells"), std::string("cells.") + Type::name, 3, table.report()), cells);
  mesh = cells.mesh;
}

bool read_mesh(const TableReader& table, const Draft& draft, fem::ElementKind element, fem::Mesh& into) {
  Report& report = table.report();
  const Node* node = table.find("shape");
  if (!node) return false;
  const std::string path = table.path_of("shape");
  const Node* type = node->find("type");
  const std::vector<std::string> types = mesh_types();
  if (node->kind != Node::Kind::table || !type || type->kind != Node::Kind::text ||
      std::find(types.begin(), types.end(), type->text) == types.end()) {
    report.add(type ? *type : *node, path + (node->kind == Node::Kind::table ? ".type" : "") + " must be one of " +
                                         listed(types) + (type ? ", not " + type->described() : "; e.g. {type = \"tube\", ...}"));
    return false;
  }
  const std::string name = type->text == "ring" ? fem::TubeMesh::name : type->text;
  bool good = false;
  Alternatives<fem::Mesh>::with(name, [&]<class Type>(std::type_identity<Type>) {
    const bool disc = std::is_same_v<Type, fem::RodMesh> && draft.scene.geometry == Geometry::axisymmetric;
    if (element == fem::ElementKind::shell && !Type::has_wall && !disc)
      table.complain("element", table.path_of("element") +
                                    " = \"shell\" needs a wall whose thickness direction is known, that of a tube, ring or plate "
                                    "(or of a rod with dimension = \"axisymmetric\", a disc); use \"hexahedron\" for a " +
                                    name);
    const std::size_t before_shape = report.size();
    const TableReader shape(*node, path, "structure." + name, 3, report);
    Type mesh;
    read_fields(shape, mesh);
    good = report.size() == before_shape;
    if (!good) return;
    if constexpr (Described<fem::Cells<Type>>) read_cells(table, draft, element, mesh);
    else good = find_file(table, shape, draft, mesh);
    into = mesh;
  });
  return good;
}

/// Is the face one of the mesh's?
void check_face(const TableReader& table, const char* key, const std::string& face, const std::vector<std::string>& known) {
  if (!known.empty() && std::find(known.begin(), known.end(), face) == known.end()) table.unknown_word(key, face, known);
}

/// The tables of a list, each with a face of the mesh.
template <Described Record>
void read_faces(const TableReader& table, const char* list, const std::vector<std::string>& faces, std::vector<Record>& into,
                auto&& check) {
  const auto nodes = table.tables(list);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const TableReader one(*nodes[i], table.path_of(list) + '.' + std::to_string(i), list, 3, table.report());
    const std::size_t before = table.report().size();
    Record record;
    read_fields(one, record);
    if (const Node* face = one.find("face"); face && face->kind == Node::Kind::text) check_face(one, "face", record.face, faces);
    if (table.report().size() == before) check(one, record);
    into.push_back(record);
  }
}

/// As many pressures as times, and the times in order.
void check_load(const TableReader& table, const fem::PressureLoad& load) {
  if (load.time.empty() || load.time.size() != load.pressure.size())
    table.complain("pressure", table.path() + ": time has " + std::to_string(load.time.size()) + " values and pressure " +
                                   std::to_string(load.pressure.size()) + "; give as many of each, at least one");
  for (std::size_t k = 1; k < load.time.size(); ++k)
    if (!(load.time[k - 1] < load.time[k])) {
      table.complain(
          "time", table.path_of("time") + " must increase: " + shortest(load.time[k]) + " follows " + shortest(load.time[k - 1]));
      return;
    }
}

}  // namespace

void read_supports(const TableReader& table, const std::vector<std::string>& faces, std::vector<Support>& into) {
  read_faces(table, "supports", faces, into, [](const TableReader&, const Support&) {});
}

namespace {

/// Without a name of its own it has the one given.
void read_one(const Node& node, const std::string& path, const std::string& name, Draft& draft) {
  fem::Settings structure;
  structure.name = name;
  const TableReader table(node, path, "structure", 3, draft.report);
  read_fields(table, structure);
  read_radial(table, structure.radial);
  const bool shape_good = read_mesh(table, draft, structure.element, structure.mesh);
  if (const Node* material = table.find("material"))
    read_solid_material(*material, table.path_of("material"), draft, structure.material);
  for (int a = 0; a < 3; ++a)
    if (draft.scene.fluid.symmetry.axis[a]) structure.symmetry_axes.push_back(a);

  const std::vector<std::string> faces =
      shape_good ? StructureShape(structure.mesh).faces(draft.scene.fluid.symmetry.axis) : std::vector<std::string>{};
  read_supports(table, faces, structure.supports);
  read_faces(table, "loads", faces, structure.loads, check_load);
  structure.planes = draft.scene.solids.planes;
  structure.gravity = draft.scene.fluid.gravity;
  for (const std::string& face : structure.wet_faces) check_face(table, "wet", face, faces);
  draft.scene.structures.push_back(structure);
  draft.structure_nodes.push_back(&node);
  draft.structure_shape_good.push_back(shape_good);
}

}  // namespace

void read_structures(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  if (const Node* node = top.table("coupling")) {
    const TableReader table(*node, "coupling", "coupling", 3, draft.report);
    read_fields(table, draft.scene.coupling);
    if (!top.has("structure") && !top.has("structures") && !top.has("solids"))
      draft.report.add(*node,
                       "[coupling] has nothing to couple: the scene has no [structure] and no [[solids]]; remove it or add one");
  }
  const Node* one = top.table("structure");
  const std::vector<const Node*> several = top.tables("structures");
  if (one && !several.empty()) {
    draft.report.add(*one, "[structure] and [[structures]] exclude each other; write this one as one more of [[structures]]");
    one = nullptr;
  }
  const Node* first = one ? one : several.empty() ? nullptr : several.front();
  if (first && draft.dimension_good && draft.scene.fluid.dimension != 3)
    draft.report.add(*first,
                     (one ? "[structure] needs" : "[[structures]] need") +
                         (" dimension = 3, but the scene has dimension = " + std::to_string(draft.scene.fluid.dimension)));
  if (one) read_one(*one, "structure", "structure", draft);
  draft.scene.structures_listed = !several.empty();
  for (std::size_t i = 0; i < several.size(); ++i)
    read_one(*several[i], element_path("structures", *several[i], i), std::to_string(i), draft);
}

}  // namespace undex::scene
