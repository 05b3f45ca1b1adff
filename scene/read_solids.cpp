// [[solids]], [solid_scheme] and [[planes]].
#include <algorithm>

#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

using solid::Description;
using sph::LatticeType;

/// A vector in three dimensions; in two a number, about the axis that leaves the plane.
void read_spin(const TableReader& table, Vec3& into) {
  const Node* node = table.find("spin");
  if (!node) return;
  if (table.dimension() == 3) {
    table.read("spin", into);
  } else if (node->kind == Node::Kind::array) {
    table.complain("spin", table.path_of("spin") + " must be a number in rad/s in two dimensions: only z is left to turn about");
  } else {
    table.read("spin", into[2]);
  }
}

solid::Body read_solid(const Node& node, const std::string& path, Draft& draft, bool& shape_good, std::size_t index) {
  const int dimension = draft.scene.fluid.dimension;
  const TableReader table(node, path, "solids", dimension, draft.report);
  solid::Body solid{
      .name = std::to_string(index), .shape = {Sphere{Vec3::Zero(), 0}, {}}, .material = {}, .spacing = {}, .wet = {}};
  table.need("name", "every solid has a name");
  table.read_name("name", solid.name);
  if (table.need("shape", "e.g. shape = {type = \"sphere\", radius = 0.01}"))
    shape_good = read_shape(*table.find("shape"), table.path_of("shape"), dimension, {"box", "sphere", "cylinder", "tube"},
                            draft.report, solid.shape.base);
  read_subtractions(table, draft, draft.scene.fluid.bodies.size() + index, solid.shape.removed);
  if (table.need("material", "e.g. material = \"al-5083-h116\" ('undex materials' lists them)"))
    read_solid_material(*table.find("material"), table.path_of("material"), draft, solid.material);
  table.read_choice<Description>(
      "description", solid.description,
      {{"total_lagrangian", Description::total_lagrangian}, {"updated_lagrangian", Description::updated_lagrangian}});
  table.read("spacing", solid.spacing);
  const bool round = shape_good && is_round(solid.shape.base, dimension);
  if (round) solid.lattice = LatticeType::rings;
  table.read_choice<LatticeType>("lattice", solid.lattice,
                                 {{"cartesian", LatticeType::cartesian}, {"rings", LatticeType::rings}});
  if (shape_good && !round && solid.lattice == LatticeType::rings)
    table.complain("lattice",
                   table.path_of("lattice") + " = \"rings\" needs a cylinder or tube, round in the scene; take \"cartesian\"");
  table.read("velocity", solid.velocity);
  read_spin(table, solid.spin);
  table.read("residual_stress", solid.residual_stress);
  const bool disc = round ? std::holds_alternative<Cylinder>(solid.shape.base)
                          : dimension == 2 && std::holds_alternative<Sphere>(solid.shape.base);
  if (shape_good && solid.residual_stress != 0 && (!disc || table.has("subtract")))
    table.complain("residual_stress", table.path_of("residual_stress") +
                                          " needs a whole cylinder or disc: elsewhere that stress is "
                                          "not in equilibrium; leave it out");
  if (table.read("wet", solid.wet) && shape_good) {
    const std::vector<std::string> known = shape_faces(solid.shape.base, dimension, draft.scene.fluid.symmetry.axis);
    for (const std::string& face : solid.wet)
      if (std::find(known.begin(), known.end(), face) == known.end()) table.unknown_word("wet", face, known);
  }
  return solid;
}

void read_solid_scheme(const TableReader& top, Draft& draft) {
  const Node* node = top.table("solid_scheme");
  if (!node) return;
  solid::Numerics& numerics = draft.scene.solids.numerics;
  const TableReader table(*node, "solid_scheme", "solid_scheme", top.dimension(), draft.report);
  table.read("eta", numerics.eta);
  table.read("courant", numerics.courant);
  table.read("linear_viscosity", numerics.linear_viscosity);
  table.read("quadratic_viscosity", numerics.quadratic_viscosity);
  table.read("hourglass", numerics.hourglass);
  table.read("alpha", numerics.alpha);
  table.read("beta", numerics.beta);
  table.read("artificial_stress", numerics.artificial_stress);
  if (!top.has("solids")) draft.report.add(*node, "[solid_scheme] without [[solids]]: add one, or remove it");
}

void read_plane(const Node& node, std::size_t index, Draft& draft) {
  const TableReader table(node, "planes." + std::to_string(index), "planes", draft.scene.fluid.dimension, draft.report);
  RigidPlane plane;
  if (table.need("axis", "say across which axis the plane lies, e.g. axis = \"z\"") && table.read_axis("axis", plane.axis) &&
      plane.axis >= table.dimension())
    table.complain(
        "axis", table.path_of("axis") + ": the scene has dimension = " + std::to_string(table.dimension()) + ", so no such axis");
  table.read("position", plane.position);
  table.read_choice<bool>("free_side", plane.body_above, {{"above", true}, {"below", false}});
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
