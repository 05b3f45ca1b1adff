// Shapes: {type = "box" | "slab" | "sphere" | "cylinder" | "tube", ...}.
#include "scene/draft.hpp"
#include "scene/record_reader.hpp"
#include "scene/suggestion.hpp"

namespace undex::scene {

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
    into = shape;
  });
  return report.size() == before;
}

}  // namespace undex::scene
