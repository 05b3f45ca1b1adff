// [structure], [[structures]] and [coupling].
#include <algorithm>
#include <set>

#include "core/gmsh_file.hpp"
#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/geometry.hpp"
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

/// Is every part one of the mesh's groups, once, and is every group of some material?
bool check_groups(const TableReader& table, const std::vector<int>& groups, const GroupNames& names, fem::Settings& structure) {
  std::set<std::string> known, named;
  for (const int group : groups) known.insert(names.of(group));
  const std::vector<std::string> list(known.begin(), known.end());
  const auto nodes = table.tables("parts");
  const std::size_t before = table.report().size();
  std::set<std::string> with_material;
  for (std::size_t p = 0; p < structure.parts.size(); ++p) {
    fem::Part& part = structure.parts[p];
    const TableReader one(*nodes[p], table.path_of("parts") + '.' + std::to_string(p), "parts", 3, table.report());
    part.group = names.meant_by(part.group);
    if (!known.count(part.group))
      one.complain("group",
                   one.path_of("group") + ": the mesh has no group '" + part.group + "'; its groups are " + listed(list));
    else if (!named.insert(part.group).second)
      one.complain("group", one.path_of("group") + ": the group '" + part.group + "' has a part already; leave out one of them");
    if (part.material) with_material.insert(part.group);
  }
  if (!table.has("material"))
    for (const std::string& group : list)
      if (!with_material.count(group))
        table.complain("parts", table.path() +
                                    (group == "0" ? ": cells of the mesh that belong to no physical group have no material"
                                                  : ": the group '" + group + "' of the mesh has no material") +
                                    "; give the structure a material, or a part of its own with one; the groups are " +
                                    listed(list));
  return table.report().size() == before;
}

/// The file of a gmsh mesh, which has cells of its own.
bool find_file(const TableReader& table, const TableReader& shape, Draft& draft, fem::Settings& structure, fem::GmshMesh& mesh) {
  const bool shell = structure.element == fem::ElementKind::shell, meridian = draft.scene.geometry == Geometry::axisymmetric;
  if (shell && meridian) {
    table.complain("element",
                   table.path_of("element") +
                       " = \"shell\" of a gmsh mesh needs quadrangles in space; in the meridian use \"hexahedron\", or a "
                       "tube, ring or rod");
    return false;
  }
  if (!shell)
    for (const auto& [key, given] :
         {std::pair("thickness", mesh.thickness.has_value()), {"offset", mesh.offset != ShellOffset::mid}})
      if (given)
        shape.complain(
            key, shape.path_of(key) + " is one of shells; leave it out, or take element = \"shell\" and a mesh of quadrangles");
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
    std::vector<int> planes;
    for (int a = 0; a < 3; ++a)
      if (draft.scene.fluid.symmetry.axis[a]) planes.push_back(a);
    if (shell) {
      const QuadrangleSurface surface = read_gmsh_surface(mesh.path, mesh.scale);
      if (!check_groups(table, surface.groups, surface.group_names, structure)) return false;
      Bounds extent;
      for (const Vec3& node : surface.nodes) extent.include(node);
      const double size = longest(extent, 3);
      const auto thin = [&](const TableReader& of, const std::optional<double>& thickness) {
        if (!thickness || *thickness <= size) return;
        of.complain("thickness", of.path_of("thickness") + " = " + shortest(*thickness) + " [m] is more than the mesh is long, " +
                                     rounded(size) + " m: is it in mm? Then write \"" + shortest(*thickness) + " mm\"");
      };
      const std::size_t before = table.report().size();
      thin(shape, mesh.thickness);
      const auto parts = table.tables("parts");
      for (std::size_t p = 0; p < structure.parts.size(); ++p)
        thin(TableReader(*parts[p], table.path_of("parts") + '.' + std::to_string(p), "parts", 3, table.report()),
             structure.parts[p].thickness);
      if (table.report().size() > before) return false;
      mesh.read = std::make_shared<const HexahedralMesh>(fem::shells_on(surface, mesh, structure.parts, planes));
    } else {
      mesh.read = std::make_shared<const HexahedralMesh>(
          read_gmsh(mesh.path, meridian ? GmshCells::quadrangles : GmshCells::hexahedra, mesh.scale));
      if (!check_groups(table, mesh.read->groups, mesh.read->group_names, structure)) return false;
    }
    for (const std::string& remark : mesh.read->remarks)
      draft.warnings.add(*shape.find("path"), shape.path_of("path") + ": " + mesh.path + ": " + remark);
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

bool read_mesh(const TableReader& table, Draft& draft, fem::Settings& structure) {
  Report& report = table.report();
  const fem::ElementKind element = structure.element;
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
    else good = find_file(table, shape, draft, structure, mesh);
    structure.mesh = mesh;
    if (table.has("parts") && !std::is_same_v<Type, fem::GmshMesh>)
      table.complain("parts", table.path_of("parts") + " are groups of a gmsh mesh; a " + name + " is of one material");
  });
  return good;
}

