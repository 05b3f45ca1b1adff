// What is taken out of bodies and solids, which name one another: shapes as they are read, names once all are known.
#include "scene/draft.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

/// A body or a solid.
struct Part {
  std::string path, name;
  Shape* shape;
  const Node* node;
  bool shape_good;
};

std::vector<Part> parts_of(Draft& draft) {
  std::vector<Part> parts;
  sph::Settings& fluid = draft.scene.fluid;
  for (std::size_t i = 0; i < fluid.bodies.size(); ++i)
    parts.push_back({.path = "bodies." + fluid.bodies[i].name,
                     .name = fluid.bodies[i].name,
                     .shape = &fluid.bodies[i].shape,
                     .node = draft.body_nodes[i],
                     .shape_good = draft.body_shape_good[i]});
  std::vector<solid::Body>& solids = draft.scene.solids.bodies;
  for (std::size_t i = 0; i < solids.size(); ++i)
    parts.push_back({.path = "solids." + solids[i].name,
                     .name = solids[i].name,
                     .shape = &solids[i].shape,
                     .node = draft.solid_nodes[i],
                     .shape_good = draft.solid_shape_good[i]});
  return parts;
}

}  // namespace

void read_subtractions(const TableReader& table, Draft& draft, std::size_t from, std::vector<Primitive>& into) {
  const Node* list = table.find("subtract");
  if (!list) return;
  const std::string path = table.path_of("subtract");
  if (list->kind != Node::Kind::array) {
    table.complain("subtract", path + " must be an array of shapes and names of bodies, not " + list->described());
    return;
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const Node& item = list->items[i];
    if (item.kind == Node::Kind::text) {
      draft.named_subtractions.push_back({&item, from});
      continue;
    }
    Primitive removed;
    if (read_shape(item, path + '.' + std::to_string(i), draft, ShapeUse::any, removed)) into.push_back(removed);
  }
}

void resolve_subtractions(Draft& draft) {
  const std::vector<Part> parts = parts_of(draft);
  for (const auto& [node, from] : draft.named_subtractions) {
    const std::string path = parts[from].path + ".subtract";
    std::vector<std::string> known;
    std::size_t other = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i != from) known.push_back(parts[i].name);
      if (parts[i].name == node->text) other = i + 1;
    }
    if (other == from + 1) {
      draft.report.add(*node, path + ": a body cannot be subtracted from itself");
    } else if (other == 0) {
      draft.report.add(*node, path + ": no body '" + node->text + "'" + suggestion(node->text, known));
    } else {
      const Part& removed = parts[other - 1];
      const Node* subtract = removed.node->find("subtract");
      if (subtract && subtract->kind == Node::Kind::array && !subtract->items.empty())
        draft.report.add(*node, path + ": '" + node->text + "' itself has subtractions; subtract plain shapes instead");
      else if (removed.shape_good) parts[from].shape->removed.push_back(removed.shape->base);
    }
  }
}

}  // namespace undex::scene
