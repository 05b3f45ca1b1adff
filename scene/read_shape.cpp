// Shapes: {type = "box" | "slab" | "sphere" | "cylinder" | "tube" | "cone", ...}.
#include "scene/draft.hpp"
#include "scene/record_reader.hpp"
#include "scene/suggestion.hpp"

namespace undex::scene {
namespace {

/// Of a cone in fewer than three dimensions the section through its axis is meant, and one radius is more than nothing.
void check_cone(const TableReader& table, const Cone& cone) {
  if (table.dimension() == 1)
    table.complain("type", table.path() + ": a cone needs dimension = 2 or 3; in one dimension take a \"box\"");
  else if (cone.axis >= table.dimension())
    table.complain("axis", table.path_of("axis") +
                               ": in two dimensions a cone lies along \"x\" or \"y\"; for a disc take a "
                               "\"cylinder\"");
  if (table.has("low_radius") && cone.low_radius == 0 && cone.high_radius == 0)
    table.complain("low_radius", table.path() + ": both radii are 0, which leaves nothing of the cone; enlarge one");
}

}  // namespace

bool read_shape(const Node& node, const std::string& path, int dimension, const std::vector<std::string>& allowed, Report& report,
                Primitive& into) {
  const std::string example = "{type = \"" + allowed.front() + "\", ...}";
  if (node.kind != Node::Kind::table) {
    report.add(node, path + " must be a table, " + example + ", not " + node.described());
    return false;
  }
  const Node* type = node.find("type");
  if (!type) {
    report.add(node, path + ".type is missing; one of " + listed(allowed));
    return false;
  }
  if (!is_alternative(*type, path + ".type", allowed, report)) return false;
  const std::size_t before = report.size();
  const TableReader table(node, path, "shape." + type->text, dimension, report);
  Alternatives<Primitive>::with(type->text, [&]<class Type>(std::type_identity<Type>) {
    Type shape;
    read_fields(table, shape);
    if constexpr (std::is_same_v<Type, Cone>) {
      if (report.size() == before) check_cone(table, shape);
    }
    into = shape;
  });
  return report.size() == before;
}

}  // namespace undex::scene