/// The faces of a structure: those that are computed, those that symmetry planes cut away, and the names that the scene gives.
struct KnownFaces {
  std::vector<std::string> kept, cut_away = {};
  GroupNames names = {};
};

/// Is the face one of the mesh's?
void check_face(const TableReader& table, const char* key, const std::string& text, const KnownFaces& faces) {
  const std::vector<std::string>& known = faces.kept;
  const GroupNames& names = faces.names;
  const std::string face = names.meant_by(text);
  if (known.empty() || std::find(known.begin(), known.end(), face) != known.end()) return;
  if (std::find(faces.cut_away.begin(), faces.cut_away.end(), face) != faces.cut_away.end())
    table.complain(key,
                   table.path_of(key) + ": the face '" + face +
                       "' lies beyond a symmetry plane, which stands for it: name the face on the kept side, which holds for "
                       "both; it is one of " +
                       listed(known));
  else if (names.given.empty()) table.unknown_word(key, face, known);
  else table.complain(key, table.path_of(key) + ": the mesh has no face '" + face + "'; its faces are " + listed(known));
}

/// What groups of the mesh are made of.
void read_parts(const TableReader& table, Draft& draft, fem::Settings& structure) {
  const auto nodes = table.tables("parts");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const TableReader one(*nodes[i], table.path_of("parts") + '.' + std::to_string(i), "parts", 3, table.report());
    fem::Part part;
    read_fields(one, part);
    if (const Node* material = one.find("material"))
      read_solid_material(*material, one.path_of("material"), draft, part.material.emplace());
    if (ShellOffset offset{}; one.read_choice("offset", offset, choices<ShellOffset>())) part.offset = offset;
    if (structure.element != fem::ElementKind::shell)
      for (const char* key : {"thickness", "offset"})
        if (one.has(key))
          one.complain(
              key, one.path_of(key) + " is one of shells; leave it out, or take element = \"shell\" and a mesh of quadrangles");
    structure.parts.push_back(std::move(part));
  }
}

/// Faces by their names where the scene gives their numbers.
void take_names(const GroupNames& names, fem::Settings& structure) {
  for (Support& support : structure.supports) support.face = names.meant_by(support.face);
  for (fem::PressureLoad& load : structure.loads) load.face = names.meant_by(load.face);
  for (std::string& face : structure.wet_faces) face = names.meant_by(face);
}

/// The tables of a list, each with a face of the mesh.
template <Described Record>
void read_faces(const TableReader& table, const char* list, const KnownFaces& faces, std::vector<Record>& into, auto&& check) {
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
  read_faces(table, "supports", KnownFaces{.kept = faces}, into, [](const TableReader&, const Support&) {});
}

namespace {

/// Without a name of its own it has the one given.
void read_one(const Node& node, const std::string& path, const std::string& name, Draft& draft) {
  fem::Settings structure;
  structure.name = name;
  const TableReader table(node, path, "structure", 3, draft.report);
  table.read_choice("element", structure.element, choices<fem::ElementKind>());
  read_parts(table, draft, structure);
  read_fields(table, structure);
  read_radial(table, structure.radial);
  const bool shape_good = read_mesh(table, draft, structure);
  if (const Node* material = table.find("material"))
    read_solid_material(*material, table.path_of("material"), draft, structure.material);
  for (int a = 0; a < 3; ++a)
    if (draft.scene.fluid.symmetry.axis[a]) structure.symmetry_axes.push_back(a);

  KnownFaces faces;
  if (shape_good) {
    const StructureShape shape(structure.mesh);
    faces.kept = shape.faces(draft.scene.fluid.symmetry.axis);
    for (const std::string& face : shape.faces({false, false, false}))
      if (std::find(faces.kept.begin(), faces.kept.end(), face) == faces.kept.end()) faces.cut_away.push_back(face);
  }
  if (const auto* gmsh = std::get_if<fem::GmshMesh>(&structure.mesh); gmsh && gmsh->read) faces.names = gmsh->read->face_names;
  const GroupNames& names = faces.names;
  read_faces(table, "supports", faces, structure.supports, [](const TableReader&, const Support&) {});
  read_faces(table, "loads", faces, structure.loads, check_load);
  structure.planes = draft.scene.solids.planes;
  structure.gravity = draft.scene.fluid.gravity;
  for (const std::string& face : structure.wet_faces) check_face(table, "wet", face, faces);
  take_names(names, structure);
  if (!table.has("material"))  // what asks for one of the whole structure gets that of the first part
    for (const fem::Part& part : structure.parts)
      if (part.material) {
        structure.material = *part.material;
        break;
      }
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
