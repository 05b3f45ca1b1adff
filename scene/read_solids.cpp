// [[solids]], [solid_scheme] and [[planes]].
#include <algorithm>

#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/record_reader.hpp"

namespace undex::scene {
namespace {

using sph::LatticeType;

solid::Body read_solid(const Node& node, const std::string& path, Draft& draft, bool& shape_good, std::size_t index) {
  const int dimension = draft.scene.fluid.dimension;
  const TableReader table(node, path, "solids", dimension, draft.report);
  solid::Body solid;
  solid.name = std::to_string(index);
  if (const Node* shape = table.find("shape"))
    shape_good = read_shape(*shape, table.path_of("shape"), draft, ShapeUse::bounded, solid.shape.base);
  const bool round = shape_good && is_round(solid.shape.base, dimension);
  if (round) solid.lattice = LatticeType::rings;
  read_fields(table, solid);
  read_radial(table, solid.radial);
  read_subtractions(table, draft, draft.scene.fluid.bodies.size() + index, solid.shape.removed);
  if (const Node* material = table.find("material"))
    read_solid_material(*material, table.path_of("material"), draft, solid.material);
  if (shape_good && !round && solid.lattice == LatticeType::rings)
    table.complain("lattice",
                   table.path_of("lattice") + " = \"rings\" needs a cylinder or tube, round in the scene; take \"cartesian\"");
  const bool disc = round ? std::holds_alternative<Cylinder>(solid.shape.base)
                          : dimension == 2 && std::holds_alternative<Sphere>(solid.shape.base);
  if (shape_good && solid.residual_stress != 0 && (!disc || table.has("subtract")))
    table.complain("residual_stress", table.path_of("residual_stress") +
                                          " needs a whole cylinder or disc: elsewhere that stress is "
                                          "not in equilibrium; leave it out");
  if (shape_good) {
    const std::vector<std::string> known = shape_faces(solid.shape.base, dimension, draft.scene.fluid.symmetry.axis);
    for (const std::string& face : solid.wet)
      if (std::find(known.begin(), known.end(), face) == known.end()) table.unknown_word("wet", face, known);
    read_supports(table, known, solid.supports);
  }
  return solid;
}

void read_solid_scheme(const TableReader& top, Draft& draft) {
  const Node* node = top.table("solid_scheme");
  if (!node) return;
  const TableReader table(*node, "solid_scheme", "solid_scheme", top.dimension(), draft.report);
  read_fields(table, draft.scene.solids.numerics);
  if (!top.has("solids")) draft.report.add(*node, "[solid_scheme] without [[solids]]: add one, or remove it");
}

void read_plane(const Node& node, std::size_t index, Draft& draft) {
  const TableReader table(node, "planes." + std::to_string(index), "planes", draft.scene.fluid.dimension, draft.report);
  RigidPlane plane;
  read_fields(table, plane);
  draft.scene.solids.planes.push_back(plane);
  draft.plane_nodes.push_back(&node);
}

}  // namespace

void read_solids(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  const auto solids = top.tables("solids");
  for (std::size_t i = 0; i < solids.size(); ++i) {
    bool shape_good = false;
    draft.scene.solids.bodies.push_back(read_solid(*solids[i], element_path("solids", *solids[i], i), draft, shape_good, i));
    draft.solid_nodes.push_back(solids[i]);
    draft.solid_shape_good.push_back(shape_good);
  }
  read_solid_scheme(top, draft);
  const auto planes = top.tables("planes");
  for (std::size_t i = 0; i < planes.size(); ++i) read_plane(*planes[i], i, draft);
}

}  // namespace undex::scene
