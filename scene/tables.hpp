// Every table of a scene that has a record, once: the schema and the tables of docs/reference/scene-file.md are views of it.
#pragma once

#include <string>
#include <type_traits>
#include <variant>

#include "materials/library.hpp"
#include "scene/alternatives.hpp"
#include "scene/scene.hpp"

namespace undex::scene {

template <Described Record>
Record all_defaults() {
  Record record{};
  return record;
}

/// The alternatives of a variant as tables prefix.name, with their summaries; `kind` is the key that names the alternative.
template <class... Types>
void for_each_alternative(const std::string& prefix, const char* kind, auto&& visit, std::type_identity<std::variant<Types...>>) {
  const auto show = [&]<class Type>(std::type_identity<Type>) {
    if constexpr (!requires { Type::is_modifier; })
      visit(prefix + Type::name, Type::summary, all_defaults<ParametersOf<Type>>(), kind);
  };
  (show(std::type_identity<Types>{}), ...);
}

/// The counts of a mesh's cells, as table cells.name; nothing for a mesh that has none.
template <class Mesh>
void visit_cells(auto&& visit) {
  if constexpr (Described<fem::Cells<Mesh>>)
    visit(std::string("cells.") + Mesh::name, "of the whole body", all_defaults<fem::Cells<Mesh>>(), "");
}
template <class... Meshes>
void for_each_cells(auto&& visit, std::type_identity<std::variant<Meshes...>>) {
  (visit_cells<Meshes>(visit), ...);
}

/// visit(name of the table, summary, a record with all defaults, key of an alternative's own name or ""). "" is the top of the
/// file, "shape.box" a shape of type "box".
void for_each_table(auto&& visit) {
  visit("", "", all_defaults<Scene>(), "");
  visit("resolution", "", all_defaults<sph::Lattice>(), "");
  visit("symmetry", "", all_defaults<sph::Symmetry>(), "");
  visit("surroundings", "", all_defaults<sph::Surroundings>(), "");
  visit("scheme", "", all_defaults<sph::Numerics>(), "");
  visit("start", "", all_defaults<Start>(), "");
  visit("bodies", "", all_defaults<sph::Body>(), "");
  visit("burn", "", all_defaults<materials::ProgrammedBurn>(), "");
  visit("radial", "", all_defaults<RadialMotion>(), "");
  visit("walls", "", all_defaults<sph::Wall>(), "");
  visit("structure", "", all_defaults<fem::Settings>(), "");
  visit("parts", "", all_defaults<fem::Part>(), "");
  visit("supports", "", all_defaults<Support>(), "");
  visit("loads", "", all_defaults<fem::PressureLoad>(), "");
  visit("solids", "", all_defaults<solid::Body>(), "");
  visit("solid_scheme", "", all_defaults<solid::Numerics>(), "");
  visit("planes", "", all_defaults<RigidPlane>(), "");
  visit("coupling", "", all_defaults<coupling::Settings>(), "");
  visit("obstacles", "", all_defaults<coupling::Obstacle>(), "");
  visit("probes", "", all_defaults<Probe>(), "");
  visit("lines", "", all_defaults<ProfileLine>(), "");
  visit("output", "", all_defaults<Output>(), "");
  for_each_alternative("shape.", "type", visit, std::type_identity<Primitive>{});
  visit("placement", "", all_defaults<Placement>(), "");
  for_each_alternative("structure.", "type", visit, std::type_identity<fem::Mesh>{});
  for_each_cells(visit, std::type_identity<fem::Mesh>{});
  visit("material.solid", "", all_defaults<materials::Solid>(), "");
  visit("spall", "", all_defaults<materials::Spall>(), "");
  visit("damage", "", all_defaults<materials::JohnsonCookDamage>(), "");
  for_each_alternative("pressure.", "law", visit, std::type_identity<materials::SolidPressure>{});
  for_each_alternative("flow.", "law", visit, std::type_identity<materials::FlowStress>{});
  // A fluid's table has the keys of every material and those of its law.
  visit("material", "", all_defaults<materials::Fluid>(), "");
  for_each_alternative("material.", "", visit, std::type_identity<materials::FluidLaw>{});
}

}  // namespace undex::scene
